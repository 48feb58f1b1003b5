// What morula.hpp takes and what it allocates: views of every kind of array, callables of every
// kind, and no allocation but that of what is given back.
#include <morula.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <type_traits>
#include <utility>
#if __cplusplus >= 202002L && __has_include(<span>)
#include <span>
#endif

static int made, failed;
static std::size_t allocations;
#define CHECK(condition)                                                   \
  do {                                                                     \
    ++made;                                                                \
    if (!(condition)) {                                                    \
      ++failed;                                                            \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                      \
  } while (0)

// The program's operator new; the library has an allocator of its own.
void *operator new(std::size_t size) {
  ++allocations;
  if (void *p = std::malloc(size ? size : 1)) return p;
  throw std::bad_alloc();
}
void operator delete(void *p) noexcept { std::free(p); }
void operator delete(void *p, std::size_t) noexcept { std::free(p); }

template <class F>
static std::size_t allocated_by(F f) {
  const std::size_t before = allocations;
  const auto result = f();
  static_cast<void>(result);
  return allocations - before;
}

// Every handle moves and is not copied.
template <class T>
constexpr bool move_only = !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T> &&
                           std::is_nothrow_move_constructible_v<T> &&
                           std::is_nothrow_move_assignable_v<T> && sizeof(T) == sizeof(void *);
static_assert(move_only<morula::Shape> && move_only<morula::Solid> && move_only<morula::Clump>);
static_assert(move_only<morula::Body> && move_only<morula::Parent> && move_only<morula::Cache>);
static_assert(move_only<morula::Fragments> && move_only<morula::Cost> && move_only<morula::Sweep>);
static_assert(std::is_base_of_v<std::runtime_error, morula::Error>);
// A view is not made of what holds something else.
static_assert(!std::is_convertible_v<std::vector<float>, morula::View<double>>);
static_assert(!std::is_convertible_v<std::vector<std::int32_t>, morula::View<std::uint32_t>>);

static const double CORNERS[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const std::uint32_t FACES[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

static double volume(const morula::Shape &shape) { return shape.moments().volume; }

static void views() {
  const std::vector<double> corners(CORNERS, CORNERS + 12);
  const std::vector<std::uint32_t> faces(FACES, FACES + 12);
  std::array<double, 12> changing{};
  for (std::size_t i = 0; i < 12; ++i) changing[i] = CORNERS[i];
  CHECK(std::fabs(volume(morula::Shape::from_mesh(corners, faces)) - 1.0 / 6) < 1e-12);
  CHECK(std::fabs(volume(morula::Shape::from_mesh(changing, FACES)) - 1.0 / 6) < 1e-12);
  CHECK(std::fabs(volume(morula::Shape::from_mesh({CORNERS, 12}, {FACES, 12})) - 1.0 / 6) < 1e-12);
  CHECK(std::fabs(volume(morula::Shape::from_mesh(CORNERS, {0u, 2u, 1u, 0u, 1u, 3u, 1u, 2u, 3u, 2u,
                                                            0u, 3u})) - 1.0 / 6) < 1e-12);
#if defined(__cpp_lib_span)
  const std::span<double> all(changing);
  CHECK(std::fabs(volume(morula::Shape::from_mesh(all, std::span(faces))) - 1.0 / 6) < 1e-12);
  const morula::View<double> view(all);
  const std::span<const double> back(view);
  CHECK(back.data() == changing.data() && back.size() == 12);
  std::puts("with std::span");
#endif
  morula::View<double> none;
  CHECK(none.empty() && none.begin() == none.end());
  double sum = 0;
  for (const double x : morula::View<double>(corners)) sum += x;
  CHECK(std::fabs(sum - 3) < 1e-15);
}

static int heard;
static bool plain(double) {
  ++heard;
  return true;
}
struct Counter {
  int calls = 0;
  std::array<double, 100> large{};  // larger than what a std::function keeps in place
  bool operator()(double fraction) {
    large[static_cast<std::size_t>(calls++) % 100] = fraction;
    return true;
  }
};

static void callables(const morula::Solid &solid, const morula::ClumpOptions &options) {
  Counter counter;
  CHECK(allocated_by([&] { return morula::Clump(solid, options, counter); }) == 0);
  CHECK(counter.calls > 0);
  morula::Clump(solid, options, plain);
  morula::Clump(solid, options, &plain);
  CHECK(heard > 1);
  heard = 0;
  morula::Clump(solid, options, [](double f) { return plain(f); });
  CHECK(heard > 0);
  std::function<bool(double)> kept;
  morula::Clump(solid, options, kept);  // empty: none
  kept = [&](double) {
    heard = -1;
    return true;
  };
  morula::Clump(solid, options, kept);
  CHECK(heard == -1);
  const auto constant = [](double) { return true; };
  CHECK(morula::Clump(solid, options, constant).size() == 5);
  CHECK(morula::Clump(solid, options, nullptr).size() == 5);

  // The log, to a callable that may throw.
  int lines = 0;
  morula::set_log([&lines](std::int32_t level, const char *text) {
    lines += level >= MORULA_LOG_INFO && text[0] != '\0';
    throw 1;
  });
  morula::Clump(solid, options);
  CHECK(lines > 0);
  morula::set_log(nullptr);
  lines = 0;
  morula::Clump(solid, options);
  CHECK(lines == 0);
}

static void allocates_what_it_gives(const morula::Solid &solid, const morula::Clump &clump) {
  const std::vector<double> corners(CORNERS, CORNERS + 12);
  const std::vector<std::uint32_t> faces(FACES, FACES + 12);
  const auto spheres = clump.spheres();
  const morula::Body body(clump);
  const morula::Parent parent(solid, clump);
  morula::BreakOptions cut;
  cut.cells = 3;
  cut.masses = 1;
  const morula::Fragments fragments(parent, parent.held(1.0), cut);
  const std::string sphere = "sphere";
  const morula::Parameter radius{"radius", 2.0};
  // Handles: nothing. Spheres, masses, bytes, a note that does not fit in place: one array each.
  CHECK(allocated_by([&] { return morula::Shape::from_mesh(corners, faces); }) == 0);
  CHECK(allocated_by([&] { return morula::Shape::from_primitive(sphere, {&radius, 1}); }) == 0);
  CHECK(allocated_by([&] { return morula::Body(spheres, &solid); }) == 0);
  CHECK(allocated_by([&] { return morula::Body(clump); }) == 0);
  CHECK(allocated_by([&] { return morula::Parent(solid, spheres); }) == 0);
  CHECK(allocated_by([&] { return morula::Fragments(parent, parent.held(1.0), cut); }) == 0);
  CHECK(allocated_by([&] { return body.transform(2.0); }) == 0);
  CHECK(allocated_by([&] { return solid.moments(); }) == 0);
  CHECK(allocated_by([&] { return solid.distance(corners); }) == 1);
  CHECK(allocated_by([&] { return clump.spheres(); }) == 1);
  CHECK(allocated_by([&] { return clump.serialize(); }) == 1);
  CHECK(allocated_by([&] { return body.spheres(); }) == 1);
  CHECK(allocated_by([&] { return body.masses(); }) == 1);
  CHECK(allocated_by([&] { return body.spheres_f32(); }) == 1);
  CHECK(allocated_by([&] { return fragments.spheres(0, MORULA_FRAME_WORLD); }) == 1);
  CHECK(allocated_by([&] { return fragments.grown(0, 0.5, spheres); }) == 1);
  CHECK(allocated_by([&] { return fragments.half_spaces(0); }) == 1);
  CHECK(allocated_by([&] { return fragments.map(0); }) == 3);
  CHECK(allocated_by([&] { return morula::random_orientations(1, 7); }) == 1);
  // In place they are what the C function gives.
  std::vector<double> flat(4 * clump.size());
  CHECK(morula_clump_copy_spheres(clump.get(), clump.size(), flat.data()) == MORULA_STATUS_OK);
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const double here = k < 3 ? spheres[i].center[k] : spheres[i].radius;
      CHECK(!(here < flat[4 * i + k]) && !(here > flat[4 * i + k]));
    }
}

int main() {
  views();
  const auto all = morula::primitives();
  CHECK(all.size() > 10 && all[0].name == "sphere" && all[0].parameters[0].first == "radius");
  CHECK(morula::version() == MORULA_VERSION);
  CHECK(std::string(morula::version_string()) == MORULA_VERSION_STRING);
  CHECK(std::string(morula::stopped_name(MORULA_STOPPED_DEADLINE)) == "deadline");
  CHECK(std::string(morula::masses_name(MORULA_MASSES_EXACT)) == "exact");

  const morula::Shape shape = morula::Shape::from_primitive("stone");
  const morula::Solid solid(shape);
  morula::ClumpOptions options;
  options.spheres = 5;
  options.effort = MORULA_EFFORT_DRAFT;
  callables(solid, options);
  options.spheres = 30;
  const morula::Clump clump(solid, options);
  allocates_what_it_gives(solid, clump);

  // Weighed on the way.
  morula::MassOptions masses;
  masses.density = 2.0;
  const auto placed = morula::transform(clump, 2.0, {1, 2, 3}, {1, 0, 0, 0}, masses);
  CHECK(std::fabs(placed.moments().mass / morula::Body(clump, masses).moments().mass - 8) < 1e-9);
  morula::ContactOptions contact;
  contact.young = 5e7;
  CHECK(morula::timestep(clump, contact, masses).rayleigh > 0);
  morula::write(clump, MORULA_EXPORT_CSV, "cpp_views.csv", masses);
  CHECK(std::remove("cpp_views.csv") == 0);
  bool refused = false;
  try {
    const morula::Parameter many[17] = {};
    morula::Shape::from_primitive("sphere", many);
  } catch (const morula::Error &error) {
    refused = error.status() == MORULA_STATUS_INVALID_ARGUMENT && error.what()[0] != '\0';
  }
  CHECK(refused);

  std::printf("%d checks, %d failed\n", made, failed);
  return failed != 0;
}
