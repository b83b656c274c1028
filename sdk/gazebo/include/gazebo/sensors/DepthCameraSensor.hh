#ifndef GAZEBO_SENSORS_DEPTHCAMERASENSOR_HH_
#define GAZEBO_SENSORS_DEPTHCAMERASENSOR_HH_

#include <gazebo/rendering/DepthCamera.hh>
#include <gazebo/sensors/CameraSensor.hh>

namespace gazebo {
namespace sensors {

class DepthCameraSensor : public CameraSensor {
 public:
  DepthCameraSensor() : CameraSensor(rendering::CameraPtr(new rendering::DepthCamera)) {}

  rendering::DepthCameraPtr DepthCamera() const { return boost::static_pointer_cast<rendering::DepthCamera>(camera_); }
  rendering::DepthCameraPtr GetDepthCamera() const { return DepthCamera(); }
  const float* DepthData() const { return DepthCamera()->DepthData(); }
};

}  // namespace sensors
}  // namespace gazebo

#endif
