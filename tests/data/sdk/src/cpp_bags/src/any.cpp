// Passes on messages of any type, and tells their types.
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <topic_tools/shape_shifter.h>

#include <iostream>

ros::NodeHandle* node;
ros::Publisher publisher;

void callback(const topic_tools::ShapeShifter::ConstPtr& message) {
  if (!publisher) publisher = message->advertise(*node, "out", 10, true);
  publisher.publish(message);
  std::cout << message->getDataType() << ' ' << message->getMD5Sum() << ' ' << message->size() << ' '
            << (message->getMessageDefinition().empty() ? "" : "defined");
  try {
    std::cout << " '" << message->instantiate<std_msgs::String>()->data << "'" << std::endl;
  } catch (const topic_tools::ShapeShifterException& error) {
    std::cout << " " << error.what() << std::endl;
  }
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "any");
  ros::NodeHandle handle;
  node = &handle;
  const ros::Subscriber subscriber = handle.subscribe("in", 10, callback);
  ros::spin();
  return 0;
}
