#include "ros/param.h"

#include <cmath>
#include <cstdlib>
#include <mutex>
#include <set>

#include "node.h"
#include "ros/master.h"
#include "ros/names.h"
#include "ros/this_node.h"

namespace ros {
namespace param {
namespace {

using XmlRpc::XmlRpcValue;

/** Copies of parameters that the master keeps up to date. */
struct Cache {
  std::mutex mutex;
  std::map<std::string, XmlRpcValue> values;
  std::set<std::string> subscribed;
};

Cache& cache() {
  static Cache* const instance = new Cache;
  return *instance;
}

bool isNumber(const XmlRpcValue& v) {
  return v.getType() == XmlRpcValue::TypeInt || v.getType() == XmlRpcValue::TypeDouble ||
         v.getType() == XmlRpcValue::TypeBoolean;
}

double number(const XmlRpcValue& v) {
  if (v.getType() == XmlRpcValue::TypeInt) return static_cast<const int&>(v);
  if (v.getType() == XmlRpcValue::TypeBoolean) return static_cast<const bool&>(v) ? 1.0 : 0.0;
  return static_cast<const double&>(v);
}

bool isInInt(double value) { return value >= -2147483648.0 && value <= 2147483647.0; }

// Convert a parameter to a type; `in_list`: it is an element of a list, where numbers of all types are accepted.
bool convert(const XmlRpcValue& v, XmlRpcValue& out, bool) {
  out = v;
  return true;
}
bool convert(const XmlRpcValue& v, std::string& out, bool) {
  if (v.getType() != XmlRpcValue::TypeString) return false;
  out = static_cast<const std::string&>(v);
  return true;
}
bool convert(const XmlRpcValue& v, double& out, bool in_list) {
  if (!isNumber(v) || (!in_list && v.getType() == XmlRpcValue::TypeBoolean)) return false;
  out = number(v);
  return true;
}
bool convert(const XmlRpcValue& v, float& out, bool in_list) {
  double value = 0.0;
  if (!convert(v, value, in_list)) return false;
  out = static_cast<float>(value);
  return true;
}
bool convert(const XmlRpcValue& v, int& out, bool in_list) {
  if (!isNumber(v) || (!in_list && v.getType() == XmlRpcValue::TypeBoolean)) return false;
  const double value = std::floor(number(v) + 0.5);
  if (!isInInt(value)) return false;
  out = static_cast<int>(value);
  return true;
}
bool convert(const XmlRpcValue& v, bool& out, bool in_list) {
  if (!isNumber(v) || (!in_list && v.getType() != XmlRpcValue::TypeBoolean)) return false;
  out = number(v) != 0.0;
  return true;
}
template <typename T>
bool convert(const XmlRpcValue& v, std::vector<T>& out, bool) {
  if (v.getType() != XmlRpcValue::TypeArray) return false;
  std::vector<T> values(static_cast<size_t>(v.size()));
  for (int i = 0; i < v.size(); ++i) {
    T element;
    if (!convert(v[i], element, true)) return false;
    values[static_cast<size_t>(i)] = element;
  }
  out = values;
  return true;
}
template <typename T>
bool convert(const XmlRpcValue& v, std::map<std::string, T>& out, bool) {
  if (v.getType() != XmlRpcValue::TypeStruct) return false;
  std::map<std::string, T> values;
  for (const auto& member : v)
    if (!convert(member.second, values[member.first], true)) return false;
  out = values;
  return true;
}

bool read(const std::string& key, XmlRpcValue& value, bool cached) {
  const std::string name = names::resolve(key);
  Cache& c = cache();
  XmlRpcValue arguments, payload;
  arguments[0] = name;
  if (cached) {
    std::unique_lock<std::mutex> lock(c.mutex);
    const auto found = c.values.find(name);
    if (found != c.values.end()) {
      value = found->second;
      return value.valid();
    }
    const bool is_new = c.subscribed.insert(name).second;
    lock.unlock();
    if (is_new) {
      XmlRpcValue subscription, now;
      subscription[0] = node::uri();
      subscription[1] = name;
      if (node::callMaster("subscribeParam", subscription, now)) {
        lock.lock();
        // The master answers with an empty struct if the parameter is not set.
        const bool is_set = !(now.getType() == XmlRpcValue::TypeStruct && now.size() == 0);
        c.values.emplace(name, is_set ? now : XmlRpcValue());
        value = c.values[name];
        return value.valid();
      }
      lock.lock();
      c.subscribed.erase(name);
      lock.unlock();
    }
  }
  if (!node::callMaster("getParam", arguments, payload)) return false;
  value = payload;
  return true;
}

template <typename T>
bool readAs(const std::string& key, T& value, bool cached) {
  XmlRpcValue v;
  return read(key, v, cached) && convert(v, value, false);
}

template <typename T>
XmlRpcValue fromList(const std::vector<T>& list) {
  XmlRpcValue value;
  value.setSize(static_cast<int>(list.size()));
  for (size_t i = 0; i < list.size(); ++i) value[static_cast<int>(i)] = XmlRpcValue(static_cast<T>(list[i]));
  return value;
}
template <typename T>
XmlRpcValue fromMap(const std::map<std::string, T>& map) {
  XmlRpcValue value;
  int offset = 0;
  value.fromXml("<value><struct></struct></value>", &offset);
  for (const auto& entry : map) value[entry.first] = XmlRpcValue(static_cast<T>(entry.second));
  return value;
}

}  // namespace

void set(const std::string& key, const XmlRpcValue& value) {
  const std::string name = names::resolve(key);
  XmlRpcValue arguments, payload;
  arguments[0] = name;
  arguments[1] = value;
  if (node::callMaster("setParam", arguments, payload)) update(name, value);
}

void set(const std::string& key, const std::string& value) { set(key, XmlRpcValue(value)); }
void set(const std::string& key, const char* value) { set(key, XmlRpcValue(value)); }
void set(const std::string& key, double value) { set(key, XmlRpcValue(value)); }
void set(const std::string& key, int value) { set(key, XmlRpcValue(value)); }
void set(const std::string& key, bool value) { set(key, XmlRpcValue(value)); }
void set(const std::string& key, const std::vector<std::string>& value) { set(key, fromList(value)); }
void set(const std::string& key, const std::vector<double>& value) { set(key, fromList(value)); }
void set(const std::string& key, const std::vector<float>& value) {
  set(key, fromList(std::vector<double>(value.begin(), value.end())));
}
void set(const std::string& key, const std::vector<int>& value) { set(key, fromList(value)); }
void set(const std::string& key, const std::vector<bool>& value) { set(key, fromList(value)); }
void set(const std::string& key, const std::map<std::string, std::string>& value) { set(key, fromMap(value)); }
void set(const std::string& key, const std::map<std::string, double>& value) { set(key, fromMap(value)); }
void set(const std::string& key, const std::map<std::string, float>& value) {
  set(key, fromMap(std::map<std::string, double>(value.begin(), value.end())));
}
void set(const std::string& key, const std::map<std::string, int>& value) { set(key, fromMap(value)); }
void set(const std::string& key, const std::map<std::string, bool>& value) { set(key, fromMap(value)); }

bool get(const std::string& key, std::string& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::string& value) { return readAs(key, value, true); }
bool get(const std::string& key, double& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, double& value) { return readAs(key, value, true); }
bool get(const std::string& key, float& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, float& value) { return readAs(key, value, true); }
bool get(const std::string& key, int& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, int& value) { return readAs(key, value, true); }
bool get(const std::string& key, bool& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, bool& value) { return readAs(key, value, true); }
bool get(const std::string& key, XmlRpcValue& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, XmlRpcValue& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::vector<std::string>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::vector<std::string>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::vector<double>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::vector<double>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::vector<float>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::vector<float>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::vector<int>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::vector<int>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::vector<bool>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::vector<bool>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::map<std::string, std::string>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::map<std::string, std::string>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::map<std::string, double>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::map<std::string, double>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::map<std::string, float>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::map<std::string, float>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::map<std::string, int>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::map<std::string, int>& value) { return readAs(key, value, true); }
bool get(const std::string& key, std::map<std::string, bool>& value) { return readAs(key, value, false); }
bool getCached(const std::string& key, std::map<std::string, bool>& value) { return readAs(key, value, true); }

bool has(const std::string& key) {
  XmlRpcValue arguments, payload;
  arguments[0] = names::resolve(key);
  return node::callMaster("hasParam", arguments, payload) && payload.getType() == XmlRpcValue::TypeBoolean &&
         static_cast<bool>(payload);
}

bool del(const std::string& key) {
  const std::string name = names::resolve(key);
  XmlRpcValue arguments, payload;
  arguments[0] = name;
  update(name, XmlRpcValue());
  return node::callMaster("deleteParam", arguments, payload);
}

bool search(const std::string& key, std::string& result) { return search(this_node::getName(), key, result); }

bool search(const std::string& ns, const std::string& key, std::string& result) {
  // The master searches for a relative name, which only remappings of unresolved names can match.
  const auto remapped = names::getUnresolvedRemappings().find(key);
  XmlRpcValue request, response, payload;
  request[0] = ns;
  request[1] = remapped == names::getUnresolvedRemappings().end() ? key : remapped->second;
  if (!master::execute("searchParam", request, response, payload, false)) return false;
  if (payload.getType() != XmlRpcValue::TypeString) return false;
  result = static_cast<std::string&>(payload);
  return !result.empty();
}

bool getParamNames(std::vector<std::string>& keys) {
  XmlRpcValue arguments, payload;
  arguments.setSize(0);
  return node::callMaster("getParamNames", arguments, payload) && convert(payload, keys, false);
}

void unsubscribeCachedParam(const std::string& key) {
  const std::string name = names::resolve(key);
  {
    const std::lock_guard<std::mutex> lock(cache().mutex);
    cache().values.erase(name);
    if (cache().subscribed.erase(name) == 0) return;
  }
  XmlRpcValue arguments, payload;
  arguments[0] = node::uri();
  arguments[1] = name;
  node::callMaster("unsubscribeParam", arguments, payload, false);
}

void update(const std::string& key, const XmlRpcValue& value) {
  const std::string name = names::clean(key);
  Cache& c = cache();
  const std::lock_guard<std::mutex> lock(c.mutex);
  for (auto entry = c.values.begin(); entry != c.values.end();) {
    // Copies of a struct that contains the key, and of members of the key, are dropped and requested again.
    const bool is_above = name.compare(0, entry->first.size() + 1, entry->first + "/") == 0;
    const bool is_below = entry->first.compare(0, name.size() + 1, name + "/") == 0;
    if (is_above || is_below) {
      c.subscribed.erase(entry->first);
      entry = c.values.erase(entry);
    } else {
      ++entry;
    }
  }
  if (c.subscribed.count(name)) c.values[name] = value;
}

void init(const M_string& remappings) {
  for (const auto& entry : remappings) {
    const std::string& name = entry.first;
    if (name.size() < 2 || name[0] != '_' || name[1] == '_') continue;
    const std::string key = names::resolve("~" + name.substr(1));
    const std::string& text = entry.second;
    char* end = nullptr;
    const long long whole = std::strtoll(text.c_str(), &end, 10);
    if (!text.empty() && !*end && whole >= -2147483648LL && whole <= 2147483647LL) {
      set(key, static_cast<int>(whole));
      continue;
    }
    const double real = std::strtod(text.c_str(), &end);
    if (!text.empty() && !*end) set(key, real);
    else if (text == "true" || text == "True" || text == "TRUE") set(key, true);
    else if (text == "false" || text == "False" || text == "FALSE") set(key, false);
    else set(key, text);
  }
}

}  // namespace param
}  // namespace ros
