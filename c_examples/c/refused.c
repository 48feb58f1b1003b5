/* What no function takes: pointers that are not aligned to their type, and states of bodies that are no
 * numbers. Nothing is written then. */
#include "check.h"

/* INVALID_ARGUMENT, which any function may give for such a pointer, with its name. */
#define MISALIGNED(call, name)                                       \
  do {                                                               \
    CHECK((call) == MORULA_STATUS_INVALID_ARGUMENT);                 \
    CHECK(strstr(morula_last_error_message(), name) != NULL);        \
    CHECK(strstr(morula_last_error_message(), "aligned") != NULL);   \
  } while (0)

static void pointers(const morula_shape *shape, const morula_clump *clump) {
  static double room[64], whole[64];
  static uint64_t before[64];
  memset(room, 0x5a, sizeof room);
  memset(before, 0x5a, sizeof before);
  void *const odd = (char *)room + 1;
  morula_solid_options grid;
  morula_shape *made = NULL;
  morula_solid *solid = NULL;
  morula_parent *parent = NULL;
  size_t n = 0;
  for (int i = 0; i < 64; i++) whole[i] = i;
  /* Handles, and where they are put. */
  MISALIGNED(morula_shape_note_count((const morula_shape *)((const char *)shape + 1), &n), "shape");
  MISALIGNED(morula_solid_from_shape(shape, NULL, odd), "solid");
  /* Options, and structs that are filled. */
  MISALIGNED(morula_solid_from_shape(shape, odd, &solid), "morula_solid_options");
  MISALIGNED(morula_solid_options_init(odd, sizeof grid), "morula_solid_options");
  MISALIGNED(morula_clump_moments(clump, 1, odd), "morula_moments");
  MISALIGNED(morula_clump_overlap(clump, odd), "morula_overlap");
  /* Numbers that are read, and such that are written. */
  MISALIGNED(morula_shape_from_mesh(odd, 4, (const uint32_t *)whole, 4, NULL, &made), "vertices");
  MISALIGNED(morula_shape_from_mesh(whole, 4, odd, 4, NULL, &made), "triangles");
  MISALIGNED(morula_clump_copy_spheres(clump, 8, odd), "xyzr");
  MISALIGNED(morula_clump_sphere_count(clump, odd), "count");
  MISALIGNED(morula_random_orientations(1, 2, odd), "quaternions");
  OK(morula_solid_from_shape(shape, NULL, &solid));
  MISALIGNED(morula_solid_distance(solid, 1, odd, whole), "points");
  MISALIGNED(morula_solid_distance(solid, 1, whole, odd), "distances");
  MISALIGNED(morula_parent_from_solid(solid, odd, 2, 1, &parent), "xyzr");
  CHECK(made == NULL && parent == NULL && n == 0 && memcmp(room, before, sizeof room) == 0);
  morula_solid_free(solid);
}

/* Position, quaternion, velocity and angular velocity of a call with number `at` of `which` made bad. */
struct state {
  double all[4][4];
};

static const char *const NAMES[4] = {"position", "rotation", "velocity", "angular_velocity"};

static void refuses(const morula_parent *parent, const morula_fragments *from, int which, int at,
                    double bad) {
  struct state s = {{{1, 2, 3, 0}, {1, 0, 0, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}}};
  morula_held held, before;
  char place[16];
  memset(&held, 0x5a, sizeof held);
  held.struct_size = sizeof held;
  before = held;
  s.all[which][at] = bad;
  if (parent)
    STATUS(morula_parent_held(parent, 1, 1, s.all[0], s.all[1], s.all[2], s.all[3], &held),
           MORULA_STATUS_NOT_FINITE);
  else
    STATUS(morula_fragments_held(from, 0, s.all[0], s.all[1], s.all[2], s.all[3], &held),
           MORULA_STATUS_NOT_FINITE);
  CHECK(strstr(morula_last_error_message(), NAMES[which]) != NULL);
  snprintf(place, sizeof place, "[%d]", at);
  CHECK(which == 1 || strstr(morula_last_error_message(), place) != NULL);
  CHECK(memcmp(&held, &before, sizeof held) == 0);
}

static void states(const morula_shape *shape) {
  static const double bad[3] = {NAN, INFINITY, -INFINITY};
  const double spheres[2][4] = {{10.5, 20.5, 30.5, 0.5}, {12, 20.5, 30.5, 0.5}};
  morula_solid *solid = NULL;
  morula_parent *parent = NULL;
  morula_fragments *fragments = NULL;
  morula_held held = {.struct_size = sizeof held};
  OK(morula_solid_from_shape(shape, NULL, &solid));
  OK(morula_parent_from_solid(solid, spheres[0], 2, 1, &parent));
  OK(morula_parent_held(parent, 1, 1, NULL, NULL, NULL, NULL, &held));
  OK(morula_parent_break(parent, NULL, 0, &held, NULL, &fragments));
  for (int k = 0; k < 3; k++)
    for (int which = 0; which < 4; which++)
      for (int at = 0; at < (which == 1 ? 4 : 3); at++) {
        refuses(parent, NULL, which, at, bad[k]);
        refuses(NULL, fragments, which, at, bad[k]);
      }
  STATUS(morula_parent_held(parent, NAN, 1, NULL, NULL, NULL, NULL, &held), MORULA_STATUS_NOT_FINITE);
  STATUS(morula_parent_from_solid(solid, spheres[0], SIZE_MAX / 2, 1, &parent),
         MORULA_STATUS_TOO_LARGE);
  morula_body *body = NULL;
  morula_shape *again = NULL;
  STATUS(morula_body_from_spheres(spheres[0], SIZE_MAX / 2, solid, NULL, &body),
         MORULA_STATUS_TOO_LARGE);
  STATUS(morula_shape_deserialize((const uint8_t *)spheres, SIZE_MAX, &again),
         MORULA_STATUS_TOO_LARGE);
  double grown[4][4];
  STATUS(morula_fragments_grow(fragments, 0, 0.5, spheres[0], SIZE_MAX / 2, 0, MORULA_FRAME_INPUT, 4,
                               grown[0]),
         MORULA_STATUS_TOO_LARGE);
  morula_clump_options options;
  morula_clump *clump = NULL;
  OK(morula_clump_options_init(&options, sizeof options));
  options.half_spaces = spheres[0];
  options.half_space_count = SIZE_MAX / 2;
  STATUS(morula_clump_from_solid(solid, &options, &clump), MORULA_STATUS_TOO_LARGE);
  CHECK(body == NULL && again == NULL && clump == NULL);
  morula_fragments_free(fragments);
  morula_parent_free(parent);
  morula_solid_free(solid);
}

int main(void) {
  morula_shape *shape = l_shape();
  morula_clump_options options;
  morula_clump *clump = NULL;
  OK(morula_clump_options_init(&options, sizeof options));
  options.spheres = 8;
  options.effort = MORULA_EFFORT_DRAFT;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;
  OK(morula_clump_from_shape(shape, NULL, &options, &clump));
  pointers(shape, clump);
  states(shape);
  morula_clump_free(clump);
  morula_shape_free(shape);
  return checks_done();
}
