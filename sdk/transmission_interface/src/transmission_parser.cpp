#include <transmission_interface/transmission_parser.h>

#include <ros/console.h>
#include <urdf_parser/shallow_xml.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>

namespace transmission_interface {
namespace {

using boost::property_tree::ptree;

std::string name_of(const ptree& element) {
  return element.get<std::string>(ptree::path_type("<xmlattr>/name", '/'), "");
}

std::string written(const std::string& tag, const ptree& element) {
  ptree parent;
  parent.add_child(tag, element);
  std::ostringstream text;
  boost::property_tree::write_xml(text, parent);
  const std::string xml = text.str();
  const std::size_t end = xml.find("?>");  // of the declaration
  return end == std::string::npos ? xml : xml.substr(xml.find_first_not_of("\n", end + 2));
}

std::vector<std::string> interfaces_of(const ptree& element) {
  std::vector<std::string> names;
  for (const auto& child : element)
    if (child.first == "hardwareInterface" && !child.second.data().empty()) names.push_back(child.second.data());
  return names;
}

// Fault of a transmission, which is left out; "" if there is none.
std::string read(const ptree& element, TransmissionInfo& info) {
  info.name_ = name_of(element);
  if (info.name_.empty()) return "has no name";
  info.type_ = element.get<std::string>("type", "");
  if (info.type_.empty()) return "has no <type>";
  for (const auto& child : element) {
    if (child.first == "joint") {
      info.joints_.push_back({name_of(child.second), interfaces_of(child.second),
                              child.second.get<std::string>("role", ""), written("joint", child.second)});
      if (info.joints_.back().name_.empty()) return "has a <joint> without a name";
      if (info.joints_.back().hardware_interfaces_.empty())
        ROS_DEBUG_STREAM("Joint '" << info.joints_.back().name_ << "' of transmission '" << info.name_
                                   << "' names no hardware interface.");
    } else if (child.first == "actuator") {
      info.actuators_.push_back(
          {name_of(child.second), interfaces_of(child.second), written("actuator", child.second)});
      if (info.actuators_.back().name_.empty()) return "has an <actuator> without a name";
    }
  }
  if (info.joints_.empty()) return "has no <joint>";
  return info.actuators_.empty() ? "has no <actuator>" : "";
}

}  // namespace

bool TransmissionParser::parse(const std::string& urdf_string, std::vector<TransmissionInfo>& transmissions) {
  ptree document;
  try {
    if (!urdf::isShallow(urdf_string)) throw std::runtime_error("it has too many elements in elements");
    std::istringstream text(urdf_string);
    boost::property_tree::read_xml(text, document, boost::property_tree::xml_parser::trim_whitespace);
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("Could not parse transmissions: the robot's description is no XML: " << error.what());
    return false;
  }
  const auto robot = document.get_child_optional("robot");
  if (!robot) {
    ROS_ERROR("Could not find the 'robot' element in the URDF");
    return false;
  }
  const std::size_t before = transmissions.size();
  for (const auto& child : *robot) {
    if (child.first != "transmission") continue;
    TransmissionInfo info;
    const std::string fault = read(child.second, info);
    if (fault.empty()) transmissions.push_back(info);
    else ROS_WARN_STREAM("Transmission '" << info.name_ << "' " << fault << "; it is left out.");
  }
  if (transmissions.size() == before) ROS_DEBUG("No valid transmissions found.");
  return transmissions.size() > before;
}

}  // namespace transmission_interface
