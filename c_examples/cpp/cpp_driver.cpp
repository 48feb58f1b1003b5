// A driver as one writes it for MercuryDPM: load a shape, make a clump, hand
// spheres, mass and inertia to the particle class, put it into the domain.
//
//   cpp_driver [MESH] [-n SPHERES] [--density RHO] [--unit LENGTH] [--csv PREFIX] [--most D]
//
// Without a mesh it takes the built-in tablet, M&M, ellipsoid and a stone. It
// prints one row for each shape; --csv writes PREFIX_<shape>.csv; with --most it fails on a clump whose mismatch
// is above D, or that has fewer spheres.
#include <morula.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

// ---- the solver's side, with the names of MercuryDPM ----

struct Vec3D {
  double x, y, z;
};

struct MatrixSymmetric3D {
  double xx, xy, xz, yy, yz, zz;
};

struct Matrix3D {  // as MercuryDPM writes it, row by row
  double xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

class ClumpParticle {
 public:
  void addPebble(Vec3D position, double radius) { pebbles_.push_back({position, radius}); }
  void setPrincipalDirections(const Matrix3D &directions) { directions_ = directions; }
  void setInitInertia(const MatrixSymmetric3D &inertia) { inertia_ = inertia; }
  void setClumpMass(double mass) { mass_ = mass; }
  void setPosition(Vec3D position) { position_ = position; }

  std::size_t pebbleCount() const { return pebbles_.size(); }
  double mass() const { return mass_; }

  /// Pebble i in the world: the body frame turned by the directions and moved.
  Vec3D pebblePosition(std::size_t i) const {
    const Vec3D &p = pebbles_[i].position;
    const Matrix3D &d = directions_;
    return {position_.x + d.xx * p.x + d.xy * p.y + d.xz * p.z,
            position_.y + d.yx * p.x + d.yy * p.y + d.yz * p.z,
            position_.z + d.zx * p.x + d.zy * p.y + d.zz * p.z};
  }
  double pebbleRadius(std::size_t i) const { return pebbles_[i].radius; }

 private:
  struct Pebble {
    Vec3D position;
    double radius;
  };
  std::vector<Pebble> pebbles_;
  Matrix3D directions_{};
  MatrixSymmetric3D inertia_{};
  Vec3D position_{};
  double mass_ = 0;
};

// ---- the road from a shape to a particle ----

ClumpParticle makeParticle(const morula::Clump &clump, double density) {
  const morula_moments body = clump.moments(density);
  ClumpParticle particle;
  // Pebbles in the body frame: origin at the centre of mass, axes principal.
  for (const morula::Sphere &s : clump.spheres())
    particle.addPebble({s.center[0], s.center[1], s.center[2]}, s.radius);
  // e_j is column j of the matrix; morula gives the columns one after the other.
  const double *r = body.rotation;
  particle.setPrincipalDirections({r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]});
  // In its principal frame the inertia is diagonal.
  particle.setInitInertia({body.principal[0], 0, 0, body.principal[1], 0, body.principal[2]});
  particle.setClumpMass(body.mass);
  particle.setPosition({body.centre[0], body.centre[1], body.centre[2]});
  return particle;
}

struct Settings {
  std::string mesh, csv;
  std::uint64_t spheres = 50;
  double density = 1.0, unit = 1.0, most = HUGE_VAL;
};

void run(const std::string &name, const morula::Shape &shape, const Settings &settings) {
  morula::ClumpOptions options;
  options.spheres = settings.spheres;
  options.frame = MORULA_FRAME_BODY;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;

  const morula::Clump clump(shape, options);
  const ClumpParticle particle = makeParticle(clump, settings.density);

  const morula_overlap overlap = clump.overlap();
  const morula_surface surface = clump.surface();
  const morula_counters c = clump.counters();
  std::printf("%-12s %7zu %8.4f %8.4f %10.4g %12.5g %8.1f\n", name.c_str(),
              particle.pebbleCount(), overlap.mismatch, overlap.coverage, surface.protrusion,
              particle.mass(), 1e3 * (c.seconds_solid + c.seconds_generate));
  if (std::isfinite(settings.most) &&
      (!(overlap.mismatch <= settings.most) || particle.pebbleCount() != settings.spheres))
    throw std::runtime_error(name + " is not as close as --most asks");
  for (const std::string &note : shape.notes()) std::printf("  note: %s\n", note.c_str());
  if (!clump.note().empty()) std::printf("  note: %s\n", clump.note().c_str());

  if (!settings.csv.empty()) {
    std::ofstream file(settings.csv + "_" + name + ".csv");
    file.precision(17);
    file << "x,y,z,r\n";
    for (std::size_t i = 0; i < particle.pebbleCount(); ++i) {
      const Vec3D p = particle.pebblePosition(i);
      file << p.x << ',' << p.y << ',' << p.z << ',' << particle.pebbleRadius(i) << '\n';
    }
    if (!file.flush()) throw std::runtime_error("cannot write " + settings.csv + "_" + name + ".csv");
  }
}

int main(int argc, char **argv) try {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool takes_value = arg == "-n" || arg == "--density" || arg == "--unit" || arg == "--csv" ||
                             arg == "--most";
    if (arg[0] == '-' && (!takes_value || i + 1 == argc)) {
      std::cerr << "usage: cpp_driver [MESH] [-n SPHERES] [--density RHO] [--unit LENGTH] "
                   "[--csv PREFIX] [--most D]\n";
      return 2;
    }
    if (arg == "-n") settings.spheres = std::strtoull(argv[++i], nullptr, 10);
    else if (arg == "--density") settings.density = std::strtod(argv[++i], nullptr);
    else if (arg == "--unit") settings.unit = std::strtod(argv[++i], nullptr);
    else if (arg == "--most") settings.most = std::strtod(argv[++i], nullptr);
    else if (arg == "--csv") settings.csv = argv[++i];
    else settings.mesh = arg;
  }

  std::printf("%-12s %7s %8s %8s %10s %12s %8s\n", "shape", "spheres", "D", "coverage",
              "protrusion", "mass", "ms");
  if (!settings.mesh.empty()) {
    morula::ImportOptions import;
    import.length_unit = settings.unit;
    std::string name = settings.mesh.substr(settings.mesh.find_last_of("/\\") + 1);
    name = name.substr(0, name.find_last_of('.'));
    run(name, morula::Shape::from_file(settings.mesh, import), settings);
    return 0;
  }
  for (const char *name : {"tablet", "mandm", "ellipsoid"})
    run(name, morula::Shape::from_primitive(name), settings);
  run("stone", morula::Shape::from_primitive("stone", {}, 0, 7), settings);
  return 0;
} catch (const morula::Error &error) {
  std::cerr << error.name() << ": " << error.what() << '\n';
  return 1;
} catch (const std::exception &error) {
  std::cerr << error.what() << '\n';
  return 1;
}
