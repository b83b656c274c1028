// Prints the links and joints of robot_description; then a marker with a menu, which tells how it is moved.
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <urdf/model.h>

#include <iostream>
#include <sstream>

namespace {

void print(const urdf::LinkConstSharedPtr& link, const std::string& indent) {
  std::cout << indent << link->name;
  if (link->inertial) std::cout << " " << link->inertial->mass << " kg";
  if (link->visual && link->visual->geometry->type == urdf::Geometry::BOX)
    std::cout << " box " << urdf::dynamic_pointer_cast<urdf::Box>(link->visual->geometry)->dim.z;
  if (link->visual && link->visual->material) std::cout << " green " << link->visual->material->color.g;
  std::cout << std::endl;
  for (const urdf::LinkSharedPtr& child : link->child_links) {
    const urdf::JointSharedPtr joint = child->parent_joint;
    double roll, pitch, yaw;
    joint->parent_to_joint_origin_transform.rotation.getRPY(roll, pitch, yaw);
    std::cout << indent << " " << joint->name << " " << joint->type << " axis " << joint->axis.z << " yaw " << yaw;
    if (joint->limits) std::cout << " to " << joint->limits->upper;
    if (joint->mimic) std::cout << " as " << joint->mimic->joint_name;
    std::cout << std::endl;
    print(child, indent + "  ");
  }
}

ros::Publisher told;
void tell(const std::string& text) {
  std_msgs::String message;
  message.data = text;
  told.publish(message);
}

void onFeedback(const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
  std::stringstream text;
  text << feedback->marker_name << " " << int(feedback->event_type) << " " << feedback->pose.position.x;
  tell(text.str());
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "robot");
  ros::NodeHandle node;
  urdf::Model robot;
  if (!robot.initParam("robot_description")) {
    std::cout << "invalid" << std::endl;
    return 1;
  }
  std::cout << robot.getName() << " " << robot.links_.size() << std::endl;
  print(robot.getRoot(), "");
  std::cout << (robot.getJoint("none") ? "?" : "end") << std::endl;

  told = node.advertise<std_msgs::String>("told", 10, true);
  interactive_markers::InteractiveMarkerServer server("markers");
  visualization_msgs::InteractiveMarker marker;
  marker.header.frame_id = "base";
  marker.name = "goal";
  server.insert(marker, &onFeedback);
  interactive_markers::MenuHandler menu;
  const interactive_markers::MenuHandler::EntryHandle first =
      menu.insert("Go", [&](const visualization_msgs::InteractiveMarkerFeedbackConstPtr&) {
        interactive_markers::MenuHandler::CheckState state;
        menu.getCheckState(1, state);
        menu.setCheckState(1, state == interactive_markers::MenuHandler::CHECKED
                                  ? interactive_markers::MenuHandler::UNCHECKED
                                  : interactive_markers::MenuHandler::CHECKED);
        menu.reApply(server);
        server.applyChanges();
        tell("menu");
      });
  menu.setCheckState(first, interactive_markers::MenuHandler::UNCHECKED);
  menu.setVisible(menu.insert(first, "Hidden"), false);
  menu.insert(first, "Below");
  menu.apply(server, "goal");
  server.applyChanges();
  ros::spin();
  return 0;
}
