#ifndef GAZEBO_SENSORS_CAMERASENSOR_HH_
#define GAZEBO_SENSORS_CAMERASENSOR_HH_

#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

class CameraSensor : public Sensor {
 public:
  CameraSensor() : CameraSensor(rendering::CameraPtr(new rendering::Camera)) {}

  rendering::CameraPtr Camera() const { return camera_; }
  rendering::CameraPtr GetCamera() const { return camera_; }
  unsigned int ImageWidth() const { return camera_->ImageWidth(); }
  unsigned int ImageHeight() const { return camera_->ImageHeight(); }
  const unsigned char* ImageData() const { return camera_->ImageData(); }
  unsigned int GetImageWidth() const { return ImageWidth(); }
  unsigned int GetImageHeight() const { return ImageHeight(); }
  const unsigned char* GetImageData() { return ImageData(); }
  bool IsWanted() const override { return Sensor::IsWanted() || camera_->IsWanted(); }

 protected:
  explicit CameraSensor(const rendering::CameraPtr& camera) : Sensor(IMAGE), camera_(camera) {}
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override { camera_->Set(reading, last_); }
  void Tell(const void* world) override { camera_->Tell(world); }

  rendering::CameraPtr camera_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
