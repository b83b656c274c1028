// A server that works on several goals at once, and its client, which prints a line for each check that fails.
#include <actionlib/client/action_client.h>
#include <actionlib/destruction_guard.h>
#include <actionlib/server/simple_action_server.h>
#include <cpp_actions/CountAction.h>
#include <ros/ros.h>

#include <iostream>
#include <list>
#include <map>

namespace {

typedef actionlib::ActionServer<cpp_actions::CountAction> Server;
typedef actionlib::ActionClient<cpp_actions::CountAction> Client;

int made = 0, failed = 0, feedbacks = 0;
#define CHECK(cond)                                                    \
  do {                                                                 \
    ++made;                                                            \
    if (!(cond)) {                                                     \
      ++failed;                                                        \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                  \
  } while (false)

/** Accepts orders above 0, holds them, and rejects others. */
class Holder {
 public:
  Holder()
      : server_(node_, "hold", boost::bind(&Holder::onGoal, this, _1), boost::bind(&Holder::onCancel, this, _1),
                false) {
    server_.start();
  }
  /** Finish the goal with an order. */
  void finish(int order, bool is_well) {
    cpp_actions::CountResult result;
    result.sequence.assign(static_cast<size_t>(order), order);
    if (is_well)
      held_[order].setSucceeded(result, "well");
    else
      held_[order].setAborted(result, "not well");
  }
  size_t size() const { return held_.size(); }

 private:
  void onGoal(Server::GoalHandle goal) {
    const int order = goal.getGoal()->order;
    if (order < 0) {
      goal.setRejected(cpp_actions::CountResult(), "negative");
      return;
    }
    goal.setAccepted();
    goal.setAccepted();  // no second time: an error in the log
    cpp_actions::CountFeedback feedback;
    feedback.sequence.push_back(order);
    goal.publishFeedback(feedback);
    held_[order] = goal;
  }
  void onCancel(Server::GoalHandle goal) { goal.setCanceled(cpp_actions::CountResult(), "canceled"); }

  ros::NodeHandle node_;
  Server server_;
  std::map<int, Server::GoalHandle> held_;
};

std::map<std::string, std::string> ways;
void onTransition(Client::GoalHandle goal, const std::string& name) {
  ways[name] += (ways[name].empty() ? "" : " ") + goal.getCommState().toString();
}
void onFeedback(Client::GoalHandle, const cpp_actions::CountFeedbackConstPtr& feedback) {
  feedbacks += feedback->sequence.at(0);
}
Client::GoalHandle send(Client& client, int order, const std::string& name) {
  cpp_actions::CountGoal goal;
  goal.order = order;
  return client.sendGoal(goal, boost::bind(&onTransition, _1, name), &onFeedback);
}
template <class Condition>
bool until(const Condition& condition) {
  for (int i = 0; i < 6000 && ros::ok() && !condition(); ++i) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  return condition();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "many");
  Holder holder;
  Client client("hold");
  CHECK(until([&] { return client.isServerConnected(); }));
  Client::GoalHandle one = send(client, 1, "one"), two = send(client, 2, "two"), three = send(client, 3, "three");
  Client::GoalHandle bad = send(client, -1, "bad");
  CHECK(one != two && one == one && !one.isExpired() && Client::GoalHandle().isExpired());
  CHECK(until([&] { return holder.size() == 3 && feedbacks == 6; }));
  CHECK(until([&] { return bad.getCommState() == actionlib::CommState::DONE; }));
  CHECK(bad.getTerminalState() == actionlib::TerminalState::REJECTED && bad.getTerminalState().getText() == "negative");
  CHECK(!two.getResult() && until([&] { return two.getCommState() == actionlib::CommState::ACTIVE; }));
  holder.finish(2, true);
  holder.finish(3, false);
  CHECK(until([&] { return two.getCommState() == actionlib::CommState::DONE; }));
  CHECK(two.getResult()->sequence.size() == 2 && two.getTerminalState().toString() == "SUCCEEDED");
  CHECK(until([&] { return three.getTerminalState() == actionlib::TerminalState::ABORTED; }));
  one.cancel();
  CHECK(until([&] { return one.getTerminalState() == actionlib::TerminalState::PREEMPTED; }));
  CHECK(ways["two"] == "PENDING ACTIVE WAITING_FOR_RESULT DONE");
  CHECK(ways["one"] == "PENDING ACTIVE WAITING_FOR_CANCEL_ACK PREEMPTING WAITING_FOR_RESULT DONE");
  CHECK(ways["bad"] == "PENDING WAITING_FOR_RESULT DONE");
  two.reset();
  CHECK(two.isExpired() && !two.getResult());
  const actionlib::SimpleActionServer<cpp_actions::CountAction> started("started");
  Client other("started");
  CHECK(until([&] { return other.isServerConnected(); }));
  actionlib::DestructionGuard guard;
  {
    const actionlib::DestructionGuard::ScopedProtector user(guard);
    CHECK(user.isProtected());
  }
  guard.destruct();
  CHECK(!guard.tryProtect());
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
