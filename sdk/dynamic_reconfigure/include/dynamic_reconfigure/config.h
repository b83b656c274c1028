#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <cmath>
#include <string>
#include <vector>

namespace dynamic_reconfigure {

/** Parameter of a configuration: a member of class C. */
template <class C>
struct Parameter {
  Parameter(const char* name_, uint32_t level_, const char* description_, const char* edit_method_, int group_,
            int C::* member)
      : name(name_),
        type("int"),
        level(level_),
        description(description_),
        edit_method(edit_method_),
        group(group_),
        int_member(member) {}
  Parameter(const char* name_, uint32_t level_, const char* description_, const char* edit_method_, int group_,
            double C::* member)
      : name(name_),
        type("double"),
        level(level_),
        description(description_),
        edit_method(edit_method_),
        group(group_),
        double_member(member) {}
  Parameter(const char* name_, uint32_t level_, const char* description_, const char* edit_method_, int group_,
            bool C::* member)
      : name(name_),
        type("bool"),
        level(level_),
        description(description_),
        edit_method(edit_method_),
        group(group_),
        bool_member(member) {}
  Parameter(const char* name_, uint32_t level_, const char* description_, const char* edit_method_, int group_,
            std::string C::* member)
      : name(name_),
        type("str"),
        level(level_),
        description(description_),
        edit_method(edit_method_),
        group(group_),
        str_member(member) {}

  /** Call a function with the member, whatever its type is. */
  template <class Function>
  void visit(const Function& function) const {
    if (int_member) function(int_member);
    if (double_member) function(double_member);
    if (bool_member) function(bool_member);
    if (str_member) function(str_member);
  }

