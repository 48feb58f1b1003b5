/* Cancelling from the progress callback, at every one of its calls in turn. */
#include "check.h"

struct count {
  int calls, stop_at;
  double last;
};

static int32_t progress(double fraction, void *user) {
  struct count *count = user;
  CHECK(fraction >= count->last && fraction <= 1);
  count->last = fraction;
  return ++count->calls >= count->stop_at;
}

int main(void) {
  morula_shape *shape = l_shape();
  int cancelled = 0, partial = 0, whole = 0;
  morula_solid_options grid; /* coarse: there are some 200 calls to stop at */
  OK(morula_solid_options_init(&grid, sizeof grid));
  grid.cells = 24;
  for (int stop_at = 1; !whole && stop_at < 10000; stop_at++) {
    struct count count = {0, stop_at, 0};
    morula_clump_options options;
    morula_clump *clump = NULL;
    int32_t status, stopped = -1;
    size_t n = 0;
    OK(morula_clump_options_init(&options, sizeof options));
    options.spheres = 16;
    options.quality_columns = 48;
    options.threads = 2;
    options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE;
    options.progress = progress;
    options.user = &count;
    status = morula_clump_from_shape(shape, &grid, &options, &clump);
    if (status == MORULA_STATUS_CANCELLED) {
      CHECK(clump == NULL && morula_last_error_message()[0] != '\0');
      CHECK(count.calls >= stop_at && !partial);
      cancelled++;
      continue;
    }
    CHECK(status == MORULA_STATUS_OK);
    if (status != MORULA_STATUS_OK) break;
    OK(morula_clump_stopped(clump, &stopped));
    OK(morula_clump_sphere_count(clump, &n));
    CHECK(n > 0);
    if (count.calls < stop_at) whole++;
    else if (stopped == MORULA_STOPPED_CANCELLED) {
      morula_overlap overlap = {0};
      overlap.struct_size = sizeof overlap;
      STATUS(morula_clump_overlap(clump, &overlap), MORULA_STATUS_CANCELLED);
      partial++;
    }
    morula_clump_free(clump);
  }
  printf("cancelled %d times before a sphere, %d times after\n", cancelled, partial);
  CHECK(cancelled > 0 && partial > 0 && whole == 1);

  /* Import and solid can be cancelled as well. */
  struct count count = {0, 1, 0};
  morula_solid_options options;
  morula_solid *solid = NULL;
  OK(morula_solid_options_init(&options, sizeof options));
  options.progress = progress;
  options.user = &count;
  STATUS(morula_solid_from_shape(shape, &options, &solid), MORULA_STATUS_CANCELLED);
  CHECK(solid == NULL);
  morula_shape_free(shape);
  return checks_done();
}
