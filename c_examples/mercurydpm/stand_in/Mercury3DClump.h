// As Particles/ClumpParticle.h beside it: it stands in for MercuryDPM in tests, and moves bodies freely.
#include "Particles/ClumpParticle.h"

#include <cmath>

class LinearViscoelasticFrictionSpecies : public ParticleSpecies {
 public:
  void setStiffness(Mdouble stiffness) { stiffness_ = stiffness; }
  void setDissipation(Mdouble) {}
  void setSlidingStiffness(Mdouble) {}
  void setSlidingDissipation(Mdouble) {}
  void setSlidingFrictionCoefficient(Mdouble) {}
  Mdouble getCollisionTime(Mdouble mass) const { return 2.2 / std::sqrt(2 * stiffness_ / mass); }

 private:
  Mdouble stiffness_ = 0;
};

class SpeciesHandler {
 public:
  ParticleSpecies *getObject(unsigned i) const { return all_[i].get(); }
  template <class U>
  U *copyAndAddObject(const U &object) {
    auto *copy = new U(object);
    all_.emplace_back(copy);
    return copy;
  }

 private:
  std::vector<std::shared_ptr<ParticleSpecies>> all_;
};

class InfiniteWall {
 public:
  void setSpecies(const ParticleSpecies *) {}
  void set(Vec3D, Vec3D) {}
};

class WallHandler {
 public:
  void clear() {}
  void copyAndAddObject(const InfiniteWall &) {}
};

class Mercury3D {
 public:
  virtual ~Mercury3D() = default;
  virtual void setupInitialConditions() {}
  virtual void actionsAfterTimeStep() {}
  void setName(const std::string &) {}
  void setGravity(Vec3D gravity) { gravity_ = gravity; }
  void setMin(const Vec3D &min) { min_ = min; }
  void setMax(const Vec3D &max) { max_ = max; }
  Mdouble getXMin() const { return min_.X; }
  Mdouble getXMax() const { return max_.X; }
  Mdouble getYMin() const { return min_.Y; }
  Mdouble getYMax() const { return max_.Y; }
  Mdouble getZMin() const { return min_.Z; }
  Mdouble getZMax() const { return max_.Z; }
  void setTimeStep(Mdouble step) { step_ = step; }
  void setTimeMax(Mdouble end) { end_ = end; }
  void setSaveCount(unsigned) {}
  Mdouble getTime() const { return time_; }
  Mdouble getTimeStep() const { return step_; }
  void removeOldFiles() const {}
  void solve() {
    setupInitialConditions();
    while (time_ < end_) {
      for (unsigned i = 0; i < particleHandler.getSize(); i++) {
        BaseParticle *p = particleHandler.getObject(i);
        if (p->isPebble()) continue;
        Vec3D v = p->getVelocity(), x = p->getPosition();
        v = {v.X + step_ * gravity_.X, v.Y + step_ * gravity_.Y, v.Z + step_ * gravity_.Z};
        p->setVelocity(v);
        p->setPosition({x.X + step_ * v.X, x.Y + step_ * v.Y, x.Z + step_ * v.Z});
      }
      time_ += step_;
      actionsAfterTimeStep();
    }
  }
  SpeciesHandler speciesHandler;
  ParticleHandler particleHandler;
  WallHandler wallHandler;

 private:
  Vec3D gravity_, min_, max_;
  Mdouble time_ = 0, step_ = 0, end_ = 0;
};

class Mercury3Dclump : public Mercury3D {};
