#include <algorithm>
#include <cmath>
#include <cstring>

#include <gazebo/common/Console.hh>
#include <gazebo/rendering/DepthCamera.hh>

namespace gazebo {
namespace rendering {

void Camera::Read(const std::string& name, const sdf::ElementPtr& camera, double rate) {
  name_ = name;
  rate_ = rate;
  if (!camera) return;
  hfov_ = camera->Get<double>("horizontal_fov", 1.047).first;
  if (const sdf::ElementPtr image = camera->FindElement("image")) {
    width_ = image->Get<unsigned int>("width", 320).first;
    height_ = image->Get<unsigned int>("height", 240).first;
    const std::string format = image->Get<std::string>("format", "R8G8B8").first;
    if (format == "L8" || format == "L_INT8") depth_ = 1;
    if (depth_ == 1 || format == "RGB_INT8") format_ = format;
  }
  if (const sdf::ElementPtr lens = camera->FindElement("distortion")) {
    distortion_ = DistortionPtr(new Distortion);
    const char* const names[] = {"k1", "k2", "k3"};
    for (int i = 0; i < 3; ++i) distortion_->k_[i] = lens->Get<double>(names[i], 0.0).first;
    distortion_->p_[0] = lens->Get<double>("p1", 0.0).first;
    distortion_->p_[1] = lens->Get<double>("p2", 0.0).first;
    distortion_->center_ = lens->Get<ignition::math::Vector2d>("center", ignition::math::Vector2d(0.5, 0.5)).first;
  }
  if (const sdf::ElementPtr clip = camera->FindElement("clip")) {
    near_ = clip->Get<double>("near", near_).first;
    far_ = clip->Get<double>("far", far_).first;
  }
}

void Distortion::SetCrop(bool crop) {
  if (crop == crop_) return;
  crop_ = crop;
  if (crop_changed_) crop_changed_(crop);
}

void Camera::SetHFOV(const ignition::math::Angle& angle) {
  if (std::abs(angle.Radian() - hfov_) > 1e-9)
    gzwarn << "camera " << name_ << ": the field of view cannot be changed; it stays " << hfov_ << " rad\n";
}

ignition::math::Angle Camera::VFOV() const {
  return ignition::math::Angle(width_ ? 2.0 * std::atan(std::tan(hfov_ / 2.0) * height_ / width_) : 0.0);
}

void Camera::Set(const TrundleGazeboReading& reading, const common::Time& time) {
  last_ = time;
  width_ = static_cast<unsigned int>(reading.width);
  height_ = static_cast<unsigned int>(reading.height);
  const std::size_t count = std::size_t(width_) * height_;
  image_.resize(count * depth_);
  if (depth_ == 3) {
    std::copy_n(reading.image, image_.size(), image_.begin());
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {  // luma of BT.601
    const unsigned char* color = reading.image + 3 * i;
    image_[i] = static_cast<unsigned char>((299 * color[0] + 587 * color[1] + 114 * color[2] + 500) / 1000);
  }
}

void Camera::Tell(const void* world) { new_images_.SignalIn(world, image_.data(), width_, height_, depth_, format_); }

void DepthCamera::Set(const TrundleGazeboReading& reading, const common::Time& time) {
  Camera::Set(reading, time);
  const std::size_t count = std::size_t(width_) * height_;
  depths_.assign(count, INFINITY);
  if (!reading.depths) return;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isnan(reading.depths[i])) depths_[i] = reading.depths[i];
}

void DepthCamera::Tell(const void* world) {
  Camera::Tell(world);
  new_depths_.SignalIn(world, depths_.data(), width_, height_, 1, "FLOAT32");
  if (new_clouds_.ConnectionCount() == 0) return;
  const std::vector<float> cloud = Cloud();
  new_clouds_.SignalIn(world, cloud.data(), width_, height_, 1, "RGBPOINTS");
}

std::vector<float> DepthCamera::Cloud() const {
  const double focal = width_ / (2.0 * std::tan(hfov_ / 2.0));
  std::vector<float> cloud(4 * depths_.size());
  for (std::size_t i = 0; i < depths_.size(); ++i) {
    const double z = depths_[i], u = static_cast<double>(i % width_), v = static_cast<double>(i / width_);
    cloud[4 * i] = static_cast<float>((u - (width_ - 1) / 2.0) / focal * z);
    cloud[4 * i + 1] = static_cast<float>((v - (height_ - 1) / 2.0) / focal * z);
    cloud[4 * i + 2] = static_cast<float>(z);
    const unsigned char* color = image_.data() + i * depth_;
    const uint32_t packed =
        (uint32_t(color[0]) << 16) | (uint32_t(color[depth_ == 3 ? 1 : 0]) << 8) | color[depth_ == 3 ? 2 : 0];
    std::memcpy(&cloud[4 * i + 3], &packed, sizeof(packed));
  }
  return cloud;
}

}  // namespace rendering
}  // namespace gazebo
