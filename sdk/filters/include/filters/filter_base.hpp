#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

namespace filters {

typedef std::map<std::string, XmlRpc::XmlRpcValue> string_map_t;

/** Filter of values of one type, configured by a map: {name: text, type: package/Class, params: {…}}. */
template <typename T>
class FilterBase {
 public:
  FilterBase() : configured_(false) {}
  virtual ~FilterBase() {}

  /** Read the configuration from a parameter; false if there is none, or the filter refuses it. */
  bool configure(const std::string& param_name, ros::NodeHandle node_handle = ros::NodeHandle()) {
    XmlRpc::XmlRpcValue config;
    return findConfiguration(param_name, node_handle, config) && configure(config);
  }
  bool configure(XmlRpc::XmlRpcValue& config) {
    if (configured_) ROS_WARN("Filter %s of type %s is configured again", filter_name_.c_str(), filter_type_.c_str());
    configured_ = loadConfiguration(config) && configure();
    return configured_;
  }
  virtual bool update(const T& data_in, T& data_out) = 0;

  std::string getType() { return filter_type_; }
  const std::string& getName() const { return filter_name_; }

 protected:
  /** Read the parameters; false if one is missing or wrong. */
  virtual bool configure() = 0;

  bool getParam(const std::string& name, std::string& value) const {
    return read(name, XmlRpc::XmlRpcValue::TypeString, value);
  }
  bool getParam(const std::string& name, bool& value) const {
    return read(name, XmlRpc::XmlRpcValue::TypeBoolean, value);
  }
  /** An integer is a number, too. */
  bool getParam(const std::string& name, double& value) const {
    const string_map_t::const_iterator found = params_.find(name);
    return found != params_.end() && toDouble(found->second, value);
  }
  bool getParam(const std::string& name, int& value) const { return read(name, XmlRpc::XmlRpcValue::TypeInt, value); }
  /** False for a negative one. */
  bool getParam(const std::string& name, unsigned int& value) const {
    int number = 0;
    if (!getParam(name, number) || number < 0) return false;
    value = static_cast<unsigned int>(number);
    return true;
  }
  bool getParam(const std::string& name, std::vector<double>& value) const {
    XmlRpc::XmlRpcValue list;
    if (!read(name, XmlRpc::XmlRpcValue::TypeArray, list)) return false;
    std::vector<double> numbers(list.size());
    for (int i = 0; i < list.size(); ++i)
      if (!toDouble(list[i], numbers[i])) return false;
    value.swap(numbers);
    return true;
  }
  bool getParam(const std::string& name, std::vector<std::string>& value) const {
    XmlRpc::XmlRpcValue list;
    if (!read(name, XmlRpc::XmlRpcValue::TypeArray, list)) return false;
    std::vector<std::string> texts;
    for (int i = 0; i < list.size(); ++i) {
      if (list[i].getType() != XmlRpc::XmlRpcValue::TypeString) return false;
      texts.push_back(static_cast<std::string>(list[i]));
    }
    value.swap(texts);
    return true;
  }
  bool getParam(const std::string& name, XmlRpc::XmlRpcValue& value) const {
    const string_map_t::const_iterator found = params_.find(name);
    if (found == params_.end()) return false;
    value = found->second;
    return true;
  }

  /** Read name, type and params of a configuration. */
  bool loadConfiguration(XmlRpc::XmlRpcValue& config) {
    if (config.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
      ROS_ERROR("A filter's configuration must be a map with the fields name, type and params");
      return false;
    }
    for (const char* const key : {"name", "type"})
      if (!config.hasMember(key) || config[key].getType() != XmlRpc::XmlRpcValue::TypeString) {
        ROS_ERROR("A filter's configuration must have a %s, which is a text", key);
        return false;
      }
    filter_name_ = static_cast<std::string>(config["name"]);
    filter_type_ = static_cast<std::string>(config["type"]);
    if (!config.hasMember("params")) return true;
    XmlRpc::XmlRpcValue& params = config["params"];
    if (params.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
      ROS_ERROR("params of filter %s must be a map", filter_name_.c_str());
      return false;
    }
    for (XmlRpc::XmlRpcValue::iterator it = params.begin(); it != params.end(); ++it) params_[it->first] = it->second;
    return true;
  }

  static bool findConfiguration(const std::string& name, ros::NodeHandle& node, XmlRpc::XmlRpcValue& config) {
    if (node.getParam(name, config)) return true;
    ROS_ERROR("There is no parameter %s, which configures a filter", node.resolveName(name).c_str());
    return false;
  }

  std::string filter_name_, filter_type_;
  bool configured_;
  string_map_t params_;

 private:
  template <class Value>
  bool read(const std::string& name, XmlRpc::XmlRpcValue::Type type, Value& value) const {
    const string_map_t::const_iterator found = params_.find(name);
    if (found == params_.end() || found->second.getType() != type) return false;
    XmlRpc::XmlRpcValue copy = found->second;
    value = static_cast<Value&>(copy);
    return true;
  }
  static bool toDouble(XmlRpc::XmlRpcValue number, double& value) {
    if (number.getType() == XmlRpc::XmlRpcValue::TypeInt) {
      value = static_cast<int>(number);
      return true;
    }
    if (number.getType() != XmlRpc::XmlRpcValue::TypeDouble) return false;
    value = static_cast<double>(number);
    return true;
  }
};

/** Filter of several channels at once. */
template <typename T>
class MultiChannelFilterBase : public FilterBase<T> {
 public:
  MultiChannelFilterBase() : number_of_channels_(0) {}

  bool configure(unsigned int number_of_channels, const std::string& param_name,
                 ros::NodeHandle node_handle = ros::NodeHandle()) {
    XmlRpc::XmlRpcValue config;
    return this->findConfiguration(param_name, node_handle, config) && configure(number_of_channels, config);
  }
  bool configure(unsigned int number_of_channels, XmlRpc::XmlRpcValue& config) {
    number_of_channels_ = number_of_channels;
    return FilterBase<T>::configure(config);
  }
  bool configure(XmlRpc::XmlRpcValue& config) {
    ROS_ERROR("A MultiChannelFilterBase is configured with a number of channels; 1 is assumed");
    return configure(1, config);
  }
  virtual bool configure() = 0;

  /** One value for each channel. */
  virtual bool update(const std::vector<T>& data_in, std::vector<T>& data_out) = 0;
  virtual bool update(const T&, T&) {
    ROS_ERROR("A MultiChannelFilterBase is updated with a value for each channel");
    return false;
  }

 protected:
  unsigned int number_of_channels_;
};

}  // namespace filters
