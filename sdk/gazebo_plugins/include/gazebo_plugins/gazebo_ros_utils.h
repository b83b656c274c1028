// Parts that plugins with a node share: names, parameters of the element, and the node's handle.
#ifndef GAZEBO_ROS_UTILS_H
#define GAZEBO_ROS_UTILS_H

#include <map>
#include <string>

#include <boost/algorithm/string.hpp>
#include <boost/shared_ptr.hpp>

#include <gazebo/gazebo_config.h>
#include <ros/ros.h>
#include <gazebo/common/common.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/Sensor.hh>

#ifndef GAZEBO_SENSORS_USING_DYNAMIC_POINTER_CAST
#define GAZEBO_SENSORS_USING_DYNAMIC_POINTER_CAST using std::dynamic_pointer_cast
#endif

namespace gazebo {

// First model of a sensor's scoped name.
inline std::string GetModelName(const sensors::SensorPtr& parent) {
  const std::string name = parent->ParentName();
  return name.substr(0, name.find("::"));
}

// Value of <robotNamespace>, or the sensor's model.
inline std::string GetRobotNamespace(const sensors::SensorPtr& parent, const sdf::ElementPtr& sdf,
                                     const char* info = nullptr) {
  std::string space;
  if (sdf->HasElement("robotNamespace")) space = sdf->Get<std::string>("robotNamespace");
  if (space.empty()) {
    space = GetModelName(parent);
    if (info) ROS_INFO_NAMED("utils", "%s missing <robotNamespace>, set to default: %s", info, space.c_str());
  }
  return space;
}

// A plugin's node and parameters.
class GazeboRos {
 public:
  GazeboRos(physics::ModelPtr& parent, sdf::ElementPtr sdf, const std::string& plugin) : sdf_(sdf), plugin_(plugin) {
    namespace_ = parent->GetName();
    if (sdf->HasElement("robotNamespace")) namespace_ = sdf->Get<std::string>("robotNamespace");
    if (!namespace_.empty()) namespace_ += "/";
    node_.reset(new ros::NodeHandle(namespace_));
    readCommonParameter();
  }
  GazeboRos(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& plugin) : sdf_(sdf), plugin_(plugin) {
    namespace_ = GetRobotNamespace(parent, sdf, plugin.c_str());
    node_.reset(new ros::NodeHandle(namespace_));
    readCommonParameter();
  }

  const char* info() const { return info_.c_str(); }
  boost::shared_ptr<ros::NodeHandle>& node() { return node_; }
  const boost::shared_ptr<ros::NodeHandle>& node() const { return node_; }
  std::string resolveTF(const std::string& name) {
    const std::string bare = !name.empty() && name[0] == '/' ? name.substr(1) : name;
    return tf_prefix_.empty() || (!name.empty() && name[0] == '/') ? bare : tf_prefix_ + "/" + bare;
  }
  void isInitialized() {
    if (!ros::isInitialized()) ROS_FATAL_STREAM_NAMED(plugin_, info() << " needs a node of ROS; run without --no-ros");
  }

  // Value of an element; the default, with a line of the log, without it.
  void getParameterBoolean(bool& value, const char* tag, const bool& missing) {
    value = missing;
    getParameterBoolean(value, tag);
  }
  void getParameterBoolean(bool& value, const char* tag) {
    if (!sdf_->HasElement(tag)) return absent(tag, value ? "true" : "false");
    const std::string text = boost::algorithm::to_lower_copy(sdf_->Get<std::string>(tag));
    if (text == "true" || text == "1") value = true;
    else if (text == "false" || text == "0") value = false;
    else ROS_WARN_NAMED(plugin_, "%s: <%s> must be true or false, not %s", info(), tag, text.c_str());
  }
  template <class T>
  void getParameter(T& value, const char* tag, const T& missing) {
    value = missing;
    getParameter<T>(value, tag);
  }
  template <class T>
  void getParameter(T& value, const char* tag) {
    if (sdf_->HasElement(tag)) value = sdf_->Get<T>(tag);
    else absent(tag, "its default");
  }
  template <class T>
  void getParameter(T& value, const char* tag, const std::map<std::string, T>& options, const T& missing) {
    value = missing;
    getParameter<T>(value, tag, options);
  }
  template <class T>
  void getParameter(T& value, const char* tag, const std::map<std::string, T>& options) {
    if (!sdf_->HasElement(tag)) return absent(tag, "its default");
    const std::string text = sdf_->Get<std::string>(tag);
    const auto found = options.find(text);
    if (found != options.end()) value = found->second;
    else ROS_WARN_NAMED(plugin_, "%s: <%s> has no option %s", info(), tag, text.c_str());
  }
  // Joint that an element names; null without the element. Throws if the model has none of this name.
  physics::JointPtr getJoint(physics::ModelPtr& parent, const char* tag, const std::string& missing) {
    std::string name = missing;
    getParameter<std::string>(name, tag, missing);
    const physics::JointPtr joint = parent->GetJoint(name);
    if (!joint) gzthrow(std::string(info()) << ": couldn't get joint named " << name);
    return joint;
  }

 private:
  void readCommonParameter() {
    info_ = plugin_ + "(ns = " + namespace_ + ")";
    bool is_debug = false;
    if (sdf_->HasElement("rosDebugLevel"))
      is_debug = boost::algorithm::to_lower_copy(sdf_->Get<std::string>("rosDebugLevel")) == "debug";
    if (is_debug && ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Debug))
      ros::console::notifyLoggerLevelsChanged();
    node_->param<std::string>("tf_prefix", tf_prefix_, "");
    if (sdf_->HasElement("tf_prefix")) tf_prefix_ = sdf_->Get<std::string>("tf_prefix");
  }
  void absent(const char* tag, const char* used) const {
    ROS_DEBUG_NAMED(plugin_, "%s: missing <%s>, default is %s", info_.c_str(), tag, used);
  }

  sdf::ElementPtr sdf_;
  std::string plugin_, namespace_, tf_prefix_, info_;
  boost::shared_ptr<ros::NodeHandle> node_;
};
typedef boost::shared_ptr<GazeboRos> GazeboRosPtr;

}  // namespace gazebo

#endif
