#ifndef GAZEBO_RENDERING_DEPTHCAMERA_HH_
#define GAZEBO_RENDERING_DEPTHCAMERA_HH_

#include <string>
#include <vector>

#include <gazebo/rendering/Camera.hh>

namespace gazebo {
namespace rendering {

// Depths along the view axis [m], beside the pictures; infinite where nothing is in reach.
class DepthCamera : public Camera {
 public:
  typedef std::function<void(const float*, unsigned int, unsigned int, unsigned int, const std::string&)> DepthFunction;

  virtual const float* DepthData() const { return depths_.empty() ? nullptr : depths_.data(); }
  const float* GetDepthData() { return DepthData(); }

  event::ConnectionPtr ConnectNewDepthFrame(DepthFunction subscriber) { return new_depths_.Connect(subscriber); }
  void DisconnectNewDepthFrame(event::ConnectionPtr connection) { new_depths_.Disconnect(connection); }
  // Four numbers per pixel: the point in the camera's optical frame [m], and its color as packed bytes.
  event::ConnectionPtr ConnectNewRGBPointCloud(DepthFunction subscriber) { return new_clouds_.Connect(subscriber); }
  void DisconnectNewRGBPointCloud(event::ConnectionPtr connection) { new_clouds_.Disconnect(connection); }

  void Set(const TrundleGazeboReading& reading, const common::Time& time) override;
  void Tell(const void* world) override;
  bool IsWanted() const override {
    return Camera::IsWanted() || new_depths_.ConnectionCount() > 0 || new_clouds_.ConnectionCount() > 0;
  }

 private:
  std::vector<float> Cloud() const;

  std::vector<float> depths_;
  event::EventT<void(const float*, unsigned int, unsigned int, unsigned int, const std::string&)> new_depths_,
      new_clouds_;
};

}  // namespace rendering
}  // namespace gazebo

#endif
