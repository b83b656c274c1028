#ifndef GAZEBO_SENSORS_LOGICALCAMERASENSOR_HH_
#define GAZEBO_SENSORS_LOGICALCAMERASENSOR_HH_

#include <gazebo/math/Angle.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/sensors/Sensor.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {
namespace sensors {

// Models whose boxes are in the view, with poses in the camera's frame; also on the topic ~/MODEL/LINK/SENSOR/models.
class LogicalCameraSensor : public Sensor {
 public:
  LogicalCameraSensor() : Sensor(OTHER) {}

  // [m]
  double Near() const { return near_; }
  double Far() const { return far_; }
  ignition::math::Angle HorizontalFOV() const { return ignition::math::Angle(horizontal_fov_); }
  // Width per height.
  double AspectRatio() const { return aspect_ratio_; }
  msgs::LogicalCameraImage Image() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return image_;
  }
  bool IsWanted() const override { return Sensor::IsWanted() || (images_ && images_->HasConnections()); }

 protected:
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override;
  void Tell(const void* world) override;

 private:
  friend class SensorManager;
  physics::LinkPtr link_;
  double near_ = 0.0, far_ = 1.0, horizontal_fov_ = 1.0, aspect_ratio_ = 1.0;
  msgs::LogicalCameraImage image_;
  transport::PublisherPtr images_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
