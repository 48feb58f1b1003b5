// Clumps in MercuryDPM, for drivers: bodies become ClumpParticles with their own moments, and leave the
// particle handler with all their pebbles. Include it after Mercury3DClump.h or alone.
//
// MercuryDPM moves a clump by its moments about its body axes: spheres are given in the body frame (origin at
// the centre of mass, principal axes), as the library gives them with MORULA_FRAME_BODY.
#ifndef MORULA_MERCURY_HPP
#define MORULA_MERCURY_HPP

#include "morula.hpp"

#include "Particles/ClumpParticle.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace morula {
namespace mercury {

/// A rigid body: a template, where it is and how it moves.
struct Rigid {
  /// In the body frame.
  std::vector<Sphere> spheres;
  double mass = 0;
  /// Principal moments about the body axes.
  std::array<double, 3> principal{};
  /// From the body axes to the world's, w, x, y, z.
  std::array<double, 4> rotation{1, 0, 0, 0};
  /// Of the centre of mass.
  std::array<double, 3> position{};
  std::array<double, 3> velocity{};
  std::array<double, 3> angular_velocity{};
};

inline Vec3D vector(const std::array<double, 3> &v) { return Vec3D(v[0], v[1], v[2]); }
inline std::array<double, 3> array(const Vec3D &v) { return {v.X, v.Y, v.Z}; }

/// The matrix whose columns are the turned axes.
inline Matrix3D matrix(const std::array<double, 4> &q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return Matrix3D(1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),
                  s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w),
                  s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y));
}

/// First q, then p.
inline std::array<double, 4> product(const std::array<double, 4> &p,
                                     const std::array<double, 4> &q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
          p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
          p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

/// The other way round, of a quaternion of length 1.
inline std::array<double, 4> inverse(const std::array<double, 4> &q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

/// The rotation of a clump, from its body axes to the world's (Shepperd 1978: from the largest component).
inline std::array<double, 4> rotation(const ClumpParticle &clump) {
  const Vec3D a = clump.getPrincipalDirections_e1(), b = clump.getPrincipalDirections_e2(),
              c = clump.getPrincipalDirections_e3();
  const double trace = a.X + b.Y + c.Z;
  std::array<double, 4> q;
  if (trace >= a.X && trace >= b.Y && trace >= c.Z)
    q = {1 + trace, b.Z - c.Y, c.X - a.Z, a.Y - b.X};
  else if (a.X >= b.Y && a.X >= c.Z)
    q = {b.Z - c.Y, 1 + 2 * a.X - trace, a.Y + b.X, c.X + a.Z};
  else if (b.Y >= c.Z)
    q = {c.X - a.Z, a.Y + b.X, 1 + 2 * b.Y - trace, b.Z + c.Y};
  else
    q = {a.Y - b.X, c.X + a.Z, b.Z + c.Y, 1 + 2 * c.Z - trace};
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (auto &x : q) x /= length;
  return q;
}

/// A clump that is ready for particleHandler.copyAndAddObject(). Its tensor of inertia is turned with it: without
/// that the first half step would take that of the body axes for the world's.
inline ClumpParticle particle(const Rigid &body, const ParticleSpecies *species) {
  ClumpParticle p;
  p.setSpecies(species);
  p.setClump();
  double radius = 0;
  for (const auto &s : body.spheres) radius = std::fmax(radius, s.radius);
  p.setRadius(radius);  // for the contact grid
  for (const auto &s : body.spheres) p.addPebble(vector(s.center), s.radius);
  p.setPrincipalDirections(matrix(body.rotation));
  p.setInitInertia(
      MatrixSymmetric3D(body.principal[0], 0, 0, body.principal[1], 0, body.principal[2]));
  p.rotateTensorOfInertia();
  p.setClumpMass(body.mass);
  p.setDamping(0);
  p.setPosition(vector(body.position));
  p.setVelocity(vector(body.velocity));
  p.setAngularVelocity(vector(body.angular_velocity));
  return p;
}

/// Takes a clump and all its pebbles out of the handler (the world's own ParticleHandler).
template <class Handler>
void remove(Handler &handler, const BaseParticle *clump) {
  // From the last: what is behind a removed particle changes its place.
  for (auto i = handler.getSize(); i-- > 0;) {
    const BaseParticle *p = handler.getObject(i);
    if (p->isPebble() && p->getClump() == clump) handler.removeObject(i);
  }
  for (auto i = handler.getSize(); i-- > 0;)
    if (handler.getObject(i) == clump) {
      handler.removeObject(i);
      break;
    }
}

}  // namespace mercury
}  // namespace morula

#endif
