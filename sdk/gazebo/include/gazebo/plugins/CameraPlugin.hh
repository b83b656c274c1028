// Base of plugins of cameras: a function gets each picture.
#ifndef GAZEBO_PLUGINS_CAMERAPLUGIN_HH_
#define GAZEBO_PLUGINS_CAMERAPLUGIN_HH_

#include <string>

#include <gazebo/common/Exception.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/CameraSensor.hh>

namespace gazebo {

class CameraPlugin : public SensorPlugin {
 public:
  CameraPlugin() : width(0), height(0), depth(0) {}
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr) override {
    parentSensor = std::dynamic_pointer_cast<sensors::CameraSensor>(sensor);
    if (!parentSensor) gzthrow("it is a camera's plugin, and its sensor is none");
    camera = parentSensor->Camera();
    width = camera->ImageWidth();
    height = camera->ImageHeight();
    depth = camera->ImageDepth();
    format = camera->ImageFormat();
    newFrameConnection =
        camera->ConnectNewImageFrame([this](const unsigned char* image, unsigned int w, unsigned int h, unsigned int d,
                                            const std::string& f) { OnNewFrame(image, w, h, d, f); });
    parentSensor->SetActive(true);
  }
  virtual void OnNewFrame(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&) {}

 protected:
  unsigned int width, height, depth;
  std::string format;
  sensors::CameraSensorPtr parentSensor;
  rendering::CameraPtr camera;

 private:
  event::ConnectionPtr newFrameConnection;
};

}  // namespace gazebo

#endif
