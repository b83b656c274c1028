// Key frames, and the values between them.
#ifndef GAZEBO_COMMON_ANIMATION_HH_
#define GAZEBO_COMMON_ANIMATION_HH_

#include <memory>
#include <string>
#include <vector>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/KeyFrame.hh>

namespace gazebo {
namespace common {

// Its time [s] goes from 0 to its length; that of a loop starts again.
class Animation {
 public:
  Animation(const std::string& name, double length, bool loop) : name_(name), length_(length), is_loop_(loop) {}
  virtual ~Animation() {}
  double GetLength() const { return length_; }
  void SetLength(double length) { length_ = length; }
  double GetTime() const { return time_; }
  void SetTime(double time);
  void AddTime(double time) { SetTime(time_ + time); }
  unsigned int GetKeyFrameCount() const { return static_cast<unsigned int>(frames_.size()); }
  // Null where there is none.
  KeyFrame* GetKeyFrame(unsigned int index) const { return index < frames_.size() ? frames_[index].get() : nullptr; }

 protected:
  // Add a frame in the order of time; one of the same time is replaced.
  void Insert(std::unique_ptr<KeyFrame> frame);
  // Frames around the time, and the share of the way between them; false: there is no frame.
  bool Around(std::size_t& before, std::size_t& after, double& share) const;

  std::string name_;
  double length_, time_ = 0.0;
  bool is_loop_;
  std::vector<std::unique_ptr<KeyFrame>> frames_;
};

// Positions by Catmull and Rom's spline, rotations along great circles.
class PoseAnimation : public Animation {
 public:
  PoseAnimation(const std::string& name, double length, bool loop) : Animation(name, length, loop) {}
  PoseKeyFrame* CreateKeyFrame(double time);
  void GetInterpolatedKeyFrame(PoseKeyFrame& frame) const;

 private:
  const PoseKeyFrame& At(std::size_t index) const { return static_cast<const PoseKeyFrame&>(*frames_[index]); }
  ignition::math::Vector3d Tangent(std::size_t index) const;
};

// Straight lines between its values.
class NumericAnimation : public Animation {
 public:
  NumericAnimation(const std::string& name, double length, bool loop) : Animation(name, length, loop) {}
  NumericKeyFrame* CreateKeyFrame(double time);
  void GetInterpolatedKeyFrame(NumericKeyFrame& frame) const;
};

}  // namespace common
}  // namespace gazebo

#endif
