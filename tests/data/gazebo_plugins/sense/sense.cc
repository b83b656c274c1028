// Plugin of any sensor: prints its first reading after 0.3 s.
#include <gazebo/plugins/DepthCameraPlugin.hh>  // first, as each header brings what it uses
#include <gazebo/plugins/RayPlugin.hh>

#include <cmath>
#include <string>
#include <vector>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {

class Sense : public SensorPlugin {
 public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override {
    sensor_ = sensor;
    word_ = sdf->Get<std::string>("word");
    if (auto camera = std::dynamic_pointer_cast<sensors::CameraSensor>(sensor)) {
      node_ = transport::NodePtr(new transport::Node());
      node_->Init(sensor->WorldName());
      sent_ = node_->Advertise<msgs::ImageStamped>("~/" + sensor->Name());
      pictures_ = node_->Subscribe("~/" + sensor->Name(), &Sense::OnPicture, this);
      image_ = camera->Camera()->ConnectNewImageFrame([this](const unsigned char* image, unsigned int width,
                                                             unsigned int height, unsigned int depth,
                                                             const std::string& format) {
        const unsigned char* middle = image + (height / 2 * width + width / 2) * depth;
        picture_ = std::to_string(width) + "x" + std::to_string(height) + " " + format + " " +
                   (middle[0] > 2 * middle[depth - 1] ? "red" : "other");
        msgs::ImageStamped message;
        msgs::Set(message.mutable_time(), sensor_->LastMeasurementTime());
        message.mutable_image()->set_width(width);
        message.mutable_image()->set_pixel_format(common::Image::ConvertPixelFormat(format));
        message.mutable_image()->set_data(image, std::size_t(width) * height * depth);
        sent_->Publish(message);
      });
    }
    if (auto cameras = std::dynamic_pointer_cast<sensors::MultiCameraSensor>(sensor))
      for (unsigned int i = 0; i < cameras->CameraCount(); ++i)
        images_.push_back(cameras->Camera(i)->ConnectNewImageFrame(
            [this, i](const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&) {
              order_ += std::to_string(i);
            }));
    if (auto depth = std::dynamic_pointer_cast<sensors::DepthCameraSensor>(sensor))
      depths_ = depth->DepthCamera()->ConnectNewDepthFrame(
          [this](const float* depths, unsigned int width, unsigned int height, unsigned int, const std::string&) {
            depth_ = depths[height / 2 * width + width / 2];
          });
    if (auto ray = std::dynamic_pointer_cast<sensors::RaySensor>(sensor)) {
      node_ = transport::NodePtr(new transport::Node());
      node_->Init(sensor->WorldName());
      scans_ = node_->Subscribe(sensor->Topic(), &Sense::OnScan, this);
      sensor->Noise(sensors::RAY_NOISE)->SetCustomNoiseCallback([](double range) { return range + 0.25; });
    }
    if (sensor->Type() == "logical_camera") {
      node_ = transport::NodePtr(new transport::Node());
      node_->Init(sensor->WorldName());
      models_ = node_->Subscribe(sensor->Topic(), &Sense::OnModels, this);
    }
    updated_ = sensor->ConnectUpdated([this] { OnUpdate(); });
    sensor->SetActive(true);
  }

 private:
  void OnScan(ConstLaserScanStampedPtr& message) { scanned_ = message->scan().ranges_size(); }

  void OnPicture(ConstImageStampedPtr& message) {
    const msgs::Image& image = message->image();
    message_ = std::to_string(image.data().size() / image.width()) + " of " + std::to_string(image.pixel_format());
  }

  void OnModels(ConstLogicalCameraImagePtr& message) { listed_ = message->model_size(); }

  void OnUpdate() {
    if (is_told_ || sensor_->LastMeasurementTime() < common::Time(0.3)) return;
    is_told_ = true;
    gzmsg << word_ << " " << sensor_->Name() << " of " << sensor_->ParentName() << ": " << Reading() << std::endl;
  }