  std::string name, type;
  uint32_t level;
  std::string description, edit_method;
  int group;
  int C::* int_member = nullptr;
  double C::* double_member = nullptr;
  bool C::* bool_member = nullptr;
  std::string C::* str_member = nullptr;
};

/** Group of parameters. */
template <class C>
struct GroupOf {
  std::string name, type;
  int parent, id;
  bool (*state)(const C& config);
  void (*set_state)(C& config, bool state);
};

namespace impl {

inline std::vector<IntParameter>& values(Config& m, int) { return m.ints; }
inline std::vector<DoubleParameter>& values(Config& m, double) { return m.doubles; }
inline std::vector<BoolParameter>& values(Config& m, bool) { return m.bools; }
inline std::vector<StrParameter>& values(Config& m, const std::string&) { return m.strs; }
inline const std::vector<IntParameter>& values(const Config& m, int) { return m.ints; }
inline const std::vector<DoubleParameter>& values(const Config& m, double) { return m.doubles; }
inline const std::vector<BoolParameter>& values(const Config& m, bool) { return m.bools; }
inline const std::vector<StrParameter>& values(const Config& m, const std::string&) { return m.strs; }
inline bool isNumber(double value) { return !std::isnan(value); }
inline bool isNumber(const std::string&) { return true; }

/** Functions that are called with a member; generic lambdas are newer than the programs. */
template <class C>
struct Put {
  const C& config;
  const std::string& name;
  Config& message;
  template <class T>
  void operator()(T C::* member) const {
    auto& list = values(message, config.*member);
    list.emplace_back();
    list.back().name = name;
    list.back().value = config.*member;
  }
};
template <class C>
struct Take {
  C& config;
  const std::string& name;
  const Config& message;
  size_t& count;
  template <class T>
  void operator()(T C::* member) const {
    for (const auto& given : values(message, config.*member)) {
      if (given.name != name) continue;
      ++count;
      if (isNumber(given.value)) config.*member = given.value;
      else ROS_ERROR("parameter %s is unchanged: its new value is no number", name.c_str());
    }
  }
};
template <class C>
struct Clamp {
  C& config;
  const C &min, &max;
  template <class T>
  void operator()(T C::* member) const {
    if (config.*member > max.*member) config.*member = max.*member;
    if (config.*member < min.*member) config.*member = min.*member;
  }
  void operator()(std::string C::*) const {}
};
template <class C>
struct IsSame {
  const C &a, &b;
  bool& is_same;
  template <class T>
  void operator()(T C::* member) const {
    is_same = a.*member == b.*member;
  }
};
template <class C>
struct FromServer {
  C& config;
  const std::string& name;
  const ros::NodeHandle& node;
  template <class T>
  void operator()(T C::* member) const {
    node.getParam(name, config.*member);
  }
};
template <class C>
struct ToServer {
  const C& config;
  const std::string& name;
  const ros::NodeHandle& node;
  template <class T>
  void operator()(T C::* member) const {
    node.setParam(name, config.*member);
  }
};

}  // namespace impl

/** Base of generated configurations: C has members, and tables of them. */
template <class C>
class ConfigBase {
 public:
  void __toMessage__(Config& message) const {
    message = Config();
    for (const Parameter<C>& parameter : C::__parameters__())
      parameter.visit(impl::Put<C>{self(), parameter.name, message});
    for (const GroupOf<C>& group : C::__groups__()) {
      GroupState state;
      state.name = group.name;
      state.id = group.id;
      state.parent = group.parent;
      state.state = group.state(self());
      message.groups.push_back(state);
    }
  }
  /** Take a message's values; false if it has others than the parameters. */
  bool __fromMessage__(const Config& message) {
    size_t count = 0;
    for (const Parameter<C>& parameter : C::__parameters__())
      parameter.visit(impl::Take<C>{self(), parameter.name, message, count});
    for (const GroupState& state : message.groups)
      for (const GroupOf<C>& group : C::__groups__())
        if (group.id == state.id && group.name == state.name) group.set_state(self(), state.state);
    return count == message.ints.size() + message.doubles.size() + message.bools.size() + message.strs.size();
  }
  void __toServer__(const ros::NodeHandle& node) const {
    for (const Parameter<C>& parameter : C::__parameters__())
      parameter.visit(impl::ToServer<C>{self(), parameter.name, node});
  }
  /** Take the values of the node's parameters. */
  void __fromServer__(const ros::NodeHandle& node) {
    for (const Parameter<C>& parameter : C::__parameters__())
      parameter.visit(impl::FromServer<C>{self(), parameter.name, node});
  }
  void __clamp__() { __clamp__(C::__getMin__(), C::__getMax__()); }
  void __clamp__(const C& min, const C& max) {
    for (const Parameter<C>& parameter : C::__parameters__()) parameter.visit(impl::Clamp<C>{self(), min, max});
  }
  /** Levels of the parameters that differ from another configuration's. */
  uint32_t __level__(const C& other) const {
    uint32_t level = 0;
    for (const Parameter<C>& parameter : C::__parameters__()) {
      bool is_same = true;
      parameter.visit(impl::IsSame<C>{self(), other, is_same});
      if (!is_same) level |= parameter.level;
    }
    return level;
  }
  static ConfigDescription __getDescriptionMessage__() {
    ConfigDescription message;
    for (const GroupOf<C>& group : C::__groups__()) {
      Group described;
      described.name = group.name;
      described.type = group.type;
      described.parent = group.parent;
      described.id = group.id;
      for (const Parameter<C>& parameter : C::__parameters__()) {
        if (parameter.group != group.id) continue;
        ParamDescription one;
        one.name = parameter.name;
        one.type = parameter.type;
        one.level = parameter.level;
        one.description = parameter.description;
        one.edit_method = parameter.edit_method;
        described.parameters.push_back(one);
      }
      message.groups.push_back(described);
    }
    C::__getMin__().__toMessage__(message.min);
    C::__getMax__().__toMessage__(message.max);
    C::__getDefault__().__toMessage__(message.dflt);
    return message;
  }

 protected:
  ConfigBase() {}

 private:
  C& self() { return static_cast<C&>(*this); }
  const C& self() const { return static_cast<const C&>(*this); }
};

}  // namespace dynamic_reconfigure
