#ifndef GAZEBO_SENSORS_SONARSENSOR_HH_
#define GAZEBO_SENSORS_SONARSENSOR_HH_

#include <gazebo/msgs/msgs.hh>
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
  event::ConnectionPtr ConnectUpdate(std::function<void(msgs::SonarStamped)> subscriber) {
    return new_ranges_.Connect(subscriber);
  }
  void DisconnectUpdate(event::ConnectionPtr connection) { new_ranges_.Disconnect(connection); }
  bool IsWanted() const override { return Sensor::IsWanted() || new_ranges_.ConnectionCount() > 0; }
  double GetRangeMin() const { return RangeMin(); }
  double GetRangeMax() const { return RangeMax(); }
  double GetRadius() const { return Radius(); }
  double GetRange() { return Range(); }

 protected:
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override;
  void Tell(const void* world) override;

 private:
  double min_ = 0.0, max_ = 0.0, radius_ = 0.0, range_ = 0.0;
  event::EventT<void(msgs::SonarStamped)> new_ranges_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
