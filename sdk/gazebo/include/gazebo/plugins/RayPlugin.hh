// Base of plugins of laser scanners: a function is called after each reading.
#ifndef GAZEBO_PLUGINS_RAYPLUGIN_HH_
#define GAZEBO_PLUGINS_RAYPLUGIN_HH_

#include <gazebo/common/Exception.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/sensors/RaySensor.hh>

namespace gazebo {

class RayPlugin : public SensorPlugin {
 public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr) override {
    parentSensor = std::dynamic_pointer_cast<sensors::RaySensor>(sensor);
    if (!parentSensor) gzthrow("it is a ray sensor's plugin, and its sensor is none");
    connection_ = parentSensor->ConnectUpdated([this] { OnNewLaserScans(); });
  }
  virtual void OnNewLaserScans() {}

 protected:
  sensors::RaySensorPtr parentSensor;

 private:
  event::ConnectionPtr connection_;
};

}  // namespace gazebo

#endif
