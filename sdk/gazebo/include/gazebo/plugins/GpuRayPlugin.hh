// Base of plugins of the GPU's laser scanners: a function gets the ranges of each reading.
#ifndef GAZEBO_PLUGINS_GPURAYPLUGIN_HH_
#define GAZEBO_PLUGINS_GPURAYPLUGIN_HH_

#include <string>

#include <gazebo/common/Plugin.hh>
#include <gazebo/sensors/GpuRaySensor.hh>

namespace gazebo {

class GpuRayPlugin : public SensorPlugin {
 public:
  GpuRayPlugin() : width(0), height(0), depth(0) {}
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr) override {
    parentSensor = std::dynamic_pointer_cast<sensors::GpuRaySensor>(sensor);
    if (!parentSensor) gzthrow("it is a plugin of the GPU's ray sensors, and its sensor is none");
    width = static_cast<unsigned int>(parentSensor->RangeCount());
    height = static_cast<unsigned int>(parentSensor->VerticalRangeCount());
    depth = 3;
    format = "float32";
    connection_ =
        parentSensor->ConnectNewLaserFrame([this](const float* image, unsigned int w, unsigned int h, unsigned int d,
                                                  const std::string& f) { OnNewLaserFrame(image, w, h, d, f); });
    parentSensor->SetActive(true);
  }
  virtual void OnNewLaserFrame(const float*, unsigned int, unsigned int, unsigned int, const std::string&) {}

 protected:
  unsigned int width, height, depth;
  std::string format;
  sensors::GpuRaySensorPtr parentSensor;

 private:
  event::ConnectionPtr connection_;
};

}  // namespace gazebo

#endif
