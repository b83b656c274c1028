// Pictures of a camera sensor, as the simulator has drawn them; nothing can be drawn with it.
#ifndef GAZEBO_RENDERING_CAMERA_HH_
#define GAZEBO_RENDERING_CAMERA_HH_

#include <mutex>
#include <string>
#include <vector>

#include <sdf/sdf.hh>

#include <gazebo/trundle_host.h>
#include <gazebo/common/Event.hh>
#include <gazebo/common/Time.hh>
#include <ignition/math/Vector2.hh>

#include <gazebo/math/Angle.hh>
#include <gazebo/rendering/RenderTypes.hh>

namespace gazebo {
namespace rendering {

// Distortion of a lens, as in the file; the pictures have it.
class Distortion {
 public:
  double K1() const { return k_[0]; }
  double K2() const { return k_[1]; }
  double K3() const { return k_[2]; }
  double P1() const { return p_[0]; }
  double P2() const { return p_[1]; }
  ignition::math::Vector2d Center() const { return center_; }
  // Whether a picture is enlarged until no border is black, where k1 is negative; it is, until a plugin sets another.
  bool Crop() const { return crop_; }
  void SetCrop(bool crop);
  double GetK1() const { return K1(); }
  double GetK2() const { return K2(); }
  double GetK3() const { return K3(); }
  double GetP1() const { return P1(); }
  double GetP2() const { return P2(); }

 private:
  friend class Camera;
  double k_[3] = {0.0, 0.0, 0.0}, p_[2] = {0.0, 0.0};
  ignition::math::Vector2d center_ = ignition::math::Vector2d(0.5, 0.5);
  bool crop_ = true;
  std::function<void(bool)> crop_changed_;
};

class Camera {
 public:
  typedef std::function<void(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&)>
      Function;

  virtual ~Camera() {}

  std::string Name() const { return name_; }
  // [px]
  virtual unsigned int ImageWidth() const { return width_; }
  virtual unsigned int ImageHeight() const { return height_; }
  // Bytes per pixel, and their meaning: pictures are R8G8B8, or L8 if the file says so, in its words (RGB_INT8,
  // L_INT8).
  virtual unsigned int ImageDepth() const { return depth_; }
  std::string ImageFormat() const { return format_; }
  std::size_t ImageByteSize() const { return std::size_t(width_) * height_ * depth_; }
  // Horizontal field of view.
  ignition::math::Angle HFOV() const { return ignition::math::Angle(hfov_); }
  ignition::math::Angle VFOV() const;
  // The sensor's field of view stays as in the file; a warning says so.
  void SetHFOV(const ignition::math::Angle& angle);
  // Null without <distortion>.
  DistortionPtr LensDistortion() const { return distortion_; }
  double AspectRatio() const { return height_ ? double(width_) / height_ : 0.0; }
  double NearClip() const { return near_; }
  double FarClip() const { return far_; }
  double RenderRate() const { return rate_; }
  common::Time LastRenderWallTime() const { return last_; }
  bool Initialized() const { return true; }
  // Last picture, until the next; null before the first.
  virtual const unsigned char* ImageData(unsigned int = 0) const { return image_.empty() ? nullptr : image_.data(); }
  void SetCaptureData(bool) {}
  // Write the last picture, or the pixels of one, as PNG; false if there is none, or it cannot be written.
  bool SaveFrame(const std::string& filename);
  static bool SaveFrame(const unsigned char* image, unsigned int width, unsigned int height, int depth,
                        const std::string& format, const std::string& filename);

  event::ConnectionPtr ConnectNewImageFrame(Function subscriber) { return new_images_.Connect(subscriber); }
  void DisconnectNewImageFrame(event::ConnectionPtr connection) { new_images_.Disconnect(connection); }

  // Names up to Gazebo 6.
  std::string GetName() const { return Name(); }
  unsigned int GetImageWidth() const { return ImageWidth(); }
  unsigned int GetImageHeight() const { return ImageHeight(); }
  unsigned int GetImageDepth() const { return ImageDepth(); }
  std::string GetImageFormat() const { return ImageFormat(); }
  math::Angle GetHFOV() const { return HFOV(); }
  const unsigned char* GetImageData(unsigned int index = 0) { return ImageData(index); }

  // For the library.
  void Read(const std::string& name, const sdf::ElementPtr& camera, double rate);
  void WhenCropChanges(const std::function<void(bool)>& call) {
    if (distortion_) distortion_->crop_changed_ = call;
  }
  virtual void Set(const TrundleGazeboReading& reading, const common::Time& time);
  virtual void Tell(const void* world);
  virtual bool IsWanted() const { return new_images_.ConnectionCount() > 0; }

 protected:
  std::string name_, format_ = "R8G8B8";
  unsigned int width_ = 0, height_ = 0, depth_ = 3;
  double hfov_ = 0.0, near_ = 0.1, far_ = 100.0, rate_ = 0.0;
  common::Time last_;
  DistortionPtr distortion_;
  std::vector<unsigned char> image_;
  event::EventT<void(const unsigned char*, unsigned int, unsigned int, unsigned int, const std::string&)> new_images_;
};

}  // namespace rendering
}  // namespace gazebo

#endif
