// Base of plugins of depth cameras: functions get each picture, its depths and its points.
#ifndef GAZEBO_PLUGINS_DEPTHCAMERAPLUGIN_HH_
#define GAZEBO_PLUGINS_DEPTHCAMERAPLUGIN_HH_

#include <string>
#include <vector>

#include <gazebo/common/Exception.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/rendering/DepthCamera.hh>
#include <gazebo/sensors/DepthCameraSensor.hh>

namespace gazebo {

class DepthCameraPlugin : public SensorPlugin {
 public:
  DepthCameraPlugin() : width(0), height(0), depth(0) {}
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr) override {
    parentSensor = std::dynamic_pointer_cast<sensors::DepthCameraSensor>(sensor);
    if (!parentSensor) gzthrow("it is a depth camera's plugin, and its sensor is none");
    depthCamera = parentSensor->DepthCamera();
    width = depthCamera->ImageWidth();
    height = depthCamera->ImageHeight();
    depth = depthCamera->ImageDepth();
    format = depthCamera->ImageFormat();
    connections_.push_back(
        depthCamera->ConnectNewDepthFrame([this](const float* image, unsigned int w, unsigned int h, unsigned int d,
                                                 const std::string& f) { OnNewDepthFrame(image, w, h, d, f); }));
    connections_.push_back(
        depthCamera->ConnectNewRGBPointCloud([this](const float* points, unsigned int w, unsigned int h, unsigned int d,
                                                    const std::string& f) { OnNewRGBPointCloud(points, w, h, d, f); }));
    connections_.push_back(depthCamera->ConnectNewImageFrame(
        [this](const unsigned char* image, unsigned int w, unsigned int h, unsigned int d, const std::string& f) {
          OnNewImageFrame(image, w, h, d, f);
        }));
    parentSensor->SetActive(true);
  }
  virtual void OnNewDepthFrame(const float*, unsigned int, unsigned int, unsigned int, const std::string&) {}
  virtual void OnNewRGBPointCloud(const float*, unsigned int, unsigned int, unsigned int, const std::string&) {}
  virtual void OnNewImageFrame(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&) {}

 protected:
  unsigned int width, height, depth;
  std::string format;
  sensors::DepthCameraSensorPtr parentSensor;
  rendering::DepthCameraPtr depthCamera;

 private:
  std::vector<event::ConnectionPtr> connections_;
};

}  // namespace gazebo

#endif
