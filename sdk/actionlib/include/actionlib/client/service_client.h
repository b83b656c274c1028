#pragma once

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <functional>
#include <string>
#include <typeinfo>

#include "actionlib/client/simple_action_client.h"

namespace actionlib {

/** An action as a service: a call sends a goal and waits for its result. */
class ServiceClient {
 public:
  /** False, with a message, if the types are not the action's, or the goal did not succeed. */
  template <class Goal, class Result>
  bool call(const Goal& goal, Result& result) {
    return call_(&goal, typeid(Goal), &result, typeid(Result));
  }
  bool waitForServer(const ros::Duration& timeout = ros::Duration(0, 0)) { return wait_for_server_(timeout); }
  bool isServerConnected() { return is_connected_(); }

 private:
  template <class ActionSpec>
  friend ServiceClient serviceClient(ros::NodeHandle n, std::string name);

  std::function<bool(const void*, const std::type_info&, void*, const std::type_info&)> call_;
  std::function<bool(const ros::Duration&)> wait_for_server_;
  std::function<bool()> is_connected_;
};

template <class ActionSpec>
ServiceClient serviceClient(ros::NodeHandle n, std::string name) {
  typedef SimpleActionClient<ActionSpec> Client;
  typedef typename Client::Goal Goal;
  typedef typename Client::Result Result;
  const boost::shared_ptr<Client> client = boost::make_shared<Client>(n, name, true);
  ServiceClient service;
  service.call_ = [client, name](const void* goal, const std::type_info& goal_type, void* result,
                                 const std::type_info& result_type) {
    if (goal_type != typeid(Goal) || result_type != typeid(Result)) {
      ROS_ERROR("the goal or the result is not of the type of the action %s", name.c_str());
      return false;
    }
    if (!client->isServerConnected()) {
      ROS_ERROR("no server of the action %s is connected", name.c_str());
      return false;
    }
    client->sendGoalAndWait(*static_cast<const Goal*>(goal));
    if (client->getState() != SimpleClientGoalState::SUCCEEDED) return false;
    *static_cast<Result*>(result) = *client->getResult();
    return true;
  };
  service.wait_for_server_ = [client](const ros::Duration& timeout) { return client->waitForServer(timeout); };
  service.is_connected_ = [client] { return client->isServerConnected(); };
  return service;
}

}  // namespace actionlib
