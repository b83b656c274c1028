#ifndef GAZEBO_COMMON_SPHERICALCOORDINATES_HH_
#define GAZEBO_COMMON_SPHERICALCOORDINATES_HH_

#include <boost/shared_ptr.hpp>

#include <ignition/math/Angle.hh>
#include <ignition/math/Vector3.hh>

namespace gazebo {
namespace common {

// Geographic position of the world's origin, and of points in its axes: x to the east, y to the north, turned by the
// heading.
class SphericalCoordinates {
 public:
  enum SurfaceType { EARTH_WGS84 = 1 };

  SphericalCoordinates() : SphericalCoordinates(EARTH_WGS84) {}
  explicit SphericalCoordinates(const SurfaceType) : elevation_(0.0) {}
  SphericalCoordinates(const SurfaceType, const ignition::math::Angle& latitude, const ignition::math::Angle& longitude,
                       double elevation, const ignition::math::Angle& heading)
      : latitude_(latitude), longitude_(longitude), heading_(heading), elevation_(elevation) {}

  ignition::math::Angle LatitudeReference() const { return latitude_; }
  ignition::math::Angle LongitudeReference() const { return longitude_; }
  double GetElevationReference() const { return elevation_; }
  ignition::math::Angle HeadingOffset() const { return heading_; }
  void SetLatitudeReference(const ignition::math::Angle& angle) { latitude_ = angle; }
  void SetLongitudeReference(const ignition::math::Angle& angle) { longitude_ = angle; }
  void SetElevationReference(double elevation) { elevation_ = elevation; }
  void SetHeadingOffset(const ignition::math::Angle& angle) { heading_ = angle; }

  // Latitude and longitude [deg] and elevation [m] of a point [m], by the ellipsoid of WGS 84.
  ignition::math::Vector3d SphericalFromLocal(const ignition::math::Vector3d& point) const;
  // Velocity to the east, north and up of one in the world's axes.
  ignition::math::Vector3d GlobalFromLocal(const ignition::math::Vector3d& velocity) const;

 private:
  ignition::math::Angle latitude_, longitude_, heading_;
  double elevation_;
};
typedef boost::shared_ptr<SphericalCoordinates> SphericalCoordinatesPtr;

}  // namespace common
}  // namespace gazebo

#endif
