#include <gazebo/math/gzmath.hh>

namespace gazebo {
namespace math {

const Angle Angle::Zero(0.0), Angle::Pi(IGN_PI), Angle::HalfPi(IGN_PI_2), Angle::TwoPi(2 * IGN_PI);
const Vector3 Vector3::Zero(0, 0, 0), Vector3::One(1, 1, 1), Vector3::UnitX(1, 0, 0), Vector3::UnitY(0, 1, 0),
    Vector3::UnitZ(0, 0, 1);
const Matrix4 Matrix4::IDENTITY(ignition::math::Matrix4d(ignition::math::Quaterniond(1, 0, 0, 0)));
const Matrix4 Matrix4::ZERO;
const Pose Pose::Zero;

}  // namespace math
}  // namespace gazebo
