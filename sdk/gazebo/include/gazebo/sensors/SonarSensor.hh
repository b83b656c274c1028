#ifndef GAZEBO_SENSORS_SONARSENSOR_HH_
#define GAZEBO_SENSORS_SONARSENSOR_HH_

#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// Nearest distance in a cone or sphere [m].
class SonarSensor : public Sensor {
 public:
  SonarSensor() : Sensor(RAY) {}

  double RangeMin() const { return min_; }
  double RangeMax() const { return max_; }
  double Radius() const { return radius_; }
  double Range() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return range_;
  }
  double GetRangeMin() const { return RangeMin(); }
  double GetRangeMax() const { return RangeMax(); }
  double GetRadius() const { return Radius(); }
  double GetRange() { return Range(); }

 protected:
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override;

 private:
  double min_ = 0.0, max_ = 0.0, radius_ = 0.0, range_ = 0.0;
};

}  // namespace sensors
}  // namespace gazebo

#endif
