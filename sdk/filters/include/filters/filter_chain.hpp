#pragma once

#include <filters/filter_base.hpp>
#include <filters/standard_filters.hpp>
#include <pluginlib/class_loader.hpp>

#include <memory>
#include <set>

namespace filters {

/** What FilterChain and MultiChannelFilterChain share: filters in their order, each by its plugin. */
template <class Filter, class Values>
class FilterList {
 public:
  /** Copies share the filters. */
  std::vector<std::shared_ptr<Filter> > getFilters() const { return filters_; }
  /** Remove the filters; without any, values pass as they are. */
  bool clear() {
    filters_.clear();
    return true;
  }

 protected:
  FilterList(const std::string& base) : loader_("filters", base) {}
  ~FilterList() {}

  /** Make the filters of a list of configurations, each configured by a function; false leaves none. */
  template <class Configure>
  bool make(XmlRpc::XmlRpcValue& config, const std::string& where, Configure configure) {
    clear();
    std::vector<std::shared_ptr<Filter> > made;
    if (config.getType() != XmlRpc::XmlRpcValue::TypeArray) {
      ROS_ERROR("%s: a chain of filters must be a list of maps", where.c_str());
      return false;
    }
    std::set<std::string> names;
    for (int i = 0; i < config.size(); ++i) {
      XmlRpc::XmlRpcValue& item = config[i];
      for (const char* const key : {"name", "type"})
        if (item.getType() != XmlRpc::XmlRpcValue::TypeStruct || !item.hasMember(key) ||
            item[key].getType() != XmlRpc::XmlRpcValue::TypeString) {
          ROS_ERROR("%s: filter %d of the chain must be a map with a %s, which is a text", where.c_str(), i, key);
          return false;
        }
      const std::string name = item["name"], type = item["type"];
      if (!names.insert(name).second) {
        ROS_ERROR("%s: two filters of the chain have the name %s", where.c_str(), name.c_str());
        return false;
      }
      const std::shared_ptr<Filter> filter = create(type, where);
      if (!filter) return false;
      if (!configure(*filter, item)) {
        ROS_ERROR("%s: filter %s of type %s could not be configured", where.c_str(), name.c_str(), type.c_str());
        return false;
      }
      made.push_back(filter);
    }
    filters_.swap(made);
    return true;
  }

  /** Configuration in a parameter, or in filter_chain within; false if there is none. */
  static bool find(const std::string& name, ros::NodeHandle& node, XmlRpc::XmlRpcValue& config) {
    if (!node.getParam(name + "/filter_chain", config)) return node.getParam(name, config);
    ROS_WARN("The list of %s/filter_chain should be in %s itself", name.c_str(), node.resolveName(name).c_str());
    return true;
  }

  /** Update all filters; false once one fails. */
  bool pass(const Values& in, Values& out) {
    if (filters_.empty()) {
      out = in;
      return true;
    }
    const Values* before = &in;
    for (std::size_t i = 0; i + 1 < filters_.size(); ++i) {
      if (!filters_[i]->update(*before, between_[i % 2])) return false;
      before = &between_[i % 2];
    }
    return filters_.back()->update(*before, out);
  }

  Values between_[2];

 private:
  std::shared_ptr<Filter> create(const std::string& type, const std::string& where) {
    if (Filter* const standard = makeStandard(type, static_cast<Filter*>(nullptr)))
      return std::shared_ptr<Filter>(standard);
    try {
      return loader_.createSharedInstance(type);
    } catch (const pluginlib::PluginlibException& error) {
      ROS_ERROR("%s: there is no filter of type %s: %s", where.c_str(), type.c_str(), error.what());
    }
    return std::shared_ptr<Filter>();
  }

  pluginlib::ClassLoader<Filter> loader_;
  std::vector<std::shared_ptr<Filter> > filters_;
};

/** Filters one after the other. */
template <typename T>
class FilterChain : public FilterList<FilterBase<T>, T> {
 public:
  /** `data_type`: name of T in plugin descriptions, such as sensor_msgs::LaserScan. */
  FilterChain(std::string data_type) : FilterList<FilterBase<T>, T>("filters::FilterBase<" + data_type + ">") {}

  /** Make the filters of a list in a parameter; without it, there are none. */
  bool configure(std::string param_name, ros::NodeHandle node = ros::NodeHandle()) {
    XmlRpc::XmlRpcValue config;
    if (this->find(param_name, node, config)) return configure(config, node.getNamespace());
    ROS_DEBUG("There is no parameter %s: the chain has no filters", node.resolveName(param_name).c_str());
    return this->clear();
  }
  bool configure(XmlRpc::XmlRpcValue& config, const std::string& filter_ns) {
    return this->make(config, filter_ns,
                      [](FilterBase<T>& filter, XmlRpc::XmlRpcValue& item) { return filter.configure(item); });
  }
  /** False if a filter fails; data_out is the result of the last. */
  bool update(const T& data_in, T& data_out) { return this->pass(data_in, data_out); }
};

/** Filters of several channels, one after the other. */
template <typename T>
class MultiChannelFilterChain : public FilterList<MultiChannelFilterBase<T>, std::vector<T> > {
 public:
  MultiChannelFilterChain(std::string data_type)
      : FilterList<MultiChannelFilterBase<T>, std::vector<T> >("filters::MultiChannelFilterBase<" + data_type + ">") {}

  /** Make the filters of a list in a parameter for a number of channels; false without it. */
  bool configure(unsigned int size, std::string param_name, ros::NodeHandle node = ros::NodeHandle()) {
    XmlRpc::XmlRpcValue config;
    if (this->find(param_name, node, config)) return configure(size, config);
    ROS_ERROR("There is no parameter %s: the chain has no filters", node.resolveName(param_name).c_str());
    this->clear();
    return false;
  }
  bool configure(unsigned int size, XmlRpc::XmlRpcValue& config) {
    for (std::vector<T>& values : this->between_) values.assign(size, T());
    return this->make(config, "filters", [size](MultiChannelFilterBase<T>& filter, XmlRpc::XmlRpcValue& item) {
      return filter.configure(size, item);
    });
  }
  /** False if a filter fails, such as for another number of values than channels. */
  bool update(const std::vector<T>& data_in, std::vector<T>& data_out) { return this->pass(data_in, data_out); }
};

}  // namespace filters
