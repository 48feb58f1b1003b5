// Stones drop into a box; one breaks in the air and is replaced within the time step, in MercuryDPM.
//
//   breaking_stones [MESH [SPHERES [FRAGMENTS]]]
//
// MESH: a file (STL, OBJ, PLY, OFF) in metres; without one the built-in stone, scaled to 2 cm.
#include "Mercury3DClump.h"

#include "morula_mercury.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace mm = morula::mercury;

constexpr double DENSITY = 2600;
constexpr double SIZE = 0.02;

struct Free {
  void operator()(morula_parent *p) const noexcept { morula_parent_free(p); }
  void operator()(morula_fragments *f) const noexcept { morula_fragments_free(f); }
};

/// A shape that may break: its clump, and what every break of it needs.
class Template {
 public:
  Template(const morula::Shape &shape, double scale, std::size_t spheres) : scale_(scale) {
    morula::ClumpOptions options;
    options.method = MORULA_METHOD_INSCRIBED;
    options.spheres = spheres;
    const morula::Solid solid(shape);
    const morula::Clump clump(solid, options);
    morula_parent *raw = nullptr;
    morula::check(morula_parent_from_clump(solid.get(), clump.get(), 1, &raw));
    parent_.reset(raw);
    // In metres, with its origin at the centre of mass.
    const morula_moments m = clump.moments(DENSITY);
    rigid_.mass = m.mass * scale * scale * scale;
    for (int k = 0; k < 3; k++)
      rigid_.principal[k] = m.principal[k] * scale * scale * scale * scale * scale;
    options.frame = MORULA_FRAME_BODY;
    for (auto s : morula::Clump(solid, options).spheres()) {
      for (auto &x : s.center) x *= scale;
      s.radius *= scale;
      rigid_.spheres.push_back(s);
    }
  }
  const mm::Rigid &rigid() const { return rigid_; }

  /// Breaks a particle of this template as it is now.
  std::unique_ptr<morula_fragments, Free> shatter(const ClumpParticle &p, unsigned pieces,
                                                  std::uint64_t seed) const {
    const auto position = mm::array(p.getPosition()), velocity = mm::array(p.getVelocity());
    const auto spin = mm::array(p.getAngularVelocity());
    const auto turned = mm::rotation(p);
    morula_held held;
    held.struct_size = sizeof held;
    morula::check(morula_parent_held(parent_.get(), DENSITY, scale_, position.data(),
                                     turned.data(), velocity.data(), spin.data(), &held));
    morula_break_options options;
    morula::check(morula_break_options_init(&options, sizeof options));
    options.kind = MORULA_CUT_SEEDED;
    options.cells = pieces;
    options.seed = seed;
    options.spheres = 10;
    morula_fragments *raw = nullptr;
    morula::check(
        morula_parent_break(parent_.get(), nullptr, 0, &held, &options, &raw));
    return std::unique_ptr<morula_fragments, Free>(raw);
  }
  double scale() const { return scale_; }

 private:
  double scale_;
  mm::Rigid rigid_;
  std::unique_ptr<morula_parent, Free> parent_;
};

/// A fragment as a body for MercuryDPM.
mm::Rigid body_of(const morula_fragments *fragments, std::size_t i, double scale) {
  morula_fragment f;
  f.struct_size = sizeof f;
  morula::check(morula_fragments_get(fragments, i, &f));
  std::vector<double> xyzr(4 * f.sphere_count);
  morula::check(morula_fragments_copy_spheres(fragments, i, MORULA_FRAME_BODY, f.sphere_count,
                                              xyzr.data()));
  mm::Rigid body;
  for (std::size_t k = 0; k < xyzr.size(); k += 4)
    body.spheres.push_back({{scale * xyzr[k], scale * xyzr[k + 1], scale * xyzr[k + 2]},
                            scale * xyzr[k + 3]});
  body.mass = f.mass;
  for (int k = 0; k < 3; k++) {
    body.principal[k] = f.principal[k];
    body.position[k] = f.position[k];
    body.velocity[k] = f.velocity[k];
    body.angular_velocity[k] = f.angular_velocity[k];
  }
  for (int k = 0; k < 4; k++) body.rotation[k] = f.quaternion[k];
  return body;
}

class BreakingStones : public Mercury3Dclump {
 public:
  BreakingStones(const Template &stone, unsigned pieces) : stone_(stone), pieces_(pieces) {
    setName("BreakingStones");
    setGravity(Vec3D(0, 0, -9.81));
    setMin(Vec3D(0, 0, 0));
    setMax(Vec3D(6 * SIZE, 6 * SIZE, 12 * SIZE));
  }

