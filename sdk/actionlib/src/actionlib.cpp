#include <actionlib_msgs/GoalStatus.h>
#include <ros/this_node.h>
#include <ros/time.h>

#include <atomic>
#include <sstream>

#include "actionlib/client/simple_client_goal_state.h"
#include "actionlib/goal_id_generator.h"

namespace actionlib {

actionlib_msgs::GoalID generateGoalId() {
  static std::atomic<unsigned> count{0};
  actionlib_msgs::GoalID id;
  id.stamp = ros::Time::now();
  std::stringstream text;
  text << ros::this_node::getName() << "-" << ++count << "-" << id.stamp;
  id.id = text.str();
  return id;
}

std::string SimpleClientGoalState::toString() const {
  static const char* const kNames[] = {"PENDING",   "ACTIVE",  "RECALLED",  "REJECTED",
                                       "PREEMPTED", "ABORTED", "SUCCEEDED", "LOST"};
  return kNames[state_];
}

bool terminalState(int status, SimpleClientGoalState::StateEnum& state) {
  switch (status) {
    case actionlib_msgs::GoalStatus::RECALLED: state = SimpleClientGoalState::RECALLED; return true;
    case actionlib_msgs::GoalStatus::REJECTED: state = SimpleClientGoalState::REJECTED; return true;
    case actionlib_msgs::GoalStatus::PREEMPTED: state = SimpleClientGoalState::PREEMPTED; return true;
    case actionlib_msgs::GoalStatus::ABORTED: state = SimpleClientGoalState::ABORTED; return true;
    case actionlib_msgs::GoalStatus::SUCCEEDED: state = SimpleClientGoalState::SUCCEEDED; return true;
    default: return false;
  }
}

}  // namespace actionlib
