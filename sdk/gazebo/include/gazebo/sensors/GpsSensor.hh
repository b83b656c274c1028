#ifndef GAZEBO_SENSORS_GPSSENSOR_HH_
#define GAZEBO_SENSORS_GPSSENSOR_HH_

#include <gazebo/math/Angle.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// Position above the ellipsoid [m].
class GpsSensor : public Sensor {
 public:
  GpsSensor() : Sensor(OTHER) {}

  ignition::math::Angle Latitude() const { return ignition::math::Angle(At(0)); }
  ignition::math::Angle Longitude() const { return ignition::math::Angle(At(1)); }
  double Altitude() const { return At(2); }
  math::Angle GetLatitude() const { return Latitude(); }
  math::Angle GetLongitude() const { return Longitude(); }
  double GetAltitude() const { return Altitude(); }

 protected:
  void Set(const TrundleGazeboReading& reading) override;

 private:
  double At(int index) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return values_[index];
  }
  double values_[3] = {0.0, 0.0, 0.0};
};

}  // namespace sensors
}  // namespace gazebo

#endif
