// A stone that breaks in the middle of a simulation. The solver is a few lines (gravity and a
// floor); the handler has the manner of MercuryDPM's: it looks after each time step whether
// something breaks, and replaces it at once. What is conserved and how long it took is printed.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <morula.hpp>

namespace {

using Vec = std::array<double, 3>;
using Quaternion = std::array<double, 4>;

Vec operator+(const Vec &a, const Vec &b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec &a, const Vec &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(double s, const Vec &a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vec &a, const Vec &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec &a, const Vec &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// q v q*
Vec turned(const Quaternion &q, const Vec &v) {
  const Vec u{q[1], q[2], q[3]}, t = 2.0 * cross(u, v);
  return v + q[0] * t + cross(u, t);
}
Vec turned_back(const Quaternion &q, const Vec &v) { return turned({q[0], -q[1], -q[2], -q[3]}, v); }

/// A rigid body of spheres, in its body frame.
struct Particle {
  double mass;
  Vec principal;
  morula::Motion motion;
  std::vector<morula::Sphere> spheres;
  double force = 0;

  Vec spin() const {
    Vec l = turned_back(motion.quaternion, motion.angular_velocity);
    for (int a = 0; a < 3; ++a) l[a] *= principal[a];
    return turned(motion.quaternion, l);
  }
};

/// Mass, momentum, angular momentum about the origin, kinetic energy.
struct Totals {
  double mass = 0, energy = 0;
  Vec momentum{}, angular{};
  void add(const Particle &p) {
    const auto &m = p.motion;
    mass += p.mass;
    momentum = momentum + p.mass * m.velocity;
    angular = angular + p.spin() + p.mass * cross(m.position, m.velocity);
    energy += 0.5 * p.mass * dot(m.velocity, m.velocity) + 0.5 * dot(p.spin(), m.angular_velocity);
  }
};

/// Gravity, a floor at z = 0 with a linear spring and a dashpot, explicit steps.
class Solver {
 public:
  virtual ~Solver() = default;
  std::vector<Particle> particles;
  double step = 1e-5, time = 0;

  void solve(int steps) {
    for (int i = 0; i < steps; ++i, time += step) {
      for (auto &p : particles) move(p);
      actionsAfterTimeStep();
    }
  }

 protected:
  virtual void actionsAfterTimeStep() {}

 private:
  void move(Particle &p) const {
    auto &m = p.motion;
    Vec force{0, 0, -9.81 * p.mass}, torque{};
    p.force = 0;
    for (const auto &s : p.spheres) {
      const Vec arm = turned(m.quaternion, s.center);
      const double deep = s.radius - (m.position[2] + arm[2]);
      if (deep <= 0) continue;
      const Vec lever = arm - Vec{0, 0, s.radius}, speed = m.velocity + cross(m.angular_velocity, lever);
      const double push = std::fmax(0.0, 1e5 * deep - 20 * speed[2]);
      force[2] += push;
      torque = torque + cross(lever, {0, 0, push});
      p.force += push;
    }
    m.velocity = m.velocity + (step / p.mass) * force;
    // Euler's equations in the body frame.
    Vec w = turned_back(m.quaternion, m.angular_velocity), t = turned_back(m.quaternion, torque), l{};
    for (int a = 0; a < 3; ++a) l[a] = p.principal[a] * w[a];
    const Vec gyro = cross(w, l);
    for (int a = 0; a < 3; ++a) w[a] += step * (t[a] - gyro[a]) / p.principal[a];
    m.angular_velocity = turned(m.quaternion, w);
    m.position = m.position + step * m.velocity;
    auto &q = m.quaternion;
    const Vec u{q[1], q[2], q[3]}, half = (0.5 * step) * m.angular_velocity;
    const Vec du = q[0] * half + cross(half, u);
    q = {q[0] - dot(half, u), q[1] + du[0], q[2] + du[1], q[3] + du[2]};
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (auto &c : q) c /= norm;
  }
};

/// Breaks a particle when the floor pushes it too hard.
class Breakage : public Solver {
 public:
  Breakage(const morula::Parent &parent, double density, double scale, double strength)
      : parent_(parent), density_(density), scale_(scale), strength_(strength) {}

  int breaks = 0;
  bool sound = true;

 protected:
  void actionsAfterTimeStep() override {
    if (breaks > 0 || particles.empty() || particles[0].force < strength_) return;
    ++breaks;
    const Particle old = particles[0];
    morula::BreakOptions options;
    options.cells = 6;
    options.seed = 7;
    options.spheres = 20;
    const auto start = std::chrono::steady_clock::now();
    const morula::Fragments fragments(parent_, parent_.held(density_, old.motion, scale_), options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    particles.erase(particles.begin());
    Totals before, after;
    before.add(old);
    const auto taken = [](const morula_fragment &f) {
      Particle p;
      p.mass = f.mass;
      for (int a = 0; a < 3; ++a) {
        p.principal[a] = f.principal[a];
        p.motion.position[a] = f.position[a];
        p.motion.velocity[a] = f.velocity[a];
        p.motion.angular_velocity[a] = f.angular_velocity[a];
      }
      for (int a = 0; a < 4; ++a) p.motion.quaternion[a] = f.quaternion[a];
      return p;
    };
    std::printf("t = %.4f s: %zu fragments and %zu pieces of dust in %.2f ms\n", time,
                fragments.size(), fragments.dust().size(), 1e3 * took.count());
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const auto f = fragments[i];
      Particle p = taken(f);
      p.spheres = fragments.spheres(i, MORULA_FRAME_BODY);
      after.add(p);
      std::printf("  mass %.4f, %2zu spheres, coverage %.3f, time step x %.2f\n", p.mass,
                  p.spheres.size(), f.coverage, f.step_factor);
      particles.push_back(p);
    }
    // A solver may keep the dust; here it is only counted.
    for (const auto &f : fragments.dust()) after.add(taken(f));
    report(before, after);
    overlaps(fragments);
  }

 private:
  void say(const char *what, double error, double most) {
    std::printf("  %-26s %.1e\n", what, error);
    if (!(error <= most)) sound = false;
  }
  void report(const Totals &a, const Totals &b) {
    const auto off = [](const Vec &x, const Vec &y) {
      return std::sqrt(dot(x - y, x - y) / dot(x, x));
    };
    say("relative error of mass", std::fabs(b.mass / a.mass - 1), 1e-12);
    say("of momentum", off(a.momentum, b.momentum), 1e-12);
    say("of angular momentum", off(a.angular, b.angular), 1e-11);
    say("of kinetic energy", std::fabs(b.energy / a.energy - 1), 1e-11);
  }
  void overlaps(const morula::Fragments &fragments) {
    double deepest = -1e300;
    for (std::size_t i = 0; i < fragments.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const auto &s : fragments.spheres(i, MORULA_FRAME_WORLD))
          for (const auto &t : fragments.spheres(j, MORULA_FRAME_WORLD)) {
            const Vec d = s.center - t.center;
            deepest = std::fmax(deepest, s.radius + t.radius - std::sqrt(dot(d, d)));
          }
    say("deepest overlap of siblings", deepest, 1e-15);
  }

  const morula::Parent &parent_;
  double density_, scale_, strength_;
};

}  // namespace

int main() try {
  const morula::Shape shape = morula::Shape::from_primitive("stone");
  const morula::Solid solid(shape);
  morula::ClumpOptions options;
  options.spheres = 40;
  options.method = MORULA_METHOD_INSCRIBED;
  const morula::Clump clump(solid, options);
  const morula::Parent parent(solid, clump);

  const double density = 2600, scale = 0.05;
  const auto m = solid.moments(density);
  Particle stone;
  stone.mass = m.mass * std::pow(scale, 3);
  for (int a = 0; a < 3; ++a) stone.principal[a] = m.principal[a] * std::pow(scale, 5);
  const morula::Body body(clump);
  for (auto s : body.spheres(MORULA_FRAME_BODY)) {
    for (auto &c : s.center) c *= scale;
    s.radius *= scale;
    stone.spheres.push_back(s);
  }
  stone.motion.position = {0, 0, 0.3};
  stone.motion.velocity = {0.5, 0, -3};
  stone.motion.angular_velocity = {4, -7, 2};

  Breakage scene(parent, density, scale, 60 * stone.mass * 9.81);
  scene.particles.push_back(stone);
  scene.solve(20000);
  std::printf("t = %.4f s: %zu particles\n", scene.time, scene.particles.size());
  bool fine = scene.breaks == 1 && scene.sound && scene.particles.size() >= 4;
  for (const auto &p : scene.particles) fine = fine && std::fabs(p.motion.position[2]) < 1;

  // Many in one step, and a fragment that breaks once more.
  const auto both = morula::Fragments::of_parents({&parent, &parent},
                                                  {parent.held(density), parent.held(density)},
                                                  {morula::BreakOptions(), morula::BreakOptions()});
  const morula::Fragments again(both[1], 0, both[1].held(0));
  const auto part = again.shape(0);
  fine = fine && both.size() == 2 && again.size() > 1 && !again.map(0).parents.empty();
  fine = fine && std::fabs(part.moments().volume / again[0].volume - 1) < 1e-10;
  fine = fine && again.grown(0, 1, {})[0].radius >= again.spheres(0)[0].radius;
  fine = fine && !again.half_spaces(0).empty() && again.notes().empty();
  std::puts(fine ? "all is well" : "NOT as it should be");
  return fine ? 0 : 1;
} catch (const morula::Error &e) {
  std::fprintf(stderr, "%s: %s\n", e.name(), e.what());
  return 1;
}
