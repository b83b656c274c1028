// A nodelet that repeats what it hears.
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.h>
#include <std_msgs/String.h>

namespace cpp_plugins {

class Echo : public nodelet::Nodelet {
 private:
  void onInit() override {
    ros::NodeHandle& own = getPrivateNodeHandle();
    if (own.param("fails", false)) throw std::runtime_error("as it was told");
    prefix_ = own.param<std::string>("prefix", "echo");
    for (const std::string& word : getMyArgv()) prefix_ += " " + word;
    publisher_ = getNodeHandle().advertise<std_msgs::String>("out", 10);
    subscriber_ = getMTNodeHandle().subscribe("in", 10, &Echo::onMessage, this);
    NODELET_INFO("%s is ready", getName().c_str());
    NODELET_DEBUG_STREAM("prefix " << prefix_);
    NODELET_WARN_STREAM_COND_NAMED(prefix_.empty(), "start", "no " << "prefix");
  }
  void onMessage(const std_msgs::StringConstPtr& message) {
    std_msgs::String answer;
    answer.data = prefix_ + ": " + message->data;
    publisher_.publish(answer);
  }

  std::string prefix_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace cpp_plugins

PLUGINLIB_EXPORT_CLASS(cpp_plugins::Echo, nodelet::Nodelet)
