// Friction of a collision.
#ifndef GAZEBO_PHYSICS_SURFACEPARAMS_HH_
#define GAZEBO_PHYSICS_SURFACEPARAMS_HH_

#include <vector>

#include <boost/make_shared.hpp>

#include <gazebo/math/Vector3.hh>
#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo {
namespace physics {

// Coefficients along two directions. What a plugin changes is an edit of the world, at most ten times a second.
class FrictionPyramid {
 public:
  FrictionPyramid() : mu1_(1.0), mu2_(1.0) {}
  void SetMuPrimary(double mu) { mu1_ = mu; }
  void SetMuSecondary(double mu) { mu2_ = mu; }
  double MuPrimary() const { return mu1_; }
  double MuSecondary() const { return mu2_; }
  double GetMuPrimary() const { return mu1_; }
  double GetMuSecondary() const { return mu2_; }

  math::Vector3 direction1;

 private:
  friend struct Builder;
  double mu1_, mu2_;
};

class SurfaceParams {
 public:
  SurfaceParams() : collideWithoutContact(false), friction_(boost::make_shared<physics::FrictionPyramid>()) {}
  virtual ~SurfaceParams() {}
  FrictionPyramidPtr FrictionPyramid() const { return friction_; }

  // Whether contacts are seen, and have no force.
  bool collideWithoutContact;

 private:
  friend class Collision;
  friend struct Builder;
  // What the simulation has: coefficients, direction, whether there is no force.
  std::vector<double> Values() const;

  FrictionPyramidPtr friction_;
  std::vector<double> sent_;
};

}  // namespace physics
}  // namespace gazebo

#endif
