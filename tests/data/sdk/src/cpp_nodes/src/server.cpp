#include <cpp_nodes/AddTwoInts.h>
#include <ros/ros.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include "cpp_nodes/sums.h"

class Server {
 public:
  Server() : private_("~") {
    private_.param<std::string>("greeting", greeting_, "hello");
    service_ = n_.advertiseService("add_two_ints", &Server::add, this);
    echo_ = n_.advertise<std_msgs::String>("echo", 10, true);
    subscriber_ = n_.subscribe("words", 10, &Server::onWord, this);
    timer_ = n_.createTimer(ros::Duration(0.1), &Server::onTimer, this);
    ticks_ = private_.advertise<std_msgs::Float64>("ticks", 1);
  }

 private:
  bool add(cpp_nodes::AddTwoInts::Request& req, cpp_nodes::AddTwoInts::Response& res) {
    res.sum = sumOf(req.a, req.b);
    ROS_INFO_STREAM("request: x=" << req.a << ", y=" << req.b);
    return req.a != 13;  // which brings bad luck
  }
  void onWord(const std_msgs::String::ConstPtr& word) {
    std_msgs::String answer;
    answer.data = greeting_ + " " + word->data;
    echo_.publish(answer);
  }
  void onTimer(const ros::TimerEvent& event) {
    std_msgs::Float64 tick;
    tick.data = event.current_expected.toSec();
    ticks_.publish(tick);
  }

  ros::NodeHandle n_, private_;
  std::string greeting_;
  ros::ServiceServer service_;
  ros::Publisher echo_, ticks_;
  ros::Subscriber subscriber_;
  ros::Timer timer_;
};

// Tells why it is asked to end, and what it publishes then.
void onShutdown(XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
  ros::TopicManager& topics = *ros::TopicManager::instance();
  ROS_INFO("asked: %s; latched %d %d, readers %zu", static_cast<std::string>(parameters[1]).c_str(),
           topics.isLatched("/echo"), topics.isLatched("/none"),
           topics.getNumSubscribers("/add_two_ints_server/ticks"));
  ros::requestShutdown();
  result = ros::xmlrpc::responseInt(1, "", 0);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "add_two_ints_server");
  Server server;
  if (ros::param::param<bool>("~tells", false)) {
    ros::XMLRPCManager& manager = *ros::XMLRPCManager::instance();
    if (manager.bind("shutdown", onShutdown)) ROS_ERROR("shutdown had no answer");
    manager.unbind("shutdown");
    manager.bind("shutdown", onShutdown);
  }
  ros::spin();
  ROS_INFO("bye");
}