  void setupInitialConditions() override {
    const ParticleSpecies *species = speciesHandler.getObject(0);
    const auto turns = morula::random_orientations(1, 4);
    for (std::size_t i = 0; i < turns.size(); i++) {
      mm::Rigid body = stone_.rigid();
      body.rotation = turns[i];
      body.position = {(1.5 + 3.0 * (i % 2)) * SIZE, (1.5 + 3.0 * (i / 2)) * SIZE, 8 * SIZE};
      body.velocity = {0.1, 0, -0.5};
      body.angular_velocity = {20, 5.0 * i, -30};
      BaseParticle *added = particleHandler.copyAndAddObject(mm::particle(body, species));
      if (i == 0) breaks_ = dynamic_cast<ClumpParticle *>(added);
    }
    wallHandler.clear();
    InfiniteWall w;
    w.setSpecies(species);
    w.set(Vec3D(-1, 0, 0), Vec3D(getXMin(), 0, 0));
    wallHandler.copyAndAddObject(w);
    w.set(Vec3D(1, 0, 0), Vec3D(getXMax(), 0, 0));
    wallHandler.copyAndAddObject(w);
    w.set(Vec3D(0, -1, 0), Vec3D(0, getYMin(), 0));
    wallHandler.copyAndAddObject(w);
    w.set(Vec3D(0, 1, 0), Vec3D(0, getYMax(), 0));
    wallHandler.copyAndAddObject(w);
    w.set(Vec3D(0, 0, -1), Vec3D(0, 0, getZMin()));
    wallHandler.copyAndAddObject(w);
  }

  void actionsAfterTimeStep() override {
    if (breaks_ != nullptr && getTime() >= 0.02) {
      replace(*breaks_);
      breaks_ = nullptr;
    }
  }

  bool broken() const { return done_; }

 private:
  void replace(const ClumpParticle &old) {
    const auto begin = std::chrono::steady_clock::now();
    const auto fragments = stone_.shatter(old, pieces_, 7);
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - begin;
    std::size_t count = 0, crumbs = 0;
    morula::check(morula_fragments_count(fragments.get(), &count));
    morula::check(morula_fragments_dust_count(fragments.get(), &crumbs));
    const auto v = mm::array(old.getVelocity());
    double mass = 0;
    std::array<double, 3> momentum{};
    const auto add = [&](const morula_fragment &f) {
      mass += f.mass;
      for (int k = 0; k < 3; k++) momentum[k] += f.mass * f.velocity[k];
    };
    std::vector<mm::Rigid> bodies;
    morula_fragment f;
    f.struct_size = sizeof f;
    for (std::size_t i = 0; i < count; i++) {
      morula::check(morula_fragments_get(fragments.get(), i, &f));
      add(f);
      bodies.push_back(body_of(fragments.get(), i, stone_.scale()));
    }
    for (std::size_t i = 0; i < crumbs; i++) {
      morula::check(morula_fragments_dust(fragments.get(), i, &f));
      add(f);
    }
    const ParticleSpecies *species = old.getSpecies();
    const double before = stone_.rigid().mass;
    mm::remove(particleHandler, &old);
    for (const auto &body : bodies)
      particleHandler.copyAndAddObject(mm::particle(body, species));
    double lost = 0;
    for (int k = 0; k < 3; k++) lost = std::fmax(lost, std::fabs(momentum[k] / before - v[k]));
    std::printf("one stone became %zu fragments and %zu crumbs in %.2f ms; "
                "mass is off by %.1e, velocity by %.1e m/s\n",
                count, crumbs, took.count(), mass / before - 1, lost);
    done_ = count > 1 && std::fabs(mass / before - 1) < 1e-12 && lost < 1e-12;
  }

  const Template &stone_;
  unsigned pieces_;
  ClumpParticle *breaks_ = nullptr;
  bool done_ = false;
};

int main(int argc, char *argv[]) try {
  const auto number = [&](int i, unsigned or_else) {
    return argc > i ? static_cast<unsigned>(std::strtoul(argv[i], nullptr, 10)) : or_else;
  };
  const bool file = argc > 1;
  const auto shape =
      file ? morula::Shape::from_file(argv[1]) : morula::Shape::from_primitive("stone");
  // The built-in stone has the equivalent diameter 1.
  const Template stone(shape, file ? 1.0 : SIZE, number(2, 30));
  BreakingStones scene(stone, number(3, 5));
  auto *species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticFrictionSpecies());
  species->setDensity(DENSITY);
  species->setStiffness(1e4);
  species->setDissipation(0.05);
  species->setSlidingStiffness(2e3);
  species->setSlidingDissipation(0.02);
  species->setSlidingFrictionCoefficient(0.4);
  // Of the lightest fragments, about a hundredth of the stone.
  scene.setTimeStep(species->getCollisionTime(0.01 * stone.rigid().mass) / 50);
  scene.setTimeMax(0.3);
  scene.setSaveCount(200);
  scene.removeOldFiles();
  scene.solve();
  return scene.broken() ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
