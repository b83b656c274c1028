#include <ignition/math/Angle.hh>

namespace ignition {
namespace math {

const Angle Angle::Zero(0.0), Angle::Pi(IGN_PI), Angle::HalfPi(IGN_PI_2), Angle::TwoPi(2 * IGN_PI);

}  // namespace math
}  // namespace ignition
