#pragma once

#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <string>

#include "actionlib/server/action_server.h"

namespace actionlib {

/** An action as a service: a function makes the result of each goal at once. The server ends with its last copy. */
class ServiceServer {
 public:
  explicit ServiceServer(const boost::shared_ptr<void>& server) : server_(server) {}

 private:
  boost::shared_ptr<void> server_;
};

/** Serve an action by a function that returns false for a goal that fails. */
template <class ActionSpec>
ServiceServer advertiseService(ros::NodeHandle n, std::string name,
                               boost::function<bool(const typename ActionSpec::_action_goal_type::_goal_type&,
                                                    typename ActionSpec::_action_result_type::_result_type& result)>
                                   service_cb) {
  typedef ActionServer<ActionSpec> Server;
  return ServiceServer(boost::make_shared<Server>(
      n, name,
      [service_cb](typename Server::GoalHandle goal) {
        goal.setAccepted("This goal has been accepted by the service server");
        typename Server::Result result;
        if (service_cb(*goal.getGoal(), result)) goal.setSucceeded(result);
        else goal.setAborted(result);
      },
      true));
}

}  // namespace actionlib
