// Mass, centre of mass and moments of inertia of a link.
#ifndef IGNITION_MATH_INERTIAL_HH_
#define IGNITION_MATH_INERTIAL_HH_

#include <ignition/math/Matrix3.hh>
#include <ignition/math/Pose3.hh>

namespace ignition {
namespace math {

template <typename T>
class MassMatrix3 {
 public:
  MassMatrix3() : mass(0) {}
  MassMatrix3(const T& mass, const Vector3<T>& diagonal, const Vector3<T>& off_diagonal)
      : mass(mass), diagonal(diagonal), off(off_diagonal) {}
  T Mass() const { return mass; }
  bool Mass(const T& value) {
    mass = value;
    return mass > T(0);
  }
  bool SetMass(const T& value) { return Mass(value); }
  T Ixx() const { return diagonal.X(); }
  T Iyy() const { return diagonal.Y(); }
  T Izz() const { return diagonal.Z(); }
  T Ixy() const { return off.X(); }
  T Ixz() const { return off.Y(); }
  T Iyz() const { return off.Z(); }
  Vector3<T> DiagonalMoments() const { return diagonal; }
  Vector3<T> OffDiagonalMoments() const { return off; }
  Matrix3<T> Moi() const { return {Ixx(), Ixy(), Ixz(), Ixy(), Iyy(), Iyz(), Ixz(), Iyz(), Izz()}; }
  Matrix3<T> MOI() const { return Moi(); }

 private:
  T mass;
  Vector3<T> diagonal, off;
};

typedef MassMatrix3<double> MassMatrix3d;
typedef MassMatrix3<float> MassMatrix3f;

template <typename T>
class Inertial {
 public:
  Inertial() {}
  Inertial(const MassMatrix3<T>& mass_matrix, const Pose3<T>& pose) : mass_matrix(mass_matrix), pose(pose) {}
  const ::ignition::math::MassMatrix3<T>& MassMatrix() const { return mass_matrix; }
  const Pose3<T>& Pose() const { return pose; }
  Matrix3<T> Moi() const {
    const Matrix3<T> rotation(pose.Rot());
    return rotation * mass_matrix.Moi() * rotation.Transposed();
  }
  Matrix3<T> MOI() const { return Moi(); }

 private:
  MassMatrix3<T> mass_matrix;
  Pose3<T> pose;
};

typedef Inertial<double> Inertiald;
typedef Inertial<float> Inertialf;

}  // namespace math
}  // namespace ignition

#endif
