#include <algorithm>

#include <gazebo/common/Animation.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

void Entity::StartAnimation() {
  Entity_V& animated = world_->animated_;
  const EntityPtr self = boost::static_pointer_cast<Entity>(shared_from_this());
  if (std::find(animated.begin(), animated.end(), self) == animated.end()) animated.push_back(self);
  animated_time_ = world_->SimTime();
}

void Entity::SetAnimation(const common::PoseAnimationPtr& animation, boost::function<void()> finished) {
  animation_ = animation;
  animation_finished_ = finished;
  if (animation_) animation_->SetTime(0.0);
  StartAnimation();
}

void Entity::StopAnimation() {
  animation_.reset();
  animation_finished_.clear();
}

void Entity::Animate(const common::Time& time) {
  const double elapsed = std::max((time - animated_time_).Double(), 0.0);
  animated_time_ = time;
  if (!animation_) return;
  animation_->AddTime(elapsed);
  common::PoseKeyFrame frame(0.0);
  animation_->GetInterpolatedKeyFrame(frame);
  SetWorldPose(ignition::math::Pose3d(frame.Translation(), frame.Rotation()));
  if (animation_->GetTime() < animation_->GetLength()) return;
  const boost::function<void()> finished = animation_finished_;
  Entity::StopAnimation();
  if (finished) finished();
}

void Model::SetJointAnimation(const std::map<std::string, common::NumericAnimationPtr>& animations,
                              boost::function<void()> finished) {
  for (const auto& [name, animation] : animations)
    if (animation) joint_animations_[name] = animation;
  joint_animations_finished_ = finished;
  StartAnimation();
}

void Model::StopAnimation() {
  Entity::StopAnimation();
  joint_animations_.clear();
  joint_animations_finished_.clear();
}

void Model::Animate(const common::Time& time) {
  const double elapsed = std::max((time - animated_time_).Double(), 0.0);
  Entity::Animate(time);
  if (joint_animations_.empty()) return;
  for (auto next = joint_animations_.begin(); next != joint_animations_.end();) {
    common::NumericAnimation& animation = *next->second;
    animation.AddTime(elapsed);
    common::NumericKeyFrame frame(0.0);
    animation.GetInterpolatedKeyFrame(frame);
    SetJointPosition(next->first, frame.GetValue());
    if (animation.GetTime() < animation.GetLength()) ++next;
    else next = joint_animations_.erase(next);
  }
  if (!joint_animations_.empty()) return;
  const boost::function<void()> finished = joint_animations_finished_;
  joint_animations_finished_.clear();
  if (finished) finished();
}

}  // namespace physics
}  // namespace gazebo
