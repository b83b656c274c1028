#include <gazebo/common/SphericalCoordinates.hh>

#include <cmath>

namespace gazebo {
namespace common {

using ignition::math::Vector3d;

namespace {

// Ellipsoid of WGS 84: semi-major axis [m], flattening.
constexpr double kMajor = 6378137.0, kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kDegrees = 180.0 / 3.14159265358979323846;

Vector3d earth_centred(double latitude, double longitude, double height) {
  const double s = std::sin(latitude), n = kMajor / std::sqrt(1.0 - kEccentricity2 * s * s);
  const double flat = (n + height) * std::cos(latitude);
  return {flat * std::cos(longitude), flat * std::sin(longitude), (n * (1.0 - kEccentricity2) + height) * s};
}

}  // namespace

Vector3d SphericalCoordinates::GlobalFromLocal(const Vector3d& velocity) const {
  const double c = std::cos(heading_.Radian()), s = std::sin(heading_.Radian());
  return {velocity.X() * c - velocity.Y() * s, velocity.X() * s + velocity.Y() * c, velocity.Z()};
}

Vector3d SphericalCoordinates::SphericalFromLocal(const Vector3d& point) const {
  const double lat = latitude_.Radian(), lon = longitude_.Radian();
  const Vector3d enu = GlobalFromLocal(point), origin = earth_centred(lat, lon, elevation_);
  const double north_in = -std::sin(lat) * enu.Y() + std::cos(lat) * enu.Z();  // along the meridian's plane
  const double x = origin.X() - std::sin(lon) * enu.X() + std::cos(lon) * north_in;
  const double y = origin.Y() + std::cos(lon) * enu.X() + std::sin(lon) * north_in;
  const double z = origin.Z() + std::cos(lat) * enu.Y() + std::sin(lat) * enu.Z();
  const double p = std::hypot(x, y);
  double latitude = std::atan2(z, p * (1.0 - kEccentricity2)), height = 0.0;
  for (int i = 0; i < 8; ++i) {  // converges to less than a micrometre near the ground
    const double s = std::sin(latitude), n = kMajor / std::sqrt(1.0 - kEccentricity2 * s * s);
    height = std::abs(latitude) < 1.0 ? p / std::cos(latitude) - n : z / s - n * (1.0 - kEccentricity2);
    latitude = std::atan2(z, p * (1.0 - kEccentricity2 * n / (n + height)));
  }
  return {latitude * kDegrees, std::atan2(y, x) * kDegrees, height};
}

}  // namespace common
}  // namespace gazebo
