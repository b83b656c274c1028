#include <ros/console.h>
#include <urdf_parser/shallow_xml.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fstream>
#include <locale>
#include <sstream>

#include "srdfdom/model.h"

namespace srdf {
namespace {

using boost::property_tree::ptree;

std::string attribute(const ptree& element, const char* name) {
  return element.get<std::string>(ptree::path_type(std::string("<xmlattr>/") + name, '/'), "");
}

/** Whether the robot has a link; says which element names one that it lacks. */
bool hasLink(const urdf::ModelInterface& robot, const std::string& link, const std::string& of) {
  if (robot.getLink(link)) return true;
  ROS_WARN_NAMED("srdfdom", "Link '%s' declared as part of %s is not known to the URDF", link.c_str(), of.c_str());
  return false;
}
bool hasJoint(const urdf::ModelInterface& robot, const std::vector<Model::VirtualJoint>& virtual_joints,
              const std::string& joint, const std::string& of) {
  if (robot.getJoint(joint)) return true;
  for (const Model::VirtualJoint& known : virtual_joints)
    if (known.name_ == joint) return true;
  ROS_WARN_NAMED("srdfdom", "Joint '%s' declared as part of %s is not known to the URDF", joint.c_str(), of.c_str());
  return false;
}

std::vector<double> numbers(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::vector<double> result;
  for (double value = 0.0; stream >> value;) result.push_back(value);
  if (!stream.eof()) result.clear();
  return result;
}

Model::Group group(const urdf::ModelInterface& robot, const std::vector<Model::VirtualJoint>& virtual_joints,
                   const ptree& element) {
  Model::Group result;
  result.name_ = attribute(element, "name");
  const std::string of = "group '" + result.name_ + "'";
  for (const auto& [kind, child] : element) {
    const std::string name = attribute(child, "name");
    if (kind == "joint" && hasJoint(robot, virtual_joints, name, of)) result.joints_.push_back(name);
    if (kind == "link" && hasLink(robot, name, of)) result.links_.push_back(name);
    if (kind == "group") result.subgroups_.push_back(name);
    if (kind == "chain") {
      const std::string base = attribute(child, "base_link"), tip = attribute(child, "tip_link");
      if (hasLink(robot, base, of) && hasLink(robot, tip, of)) result.chains_.emplace_back(base, tip);
    }
  }
  return result;
}

Model::GroupState groupState(const ptree& element) {
  Model::GroupState result;
  result.name_ = attribute(element, "name");
  result.group_ = attribute(element, "group");
  for (const auto& [kind, child] : element) {
    if (kind != "joint") continue;
    const std::vector<double> values = numbers(attribute(child, "value"));
    if (values.empty()) {
      ROS_WARN_NAMED("srdfdom", "Unable to parse joint value '%s' for joint '%s' in group state '%s'",
                     attribute(child, "value").c_str(), attribute(child, "name").c_str(), result.name_.c_str());
      continue;
    }
    result.joint_values_[attribute(child, "name")] = values;
  }
  return result;
}

}  // namespace

bool Model::initFile(const urdf::ModelInterface& urdf_model, const std::string& filename) {
  std::ifstream file(filename);
  if (!file) {
    ROS_ERROR_NAMED("srdfdom", "Could not open file [%s] for parsing.", filename.c_str());
    return false;
  }
  std::ostringstream text;
  text << file.rdbuf();
  return initString(urdf_model, text.str());
}

bool Model::initString(const urdf::ModelInterface& urdf_model, const std::string& xmlstring) {
  clear();
  if (!urdf::isShallow(xmlstring)) {
    ROS_ERROR_NAMED("srdfdom", "there are too many elements in elements");
    return false;
  }
  ptree document;
  try {
    std::istringstream stream(xmlstring);
    boost::property_tree::read_xml(stream, document);
  } catch (const boost::property_tree::xml_parser_error& error) {
    ROS_ERROR_NAMED("srdfdom", "SRDF, line %lu: %s", error.line(), error.message().c_str());
    return false;
  }
  const auto robot = document.get_child_optional("robot");
  if (!robot) {
    ROS_ERROR_NAMED("srdfdom", "Could not find the 'robot' element in the SRDF");
    return false;
  }
  name_ = attribute(*robot, "name");
  if (name_ != urdf_model.getName())
    ROS_WARN_NAMED("srdfdom", "Semantic description is not specified for the same robot as the URDF");
  for (const auto& [kind, element] : *robot) {
    if (kind != "virtual_joint") continue;
    VirtualJoint joint{attribute(element, "name"), attribute(element, "type"), attribute(element, "parent_frame"),
                       attribute(element, "child_link")};
    if (hasLink(urdf_model, joint.child_link_, "virtual joint '" + joint.name_ + "'")) virtual_joints_.push_back(joint);
  }
  for (const auto& [kind, element] : *robot) {
    if (kind == "group") groups_.push_back(group(urdf_model, virtual_joints_, element));
    if (kind == "group_state") group_states_.push_back(groupState(element));
    if (kind == "end_effector") {
      end_effectors_.push_back({attribute(element, "name"), attribute(element, "parent_link"),
                                attribute(element, "parent_group"), attribute(element, "group")});
    }
    if (kind == "passive_joint") passive_joints_.push_back({attribute(element, "name")});
    if (kind == "disable_collisions") {
      disabled_collisions_.push_back(
          {attribute(element, "link1"), attribute(element, "link2"), attribute(element, "reason")});
    }
  }
  return true;
}

}  // namespace srdf
