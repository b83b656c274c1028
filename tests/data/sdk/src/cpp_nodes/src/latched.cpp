// Publishes numbers on a latched topic, as fast as it can.
#include <ros/ros.h>
#include <std_msgs/UInt32.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "latched");
  ros::NodeHandle n;
  ros::Publisher numbers = n.advertise<std_msgs::UInt32>("numbers", 0, true);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  std_msgs::UInt32 number;
  while (ros::ok()) {
    numbers.publish(number);
    ++number.data;
  }
  return 0;
}