  std::string Reading() {
    char text[200] = "";
    if (auto ray = std::dynamic_pointer_cast<sensors::RaySensor>(sensor_))
      std::snprintf(text, sizeof(text), "%d rays from %.2f to %.2f, middle %.3f, topic %d", ray->RayCount(),
                    ray->AngleMin().Radian(), ray->AngleMax().Radian(), ray->Range(ray->RayCount() / 2), scanned_);
    else if (auto imu = std::dynamic_pointer_cast<sensors::ImuSensor>(sensor_))
      std::snprintf(text, sizeof(text), "%.2f", imu->LinearAcceleration().Z());
    else if (auto gps = std::dynamic_pointer_cast<sensors::GpsSensor>(sensor_))
      std::snprintf(text, sizeof(text), "%.3f %.3f", gps->Latitude().Degree(), gps->Altitude());
    else if (auto sonar = std::dynamic_pointer_cast<sensors::SonarSensor>(sensor_))
      std::snprintf(text, sizeof(text), "%.2f of %.1f", sonar->Range(), sonar->RangeMax());
    else if (auto logical = std::dynamic_pointer_cast<sensors::LogicalCameraSensor>(sensor_)) {
      const msgs::LogicalCameraImage image = logical->Image();
      std::snprintf(text, sizeof(text), "from %.1f to %.1f at z %.2f, topic %d:", logical->Near(), logical->Far(),
                    image.pose().position().z(), listed_);
      std::string list = text;
      for (int i = 0; i < image.model_size(); ++i) {
        const msgs::LogicalCameraImage::Model& model = image.model(i);
        std::snprintf(text, sizeof(text), " %s %.2f", model.name().c_str(), model.pose().position().x());
        list += text;
      }
      return list;
    } else if (auto contact = std::dynamic_pointer_cast<sensors::ContactSensor>(sensor_)) {
      double force = 0.0;
      const msgs::Contacts contacts = contact->Contacts();
      for (int i = 0; i < contacts.contact_size(); ++i)
        for (int k = 0; k < contacts.contact(i).wrench_size(); ++k)
          force += contacts.contact(i).wrench(k).body_1_wrench().force().z();
      std::snprintf(text, sizeof(text), "%.1f N with %s", force,
                    contacts.contact_size() ? contact->Contacts("box::body::hull").begin()->first.c_str() : "nothing");
    } else if (auto cameras = std::dynamic_pointer_cast<sensors::MultiCameraSensor>(sensor_)) {
      std::string seen = order_.substr(order_.size() - 2);
      for (unsigned int i = 0; i < cameras->CameraCount(); ++i) {
        const std::size_t middle = (cameras->ImageHeight(i) / 2 * cameras->ImageWidth(i) + cameras->ImageWidth(i) / 2) * 3;
        const unsigned char* color = cameras->ImageData(i) + middle;
        seen += " " + cameras->Camera(i)->Name() + (color[0] > 2 * color[2] ? " red" : " other");
      }
      return seen;
    } else if (sensor_->Type() == "depth")
      std::snprintf(text, sizeof(text), "%s, depth %.2f", picture_.c_str(), depth_);
    else if (sensor_->Type() == "camera") std::snprintf(text, sizeof(text), "%s, message %s", picture_.c_str(), message_.c_str());
    return text;
  }

  sensors::SensorPtr sensor_;
  std::string word_, picture_, order_, message_;
  float depth_ = 0.0f;
  int scanned_ = 0, listed_ = 0;
  bool is_told_ = false;
  transport::NodePtr node_;
  transport::PublisherPtr sent_;
  transport::SubscriberPtr scans_, models_, pictures_;
  event::ConnectionPtr updated_, image_, depths_;
  std::vector<event::ConnectionPtr> images_;
};

GZ_REGISTER_SENSOR_PLUGIN(Sense)

}  // namespace gazebo
