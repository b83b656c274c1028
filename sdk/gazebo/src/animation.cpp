#include <algorithm>
#include <cmath>

#include <gazebo/common/Animation.hh>

namespace gazebo {
namespace common {

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

void Animation::SetTime(double time) {
  if (is_loop_ && length_ > 0.0) {
    time_ = std::fmod(time, length_);
    if (time_ < 0.0) time_ += length_;
  } else {
    time_ = std::min(std::max(time, 0.0), length_);
  }
}

void Animation::Insert(std::unique_ptr<KeyFrame> frame) {
  const double time = frame->GetTime();
  const auto at = std::lower_bound(frames_.begin(), frames_.end(), time,
                                   [](const auto& other, double t) { return other->GetTime() < t; });
  if (at != frames_.end() && (*at)->GetTime() == time) *at = std::move(frame);
  else frames_.insert(at, std::move(frame));
}

bool Animation::Around(std::size_t& before, std::size_t& after, double& share) const {
  if (frames_.empty()) return false;
  const auto next = std::upper_bound(frames_.begin(), frames_.end(), time_,
                                     [](double t, const auto& frame) { return t < frame->GetTime(); });
  const std::size_t count = frames_.size(), index = static_cast<std::size_t>(next - frames_.begin());
  before = index == 0 ? 0 : index - 1;
  after = std::min(index, count - 1);
  const double from = frames_[before]->GetTime(), to = frames_[after]->GetTime();
  share = to > from ? (time_ - from) / (to - from) : 0.0;
  return true;
}

PoseKeyFrame* PoseAnimation::CreateKeyFrame(double time) {
  PoseKeyFrame* const frame = new PoseKeyFrame(time);
  Insert(std::unique_ptr<KeyFrame>(frame));
  return frame;
}

// Half of the way between the neighbors; the ends of a ring are one place.
Vector3d PoseAnimation::Tangent(std::size_t index) const {
  const std::size_t last = frames_.size() - 1;
  const bool is_end = index == 0 || index == last;
  const bool is_ring = last > 1 && At(0).Translation() == At(last).Translation();
  if (is_end && is_ring) return (At(1).Translation() - At(last - 1).Translation()) * 0.5;
  return (At(std::min(index + 1, last)).Translation() - At(index == 0 ? 0 : index - 1).Translation()) * 0.5;
}

void PoseAnimation::GetInterpolatedKeyFrame(PoseKeyFrame& frame) const {
  std::size_t a, b;
  double t;
  if (!Around(a, b, t)) return;
  // Hermite's polynomials of both positions and tangents.
  const double t2 = t * t, t3 = t2 * t;
  frame.Translation(At(a).Translation() * (2 * t3 - 3 * t2 + 1) + At(b).Translation() * (3 * t2 - 2 * t3) +
                    Tangent(a) * (t3 - 2 * t2 + t) + Tangent(b) * (t3 - t2));
  frame.Rotation(Quaterniond::Slerp(t, At(a).Rotation(), At(b).Rotation(), true));
}

NumericKeyFrame* NumericAnimation::CreateKeyFrame(double time) {
  NumericKeyFrame* const frame = new NumericKeyFrame(time);
  Insert(std::unique_ptr<KeyFrame>(frame));
  return frame;
}

void NumericAnimation::GetInterpolatedKeyFrame(NumericKeyFrame& frame) const {
  std::size_t a, b;
  double t;
  if (!Around(a, b, t)) return;
  const double from = static_cast<const NumericKeyFrame&>(*frames_[a]).GetValue();
  frame.SetValue(from + t * (static_cast<const NumericKeyFrame&>(*frames_[b]).GetValue() - from));
}

}  // namespace common
}  // namespace gazebo
