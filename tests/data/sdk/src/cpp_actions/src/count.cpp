// A server that counts; with an argument also its client, which prints a line for each check that fails.
#include <actionlib/client/service_client.h>
#include <actionlib/client/simple_action_client.h>
#include <actionlib/client/terminal_state.h>
#include <actionlib/server/service_server.h>
#include <actionlib/server/simple_action_server.h>
#include <cpp_actions/CountAction.h>
#include <ros/ros.h>

#include <iostream>
#include <mutex>

class Counter {
 public:
  explicit Counter(const std::string& name)
      : server_(n_, name, boost::bind(&Counter::execute, this, _1), false) {
    server_.start();
  }

 private:
  void execute(const cpp_actions::CountGoalConstPtr& goal) {
    cpp_actions::CountFeedback feedback;
    cpp_actions::CountResult result;
    if (goal->order < 0) {
      server_.setAborted(result, "cannot count down");
      return;
    }
    for (int i = 0; i < goal->order; ++i) {
      if (server_.isPreemptRequested() || !ros::ok()) {
        result.sequence = feedback.sequence;
        server_.setPreempted(result);
        return;
      }
      feedback.sequence.push_back(i);
      server_.publishFeedback(feedback);
      ros::WallDuration(0.02).sleep();
    }
    result.sequence = feedback.sequence;
    server_.setSucceeded(result, "done");
  }

  ros::NodeHandle n_;
  actionlib::SimpleActionServer<cpp_actions::CountAction> server_;
};

namespace {

typedef actionlib::SimpleActionClient<cpp_actions::CountAction> Client;
int made = 0, failed = 0, feedbacks = 0, done = 0, active = 0;
#define CHECK(cond)                                                    \
  do {                                                                 \
    ++made;                                                            \
    if (!(cond)) {                                                     \
      ++failed;                                                        \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                  \
  } while (false)

void onDone(const actionlib::SimpleClientGoalState& state, const cpp_actions::CountResultConstPtr& result) {
  ros::WallDuration(0.1).sleep();  // waitForResult waits for this, too
  done += state == actionlib::SimpleClientGoalState::SUCCEEDED && result->sequence.size() == 5 ? 1 : -100;
}
void onActive() { ++active; }
void onFeedback(const cpp_actions::CountFeedbackConstPtr& feedback) { feedbacks += feedback->sequence.size() > 0; }

void ignoreCancel(const actionlib_msgs::GoalIDConstPtr&) {}

/** The result may come when the server has ceased to list the goal. */
void checkLateResult() {
  ros::NodeHandle node("late");
  ros::Publisher status = node.advertise<actionlib_msgs::GoalStatusArray>("status", 10);
  ros::Publisher feedback = node.advertise<cpp_actions::CountActionFeedback>("feedback", 10);
  ros::Publisher results = node.advertise<cpp_actions::CountActionResult>("result", 10);
  std::mutex mutex;
  cpp_actions::CountActionResult ended;
  ros::Subscriber cancels = node.subscribe("cancel", 10, &ignoreCancel);
  ros::Subscriber goals = node.subscribe<cpp_actions::CountActionGoal>(
      "goal", 10, [&](const cpp_actions::CountActionGoalConstPtr& goal) {
        const std::lock_guard<std::mutex> lock(mutex);
        ended.status.goal_id = goal->goal_id;
      });
  const auto isSent = [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return !ended.status.goal_id.id.empty();
  };
  Client client("late");
  while (!client.waitForServer(ros::Duration(0.1))) status.publish(actionlib_msgs::GoalStatusArray());
  client.sendGoal(cpp_actions::CountGoal());
  while (!isSent()) ros::WallDuration(0.01).sleep();
  actionlib_msgs::GoalStatusArray listed;
  listed.status_list.assign(1, ended.status);
  listed.status_list[0].status = actionlib_msgs::GoalStatus::ACTIVE;
  status.publish(listed);
  listed.status_list[0].status = ended.status.status = actionlib_msgs::GoalStatus::SUCCEEDED;
  status.publish(listed);
  status.publish(actionlib_msgs::GoalStatusArray());
  CHECK(!client.waitForResult(ros::Duration(0.3)));
  results.publish(ended);
  CHECK(client.waitForResult(ros::Duration(30.0)));
  CHECK(client.getState() == actionlib::SimpleClientGoalState::SUCCEEDED);
}

void check() {
  Client client("count", true);
  CHECK(client.waitForServer(ros::Duration(30.0)));
  cpp_actions::CountGoal goal;
  goal.order = 5;
  client.sendGoal(goal, &onDone, &onActive, &onFeedback);
  CHECK(client.waitForResult(ros::Duration(30.0)));
  CHECK(client.getState().toString() == "SUCCEEDED" && client.getState().getText() == "done");
  CHECK(client.getResult()->sequence.back() == 4 && feedbacks > 0);
  CHECK(done == 1 && active == 1);
  goal.order = -1;
  CHECK(client.sendGoalAndWait(goal, ros::Duration(30.0)) == actionlib::SimpleClientGoalState::ABORTED);
  goal.order = 100000;
  client.sendGoal(goal);
  CHECK(!client.waitForResult(ros::Duration(0.3)));
  client.cancelGoal();
  CHECK(client.waitForResult(ros::Duration(30.0)));
  CHECK(client.getState() == actionlib::SimpleClientGoalState::PREEMPTED && client.getState().isDone());
  // A newer goal takes the place of the older.
  Client other("count");
  CHECK(other.waitForServer(ros::Duration(30.0)));
  client.sendGoal(goal);
  ros::WallDuration(0.3).sleep();
  goal.order = 2;
  CHECK(other.sendGoalAndWait(goal, ros::Duration(30.0)) == actionlib::SimpleClientGoalState::SUCCEEDED);
  CHECK(client.waitForResult(ros::Duration(30.0)));
  CHECK(client.getState() == actionlib::SimpleClientGoalState::PREEMPTED);
  // The action as a service.
  actionlib::ServiceClient service = actionlib::serviceClient<cpp_actions::CountAction>(ros::NodeHandle(), "count");
  CHECK(service.waitForServer(ros::Duration(30.0)) && service.isServerConnected());
  cpp_actions::CountResult result;
  goal.order = 3;
  CHECK(service.call(goal, result) && result.sequence.size() == 3);
  CHECK(!service.call(result, result));
  const actionlib::ServiceServer server = actionlib::advertiseService<cpp_actions::CountAction>(
      ros::NodeHandle(), "half", [](const cpp_actions::CountGoal& asked, cpp_actions::CountResult& half) {
        half.sequence.assign(1, asked.order / 2);
        return asked.order >= 0;
      });
  actionlib::ServiceClient halves = actionlib::serviceClient<cpp_actions::CountAction>(ros::NodeHandle(), "half");
  CHECK(halves.waitForServer(ros::Duration(30.0)));
  goal.order = 8;
  CHECK(halves.call(goal, result) && result.sequence.at(0) == 4);
  goal.order = -1;
  CHECK(!halves.call(goal, result));
  checkLateResult();
  Client none("nothing");
  CHECK(!none.waitForServer(ros::Duration(0.2)) && !none.isServerConnected());
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "counter");
  Counter counter("count");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  if (argc < 2) {
    ros::waitForShutdown();
    return 0;
  }
  check();
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
