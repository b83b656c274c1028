#ifndef GAZEBO_PHYSICS_INERTIAL_HH_
#define GAZEBO_PHYSICS_INERTIAL_HH_

#include <ignition/math/Inertial.hh>

#include <gazebo/math/Pose.hh>

namespace gazebo {
namespace physics {

// Mass [kg], centre of mass in the link's frame [m], and moments about it [kg·m²].
class Inertial {
 public:
  Inertial() {}
  explicit Inertial(const ignition::math::Inertiald& inertial) : inertial_(inertial) {}
  double Mass() const { return inertial_.MassMatrix().Mass(); }
  const ignition::math::Vector3d& CoG() const { return inertial_.Pose().Pos(); }
  const ignition::math::Pose3d Pose() const { return inertial_.Pose(); }
  ignition::math::Vector3d PrincipalMoments() const { return inertial_.MassMatrix().DiagonalMoments(); }
  ignition::math::Vector3d ProductsOfInertia() const { return inertial_.MassMatrix().OffDiagonalMoments(); }
  double IXX() const { return inertial_.MassMatrix().Ixx(); }
  double IYY() const { return inertial_.MassMatrix().Iyy(); }
  double IZZ() const { return inertial_.MassMatrix().Izz(); }
  double IXY() const { return inertial_.MassMatrix().Ixy(); }
  double IXZ() const { return inertial_.MassMatrix().Ixz(); }
  double IYZ() const { return inertial_.MassMatrix().Iyz(); }
  ignition::math::Matrix3d MOI() const { return inertial_.MassMatrix().Moi(); }
  ignition::math::Inertiald Ign() const { return inertial_; }

  // Names up to Gazebo 8.
  double GetMass() const { return Mass(); }
  math::Vector3 GetCoG() const { return CoG(); }
  const math::Pose GetPose() const { return Pose(); }
  math::Vector3 GetPrincipalMoments() const { return PrincipalMoments(); }
  math::Vector3 GetProductsofInertia() const { return ProductsOfInertia(); }
  double GetIXX() const { return IXX(); }
  double GetIYY() const { return IYY(); }
  double GetIZZ() const { return IZZ(); }
  double GetIXY() const { return IXY(); }
  double GetIXZ() const { return IXZ(); }
  double GetIYZ() const { return IYZ(); }
  math::Matrix3 GetMOI() const { return MOI(); }

 private:
  ignition::math::Inertiald inertial_;
};

}  // namespace physics
}  // namespace gazebo

#endif
