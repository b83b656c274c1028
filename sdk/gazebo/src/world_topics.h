// Topics of the world: what plugins ask of it by messages, and what it tells.
#pragma once

#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/World.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {
namespace physics {

class WorldTopics {
 public:
  explicit WorldTopics(World& world);
  // Publish ~/world_stats and ~/pose/info, if they are due and somebody subscribes.
  void Update(const common::Time& time);

 private:
  void OnFactory(ConstFactoryPtr& message);
  void OnPhysics(ConstPhysicsPtr& message);
  void OnControl(ConstWorldControlPtr& message);
  void OnRequest(ConstRequestPtr& message);
  void OnVisual(ConstVisualPtr& message);
  void PublishStatistics(const common::Time& time);
  void PublishPoses(const common::Time& time);

  World& world_;
  transport::NodePtr node_;
  std::vector<transport::SubscriberPtr> subscribers_;
  transport::PublisherPtr statistics_, poses_;
  common::Time statistics_due_, poses_due_;
  bool warned_of_visuals_ = false;
};

}  // namespace physics
}  // namespace gazebo
