// Tests of morula.hpp: handles move and free themselves, statuses become
// exceptions, callbacks may throw, layouts are those of the C header.
#include <morula.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <type_traits>

static int made, failed;
#define CHECK(condition)                                                   \
  do {                                                                     \
    ++made;                                                                \
    if (!(condition)) {                                                    \
      ++failed;                                                            \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                      \
  } while (0)

template <class F>
static std::int32_t status_of(F f) {
  try {
    f();
  } catch (const morula::Error &error) {
    CHECK(error.what()[0] != '\0');
    return error.status();
  }
  return MORULA_STATUS_OK;
}

static_assert(!std::is_copy_constructible_v<morula::Shape>);
static_assert(!std::is_copy_assignable_v<morula::Clump>);
static_assert(std::is_nothrow_move_constructible_v<morula::Shape>);
static_assert(std::is_nothrow_move_constructible_v<morula::Solid>);
static_assert(std::is_nothrow_move_assignable_v<morula::Clump>);
static_assert(sizeof(morula::ClumpOptions) == sizeof(morula_clump_options));

// An L of four unit cubes without symmetry but z, moved by (10, 20, 30).
static morula::Shape l_shape() {
  morula::Layout layout{{3, 2, 1}, {1, 1, 1}, {10, 20, 30}};
  return morula::Shape::from_mask({1, 1, 1, 1, 0, 0}, layout);
}

int main() {
  CHECK(morula_version() == MORULA_VERSION);
  morula::Shape shape = l_shape();
  morula::Shape moved = std::move(shape);
  CHECK(shape.get() == nullptr && moved.get() != nullptr);
  shape = std::move(moved);
  CHECK(shape.report().solid_cells == 4);

  // A throwing constructor's handle and a moved-from one free nothing twice.
  const morula_moments m = shape.moments(2.0);
  CHECK(std::fabs(m.mass - 8) < 1e-12 && std::fabs(m.centre[0] - 11.25) < 1e-12);
  CHECK(std::fabs(m.centre[1] - 20.75) < 1e-12 && m.inertia[3] > 0.1);
  CHECK(m.principal[0] < m.principal[1] && m.principal[1] < m.principal[2]);

  const morula::Solid solid(shape);
  CHECK(std::fabs(solid.distance({12.5, 20.5, 30.5})[0] + 0.5) < 1e-9);
  CHECK(solid.grid().dims[0] >= 3 && std::fabs(solid.moments(2.0).mass - 8) < 1e-12);
  solid.notes();
  shape.notes();

  const std::vector<double> planes{0.01, 0.1};
  morula::ClumpOptions options;
  options.spheres = 15;
  options.frame = MORULA_FRAME_BODY;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
  options.plane_tolerances = planes.data();
  options.plane_tolerance_count = planes.size();
  double last = 0;
  morula::Clump clump(solid, options, [&](double fraction) {
    last = fraction;
    return true;
  });
  CHECK(last > 0 && clump.size() > 0 && clump.size() <= 15);
  const auto spheres = clump.spheres();
  CHECK(spheres.size() == clump.size() && spheres[0].radius > 0.2);
  CHECK(clump.note().empty() == (clump.size() == 15));
  const auto warnings = clump.warnings();
  CHECK(warnings.empty() == (clump.size() == 15));
  for (const auto &w : warnings)
    CHECK(w.code == MORULA_WARNING_FEWER_SPHERES && w.figure < w.bound && w.text.size() > 10);
  CHECK(clump.surface().symmetry_planes == 1 && clump.surface().asymmetry >= 0);
  {
    // A cache keeps one parent; a fragment of it arrives as it was sent.
    morula::Cache cache(1u << 30);
    const morula::Parent parent = cache.parent(shape), again = cache.parent(shape);
    CHECK(cache.counters().hits == 1 && cache.counters().parents == 1);
    cache.clear();
    CHECK(cache.counters().parents == 0 && parent.bytes() == again.bytes());
    const morula::Fragments sent(parent, parent.held(2.0));
    const auto bytes = sent.serialize(1);
    const auto arrived = morula::Fragments::deserialize(again, bytes, sent.held(1));
    CHECK(arrived.size() == 1 && arrived[0].volume == sent[1].volume);
    CHECK(arrived.spheres(0).size() == sent.spheres(1).size());
    CHECK(status_of([&] {
            morula::Fragments::deserialize(parent, {1, 2, 3}, sent.held(1));
          }) == MORULA_STATUS_FORMAT);
  }
  CHECK(clump.overlap().coverage > 0.4 && clump.surface().samples > 0);
  CHECK(clump.exposed_areas().size() == spheres.size());
  CHECK(clump.plane_contacts(2)[1] >= clump.plane_contacts(2)[0]);
  CHECK(clump.counters().seconds_generate > 0 && clump.stopped() >= 0);
  CHECK(shape.counters().seconds_check > 0 && shape.counters().cells == 0);
  CHECK(solid.counters().cells > 0 && solid.counters().seconds_generate == 0);

  // Body-frame spheres turned and moved back lie in the input frame's box.
  const double *r = m.rotation;
  for (const auto &s : spheres)
    for (int i = 0; i < 3; ++i) {
      const double p = m.centre[i] + r[i] * s.center[0] + r[3 + i] * s.center[1] +
                       r[6 + i] * s.center[2];
      CHECK(p > 10 * (i + 1) && p < 10 * (i + 1) + (i == 0 ? 3 : i == 1 ? 2 : 1));
    }

  // Several in one call are as each by itself.
  options.frame = MORULA_FRAME_INPUT;
  options.method = MORULA_METHOD_BEST;
  options.effort = MORULA_EFFORT_DRAFT;
  options.threads = 2;
  const auto levels = morula::Clump::levels(solid, {3, 8}, options);
  CHECK(levels.size() == 2 && levels[0].size() == 3 && levels[1].size() == 8);
  options.spheres = 8;
  const auto same = morula::Clump::of_shapes({&shape, &shape, &shape}, options);
  const auto one = morula::Clump(shape, options).spheres();
  CHECK(same.size() == 3);
  for (const auto &each : same)
    CHECK(each.size() == 8 && each.spheres()[7].radius == one[7].radius);
  const auto two = morula::Clump::of_labels({1, 1, 0, 2, 2, 2}, {{6, 1, 1}}, {2, 1}, options);
  CHECK(two.size() == 2 && two[0].moments().volume == 3.0 && two[1].moments().volume == 2.0);
  CHECK(status_of([&] { morula::Clump::of_labels({1, 1}, {{2, 1, 1}}, {1, 7}, options); }) ==
        MORULA_STATUS_INDEX_OUT_OF_RANGE);
  CHECK(status_of([&] { morula::Clump::of_shapes({&shape, nullptr}, options); }) ==
        MORULA_STATUS_NULL_POINTER);

  // Errors carry their status and sentence.
  CHECK(status_of([] { morula::Shape::from_file("no/such.stl"); }) == MORULA_STATUS_IO);
  CHECK(status_of([] { morula::Shape::from_mesh({}, {}); }) == MORULA_STATUS_EMPTY);
  CHECK(status_of([] { morula::Shape::from_mesh({1}, {}); }) == MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(status_of([&] { solid.distance({1, 2}); }) == MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(status_of([] { morula::Shape::from_primitive("cheese"); }) == MORULA_STATUS_UNSUPPORTED);
  // A box of 2 x 1 x 3 from two sides: x and y, then z and y.
  morula::Silhouette front{{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0}, 4, 3, {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 1}};
  morula::Silhouette side{{0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0}, 5, 3, {0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 0, 1}};
  const auto hull = morula::Shape::from_silhouettes({front, side}, 6, MORULA_CARVE_CENTRES);
  CHECK(hull.report().volume > 5.999 && hull.report().volume < 6.001);
  front.width = 3;
  CHECK(status_of([&] { morula::Shape::from_silhouettes({front, side}); }) ==
        MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(status_of([] { morula::Shape::from_mask({1, 1}, {{3, 1, 1}}); }) ==
        MORULA_STATUS_INVALID_ARGUMENT);
  try {
    morula::Shape::from_primitive("cheese");
  } catch (const morula::Error &error) {
    CHECK(std::string(error.name()) == "UNSUPPORTED");
  }
  morula::ClumpOptions nothing;
  nothing.wants = MORULA_WANT_NOTHING;
  nothing.spheres = 1;
  const morula::Clump bare(shape, nothing);
  CHECK(status_of([&] { bare.overlap(); }) == MORULA_STATUS_NOT_WANTED);
  CHECK(status_of([&] { bare.moments(); }) == MORULA_STATUS_NOT_WANTED);

  // A callback that throws cancels, and its exception comes out.
  struct Mine {};
  bool caught = false;
  try {
    morula::Clump(solid, options, [](double) -> bool { throw Mine(); });
  } catch (const Mine &) {
    caught = true;
  }
  CHECK(caught);
  const morula::Shape tablet = morula::Shape::from_primitive("tablet");
  CHECK(status_of([&] { morula::Solid(tablet, {}, [](double) { return false; }); }) ==
        MORULA_STATUS_CANCELLED);

  // The other ways in.
  const std::vector<float> grey{0.1f, 0.9f, 0.9f, 0.1f};
  const double threshold = 0.5;
  CHECK(morula::Shape::from_grey(grey, {{4, 1, 1}}).report().solid_cells == 2);
  CHECK(morula::Shape::from_grey(std::vector<std::uint8_t>{0, 9}, {{2, 1, 1}}, &threshold)
            .report().solid_cells == 1);
  CHECK(morula::Shape::from_grey(std::vector<std::uint16_t>{0, 9}, {{2, 1, 1}})
            .report().solid_cells == 1);
  const std::vector<std::uint32_t> volume{0, 7, 7, 3};
  CHECK(morula::Shape::from_label(volume, {{4, 1, 1}}, 7).report().solid_cells == 2);
  const auto labels = morula::labels(volume, {{4, 1, 1}});
  CHECK(labels.size() == 2 && labels[0].id == 3 && labels[1].cells == 2);
  CHECK(labels[0].touches_border && labels[1].first[0] == 1 && labels[1].last[0] == 2);
  morula::FileOptions raw;
  raw.format = MORULA_FORMAT_RAW;
  raw.raw_dims[0] = 4;
  raw.raw_dims[1] = raw.raw_dims[2] = 1;
  const std::vector<std::uint8_t> cells{0, 7, 7, 3};
  std::ofstream("cpp_labels.raw", std::ios::binary).write("\0\7\7\3", 4);
  for (const auto &of_file : {morula::labels_from_bytes(cells, "labels.raw", {}, raw),
                              morula::labels_from_file("cpp_labels.raw", {}, raw)}) {
    CHECK(of_file.size() == 2 && of_file[0].id == 3 && of_file[0].touches_border);
    CHECK(of_file[1].id == 7 && of_file[1].cells == 2 && of_file[1].last[0] == 2);
  }
  std::remove("cpp_labels.raw");
  CHECK(status_of([&] { morula::labels_from_file("cpp_labels.raw", {}, raw); }) ==
        MORULA_STATUS_IO);
  const std::string off =
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  const std::vector<std::uint8_t> bytes(off.begin(), off.end());
  CHECK(std::fabs(morula::Shape::from_bytes(bytes).report().volume - 1.0 / 6) < 1e-12);
  CHECK(morula::Shape::from_primitive("box", {}, 0).report().watertight == 1);

  // As bytes, and back.
  const auto handed = tablet.serialize();
  CHECK(morula::Shape::deserialize(handed).serialize() == handed);
  CHECK(status_of([&] { morula::Shape::deserialize({}); }) == MORULA_STATUS_FORMAT);
  morula::ClumpOptions three;
  three.spheres = 3;
  three.effort = MORULA_EFFORT_DRAFT;
  three.wants = MORULA_WANT_OVERLAP;
  const morula::Clump sent(tablet, three);
  const auto copy = morula::Clump::deserialize(sent.serialize());
  CHECK(copy.size() == 3 && copy.spheres()[0].radius == sent.spheres()[0].radius);
  CHECK(copy.overlap().mismatch == sent.overlap().mismatch);

  std::printf("%d checks, %d failed\n", made, failed);
  return failed != 0;
}
