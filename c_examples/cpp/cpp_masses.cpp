// Weighs a clump through the C++ face, places it, and writes it for DEM codes.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <morula.hpp>

static int made = 0, failed = 0;

#define CHECK(condition)                                                        \
  do {                                                                          \
    made++;                                                                     \
    if (!(condition)) {                                                         \
      failed++;                                                                 \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                           \
  } while (0)

template <class Call>
static std::int32_t status_of(Call call) {
  try {
    call();
  } catch (const morula::Error &e) {
    return e.status();
  }
  return MORULA_STATUS_OK;
}

/// The spheres' masses add up to the body, in the frame of the body.
static void holds(const morula::Body &body) {
  const auto spheres = body.spheres(MORULA_FRAME_BODY);
  const auto masses = body.masses();
  const auto m = body.moments();
  double sum = 0, first = 0, products = 0;
  std::array<double, 3> moments{};
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto &[c, r] = spheres[i];
    const double own = 0.4 * r * r + c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    sum += masses[i];
    first += masses[i] * c[0];
    products += masses[i] * c[0] * c[1];
    for (std::size_t k = 0; k < 3; ++k) moments[k] += masses[i] * (own - c[k] * c[k]);
  }
  CHECK(std::fabs(sum / m.mass - 1) < 1e-10);
  CHECK(std::fabs(first) < 1e-9 * m.mass * std::cbrt(m.volume));
  CHECK(std::fabs(products) < 1e-9 * m.principal[2]);
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::fabs(moments[k] / m.principal[k] - 1) < 1e-9);
}

int main() {
  const morula::Solid solid(morula::Shape::from_primitive("stone"));
  morula::ClumpOptions options;
  options.spheres = 60;
  options.effort = MORULA_EFFORT_DRAFT;
  const morula::Clump clump(solid, options);
  morula::MassOptions weighing;
  weighing.density = 2500;
  double fraction = -1;
  const morula::Body body(clump, weighing, [&](double f) { return (fraction = f) >= 0; });
  CHECK(body.size() == 60 && fraction >= 0);
  holds(body);
  const auto result = body.result();
  CHECK(result.status == MORULA_MASSES_EXACT && body.binding().size() == result.binding);
  const morula::Body same(clump.spheres(), &solid, weighing);
  CHECK(std::fabs(same.masses()[7] / body.masses()[7] - 1) < 1e-6);
  const morula::Body alone(clump.spheres());
  CHECK(std::fabs(alone.moments().mass / clump.moments().volume - 1) < 0.1);

  // A size distribution from one template.
  for (const auto &turn : morula::random_orientations(7, 3)) {
    const auto small = body.transform(0.5, {1, 2, 3}, turn);
    holds(small);
    CHECK(std::fabs(small.moments().mass / body.moments().mass - 0.125) < 1e-12);
  }
  morula::ContactOptions contact;
  contact.young = 5e7;
  CHECK(body.timestep(contact).clump > 0 &&
        body.timestep(contact).together == body.timestep(contact).clump && body.timestep(contact).rayleigh > 0);
  CHECK(body.spheres_f32().size() == 240);

  const auto files = body.files(MORULA_EXPORT_LIGGGHTS);
  CHECK(files.size() == 2 && files[1].name == ".in");
  body.write(MORULA_EXPORT_LIGGGHTS, "cpp_masses.txt");
  for (const auto &file : files) {
    const std::string path = "cpp_masses.txt" + file.name;
    std::ifstream in(path, std::ios::binary);
    const std::vector<std::uint8_t> read{std::istreambuf_iterator<char>(in), {}};
    CHECK(read == file.bytes);
    std::remove(path.c_str());
  }
  weighing.density = -1;
  CHECK(status_of([&] { morula::Body(clump, weighing); }) == MORULA_STATUS_INVALID_ARGUMENT);
  weighing.density = 1;
  CHECK(status_of([&] { morula::Body(clump, weighing, [](double) { return false; }); }) ==
        MORULA_STATUS_CANCELLED);
  CHECK(status_of([&] { body.files(-1); }) == MORULA_STATUS_INVALID_ARGUMENT);
  std::printf("%d checks, %d failed\n", made, failed);
  return failed != 0;
}
