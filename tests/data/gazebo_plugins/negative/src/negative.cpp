#include <gazebo/plugins/CameraPlugin.hh>
#include <gazebo_plugins/gazebo_ros_camera_utils.h>

#include <string>
#include <vector>

namespace gazebo {

class Negative : public CameraPlugin, public GazeboRosCameraUtils {
 public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override {
    CameraPlugin::Load(sensor, sdf);
    parentSensor_ = parentSensor;
    width_ = width;
    height_ = height;
    depth_ = depth;
    format_ = format;
    camera_ = camera;
    loaded_ = OnLoad([this] { gzmsg << "pictures of " << image_pub_.getTopic() << " are negatives\n"; });
    GazeboRosCameraUtils::Load(sensor, sdf, "_1", 0.1);
  }

  void OnNewFrame(const unsigned char* image, unsigned int, unsigned int, unsigned int, const std::string&) override {
    common::Time time = parentSensor_->LastMeasurementTime();
    negative_.resize(width_ * height_ * depth_);
    for (std::size_t i = 0; i < negative_.size(); ++i) negative_[i] = static_cast<unsigned char>(255 - image[i]);
    PutCameraData(negative_.data(), time);
    PublishCameraInfo(time);
  }

 private:
  std::vector<unsigned char> negative_;
  event::ConnectionPtr loaded_;
};

GZ_REGISTER_SENSOR_PLUGIN(Negative)

}  // namespace gazebo
