#include <ros/ros.h>
#include <std_msgs/String.h>

#include <sstream>

int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle n;
  ros::Publisher pub = n.advertise<std_msgs::String>("chatter", 1000);
  ros::Rate rate(20);
  int count = 0;
  while (ros::ok()) {
    std_msgs::String msg;
    std::stringstream text;
    text << "hello world " << count++;
    msg.data = text.str();
    ROS_INFO("%s", msg.data.c_str());
    pub.publish(msg);
    ros::spinOnce();
    rate.sleep();
  }
  return 0;
}
