// Friction of a collision.
#ifndef GAZEBO_PHYSICS_SURFACEPARAMS_HH_
#define GAZEBO_PHYSICS_SURFACEPARAMS_HH_

#include <boost/make_shared.hpp>

#include <gazebo/math/Vector3.hh>
#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo {
namespace physics {

// Coefficients along two directions, as read from the file; the simulation has no way to change them while it runs, so
// there are no functions that set them.
class FrictionPyramid {
 public:
  FrictionPyramid() : mu1_(1.0), mu2_(1.0) {}
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
  SurfaceParams() : friction_(boost::make_shared<physics::FrictionPyramid>()), collideWithoutContact(false) {}
  virtual ~SurfaceParams() {}
  FrictionPyramidPtr FrictionPyramid() const { return friction_; }

 private:
  FrictionPyramidPtr friction_;

 public:
  bool collideWithoutContact;
};

}  // namespace physics
}  // namespace gazebo

#endif
