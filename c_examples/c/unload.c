/* The library is loaded, used and unloaded again and again, by plugins for instance: nothing grows.
 *
 *   unload LIBRARY
 *
 * It is not linked to. Once loaded it stays in the address space (nodelete): what it keeps for the whole
 * process is made once, and loading it again gives the same one. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <morula.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TIMES = 100, WARM = 20 };
static long allowed_kib = 512;

static const char *path;
static int failed;

/* The function of the library, as its declaration in the header has it. */
#define FIND(name)                                       \
  __typeof__(&name) name##_ = NULL;                      \
  *(void **)&name##_ = dlsym(library, #name);            \
  if (!name##_) return fprintf(stderr, "no %s\n", #name)

static void *library;

static int use(int32_t threads) {
  FIND(morula_shape_from_primitive);
  FIND(morula_clump_options_init);
  FIND(morula_solid_options_init);
  FIND(morula_clump_from_shape);
  FIND(morula_clump_sphere_count);
  FIND(morula_clump_free);
  FIND(morula_shape_free);
  FIND(morula_shape_report);
  FIND(morula_last_error_message);
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  morula_clump_options options;
  morula_solid_options grid;
  size_t n = 0;
  if (morula_clump_options_init_(&options, sizeof options) ||
      morula_solid_options_init_(&grid, sizeof grid))
    return fprintf(stderr, "%s\n", morula_last_error_message_());
  options.spheres = 4;
  options.effort = MORULA_EFFORT_DRAFT;
  options.threads = threads;
  grid.cells = 12;
  if (morula_shape_from_primitive_("box", NULL, NULL, 0, 0, 0, NULL, &shape) ||
      morula_clump_from_shape_(shape, &grid, &options, &clump) ||
      morula_clump_sphere_count_(clump, &n) || n != 4)
    return fprintf(stderr, "%s\n", morula_last_error_message_());
  morula_clump_free_(clump);
  morula_shape_free_(shape);
  return morula_shape_report_(NULL, NULL) != MORULA_STATUS_NULL_POINTER;
}

static void *on_a_thread(void *user) {
  if (use(*(int32_t *)user)) failed = 1;
  return NULL;
}

/* Pages that are in memory, in KiB; mappings of the library. */
static long resident(void) {
  long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (!file || fscanf(file, "%*d %ld", &pages) != 1) failed = 1;
  if (file) fclose(file);
  return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

static int mappings(void) {
  char line[4096];
  int n = 0;
  FILE *file = fopen("/proc/self/maps", "r");
  if (!file) return 0;
  while (fgets(line, sizeof line, file)) n += strstr(line, "libmorula") != NULL;
  fclose(file);
  return n;
}

/* The growth from the WARMth time to the last. */
static void again_and_again(const char *how, int32_t threads, int own_thread) {
  long before = 0;
  int mapped = 0;
  for (int i = 0; i < TIMES; i++) {
    pthread_t thread;
    library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      fprintf(stderr, "%s\n", dlerror());
      exit(1);
    }
    if (own_thread) {
      if (pthread_create(&thread, NULL, on_a_thread, &threads) || pthread_join(thread, NULL))
        failed = 1;
    } else if (use(threads)) {
      failed = 1;
    }
    if (dlclose(library)) failed = 1;
    if (i == WARM) {
      before = resident();
      mapped = mappings();
    }
  }
  const long growth = resident() - before;
  printf("called %s, %d threads in a call: loaded %d times, %ld KiB more after the last than after the "
         "%dth, %s after dlclose\n",
         how, threads, TIMES, growth, WARM, mappings() ? "mapped" : "unmapped");
  if (growth > allowed_kib || mappings() > mapped) failed = 1;
}

int main(int argc, char **argv) {
  if (argc < 2) return 2;
  path = argv[1];
  if (argc > 2) allowed_kib = strtol(argv[2], NULL, 10);
  again_and_again("on threads that end", 1, 1);
  again_and_again("on threads that end", 2, 1);
  again_and_again("on the main thread", 1, 0);
  again_and_again("on the main thread", 2, 0);
  return failed;
}
