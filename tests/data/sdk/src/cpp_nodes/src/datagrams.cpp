// datagrams SIZE: publishes strings of SIZE bytes on "out", and repeats what comes on "in" by UDPROS, from
// datagrams of at most ~datagram bytes, as a sentence on "report".
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <cstdlib>

ros::Publisher report;

std::string pattern(size_t size) {
  std::string text(size, ' ');
  for (size_t i = 0; i < size; ++i) text[i] = static_cast<char>('a' + i % 23);
  return text;
}

void receive(const ros::MessageEvent<std_msgs::String const>& event) {
  const std::string& text = event.getMessage()->data;
  std_msgs::String said;
  said.data = std::to_string(text.size()) + (text == pattern(text.size()) ? " bytes from " : " wrong bytes from ") +
              event.getPublisherName();
  report.publish(said);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "datagrams");
  ros::NodeHandle n;
  report = n.advertise<std_msgs::String>("report", 100);
  ros::Publisher out = n.advertise<std_msgs::String>("out", 10);
  const int size = ros::NodeHandle("~").param("datagram", 0);
  const ros::Subscriber in =
      n.subscribe("in", 10, receive, ros::TransportHints().unreliable().maxDatagramSize(size));
  std_msgs::String message;
  message.data = pattern(argc > 1 ? static_cast<size_t>(std::atoi(argv[1])) : 0);
  for (ros::Rate rate(20); ros::ok(); rate.sleep()) {
    out.publish(message);
    ros::spinOnce();
  }
}
