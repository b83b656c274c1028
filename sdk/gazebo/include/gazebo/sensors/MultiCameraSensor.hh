#ifndef GAZEBO_SENSORS_MULTICAMERASENSOR_HH_
#define GAZEBO_SENSORS_MULTICAMERASENSOR_HH_

#include <vector>

#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// Several cameras that draw at the same time, in the order of the file.
class MultiCameraSensor : public Sensor {
 public:
  MultiCameraSensor() : Sensor(IMAGE) {}

  unsigned int CameraCount() const { return static_cast<unsigned int>(cameras_.size()); }
  // Null if there is no such camera; as is the size of its pictures 0.
  rendering::CameraPtr Camera(unsigned int index) const {
    return index < cameras_.size() ? cameras_[index] : rendering::CameraPtr();
  }
  unsigned int ImageWidth(unsigned int index) const {
    return index < cameras_.size() ? Camera(index)->ImageWidth() : 0;
  }
  unsigned int ImageHeight(unsigned int index) const {
    return index < cameras_.size() ? Camera(index)->ImageHeight() : 0;
  }
  const unsigned char* ImageData(unsigned int index) {
    return index < cameras_.size() ? Camera(index)->ImageData() : nullptr;
  }

  // Names up to Gazebo 6.
  unsigned int GetCameraCount() const { return CameraCount(); }
  rendering::CameraPtr GetCamera(unsigned int index) const { return Camera(index); }
  unsigned int GetImageWidth(unsigned int index) const { return ImageWidth(index); }
  unsigned int GetImageHeight(unsigned int index) const { return ImageHeight(index); }
  const unsigned char* GetImageData(unsigned int index) { return ImageData(index); }

  bool IsWanted() const override {
    for (const rendering::CameraPtr& camera : cameras_)
      if (camera->IsWanted()) return true;
    return Sensor::IsWanted();
  }

 protected:
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override;
  void Tell(const void* world) override;
  bool IsComplete() const override { return last_set_ + 1 == cameras_.size(); }

 private:
  std::vector<rendering::CameraPtr> cameras_;
  // Index of the camera that the last reading was of.
  std::size_t last_set_ = 0;
};

}  // namespace sensors
}  // namespace gazebo

#endif
