// Stands in for MercuryDPM where it is not installed: what the driver and the adapter call of it, so that a
// compiler can check them and a test can run them. Bodies fly freely; there are no contacts. A driver is
// built against MercuryDPM itself, never against this.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

using Mdouble = double;

struct Vec3D {
  Mdouble X = 0, Y = 0, Z = 0;
  Vec3D() = default;
  Vec3D(Mdouble x, Mdouble y, Mdouble z) : X(x), Y(y), Z(z) {}
};

struct Matrix3D {
  Mdouble XX, XY, XZ, YX, YY, YZ, ZX, ZY, ZZ;
  Matrix3D(Mdouble xx, Mdouble xy, Mdouble xz, Mdouble yx, Mdouble yy, Mdouble yz, Mdouble zx,
           Mdouble zy, Mdouble zz)
      : XX(xx), XY(xy), XZ(xz), YX(yx), YY(yy), YZ(yz), ZX(zx), ZY(zy), ZZ(zz) {}
};

struct MatrixSymmetric3D {
  Mdouble XX, XY, XZ, YY, YZ, ZZ;
  MatrixSymmetric3D(Mdouble xx, Mdouble xy, Mdouble xz, Mdouble yy, Mdouble yz, Mdouble zz)
      : XX(xx), XY(xy), XZ(xz), YY(yy), YZ(yz), ZZ(zz) {}
};

class ParticleSpecies {
 public:
  void setDensity(Mdouble) {}
};

class BaseParticle {
 public:
  virtual ~BaseParticle() = default;
  bool isClump() const { return isClump_; }
  bool isPebble() const { return clumpParticle != nullptr; }
  BaseParticle *getClump() const { return clumpParticle; }
  void setSpecies(const ParticleSpecies *species) { species_ = species; }
  const ParticleSpecies *getSpecies() const { return species_; }
  void setRadius(Mdouble radius) { radius_ = radius; }
  Mdouble getRadius() const { return radius_; }
  const Vec3D &getPosition() const { return position_; }
  const Vec3D &getVelocity() const { return velocity_; }
  const Vec3D &getAngularVelocity() const { return angularVelocity_; }
  void setPosition(const Vec3D &v) { position_ = v; }
  void setVelocity(const Vec3D &v) { velocity_ = v; }
  void setAngularVelocity(const Vec3D &v) { angularVelocity_ = v; }

 protected:
  friend class ParticleHandler;
  bool isClump_ = false;
  BaseParticle *clumpParticle = nullptr;
  const ParticleSpecies *species_ = nullptr;
  Mdouble radius_ = 0;
  Vec3D position_, velocity_, angularVelocity_;
};

class ClumpParticle final : public BaseParticle {
 public:
  void setClump() { isClump_ = true; }
  void addPebble(Vec3D position, Mdouble radius) {
    pebblePos_.push_back(position);
    pebbleRadius_.push_back(radius);
  }
  int NPebble() const { return static_cast<int>(pebbleRadius_.size()); }
  void setPrincipalDirections(Matrix3D directions) { directions_ = directions; }
  void setInitInertia(MatrixSymmetric3D) { turned_ = false; }
  void rotateTensorOfInertia() { turned_ = true; }
  void setClumpMass(Mdouble mass) { mass_ = mass; }
  Mdouble getMass() const { return mass_; }
  void setDamping(Mdouble) {}
  Vec3D getPrincipalDirections_e1() const {
    return {directions_.XX, directions_.YX, directions_.ZX};
  }
  Vec3D getPrincipalDirections_e2() const {
    return {directions_.XY, directions_.YY, directions_.ZY};
  }
  Vec3D getPrincipalDirections_e3() const {
    return {directions_.XZ, directions_.YZ, directions_.ZZ};
  }

 private:
  friend class ParticleHandler;
  std::vector<Vec3D> pebblePos_;
  std::vector<Mdouble> pebbleRadius_;
  Matrix3D directions_{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool turned_ = false;
  Mdouble mass_ = 1;
};

class ParticleHandler {
 public:
  unsigned getSize() const { return static_cast<unsigned>(all_.size()); }
  BaseParticle *getObject(unsigned i) const { return all_[i].get(); }
  /// As MercuryDPM does, the last one takes the place.
  void removeObject(unsigned i) {
    if (i + 1 < all_.size()) all_[i] = std::move(all_.back());
    all_.pop_back();
  }
  /// The clump, then a particle for each of its pebbles.
  ClumpParticle *copyAndAddObject(const ClumpParticle &p) {
    if (!p.turned_) return nullptr;  // its first half step would be wrong
    auto *clump = new ClumpParticle(p);
    all_.emplace_back(clump);
    for (const Mdouble radius : p.pebbleRadius_) {
      auto *pebble = new ClumpParticle;
      pebble->setRadius(radius);
      pebble->clumpParticle = clump;
      all_.emplace_back(pebble);
    }
    return clump;
  }

 private:
  std::vector<std::unique_ptr<BaseParticle>> all_;
};
