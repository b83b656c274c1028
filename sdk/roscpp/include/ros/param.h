#pragma once

#include <map>
#include <string>
#include <vector>

#include "ros/forwards.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
/** Parameters of the master. Names are resolved; `get` is false if the parameter is not set or has another type. */
namespace param {

void set(const std::string& key, const XmlRpc::XmlRpcValue& value);
void set(const std::string& key, const std::string& value);
void set(const std::string& key, const char* value);
void set(const std::string& key, double value);
void set(const std::string& key, int value);
void set(const std::string& key, bool value);
void set(const std::string& key, const std::vector<std::string>& value);
void set(const std::string& key, const std::vector<double>& value);
void set(const std::string& key, const std::vector<float>& value);
void set(const std::string& key, const std::vector<int>& value);
void set(const std::string& key, const std::vector<bool>& value);
void set(const std::string& key, const std::map<std::string, std::string>& value);
void set(const std::string& key, const std::map<std::string, double>& value);
void set(const std::string& key, const std::map<std::string, float>& value);
void set(const std::string& key, const std::map<std::string, int>& value);
void set(const std::string& key, const std::map<std::string, bool>& value);
bool get(const std::string& key, std::string& value);
bool get(const std::string& key, double& value);
bool get(const std::string& key, float& value);
bool get(const std::string& key, int& value);
bool get(const std::string& key, bool& value);
bool get(const std::string& key, XmlRpc::XmlRpcValue& value);
bool get(const std::string& key, std::vector<std::string>& value);
bool get(const std::string& key, std::vector<double>& value);
bool get(const std::string& key, std::vector<float>& value);
bool get(const std::string& key, std::vector<int>& value);
bool get(const std::string& key, std::vector<bool>& value);
bool get(const std::string& key, std::map<std::string, std::string>& value);
bool get(const std::string& key, std::map<std::string, double>& value);
bool get(const std::string& key, std::map<std::string, float>& value);
bool get(const std::string& key, std::map<std::string, int>& value);
bool get(const std::string& key, std::map<std::string, bool>& value);
/** As get(), but from a local copy, which the master keeps up to date. */
bool getCached(const std::string& key, std::string& value);
bool getCached(const std::string& key, double& value);
bool getCached(const std::string& key, float& value);
bool getCached(const std::string& key, int& value);
bool getCached(const std::string& key, bool& value);
bool getCached(const std::string& key, XmlRpc::XmlRpcValue& value);
bool getCached(const std::string& key, std::vector<std::string>& value);
bool getCached(const std::string& key, std::vector<double>& value);
bool getCached(const std::string& key, std::vector<float>& value);
bool getCached(const std::string& key, std::vector<int>& value);
bool getCached(const std::string& key, std::vector<bool>& value);
bool getCached(const std::string& key, std::map<std::string, std::string>& value);
bool getCached(const std::string& key, std::map<std::string, double>& value);
bool getCached(const std::string& key, std::map<std::string, float>& value);
bool getCached(const std::string& key, std::map<std::string, int>& value);
bool getCached(const std::string& key, std::map<std::string, bool>& value);
bool has(const std::string& key);
bool del(const std::string& key);
/** Find a parameter in a namespace or its ancestors. */
bool search(const std::string& ns, const std::string& key, std::string& result);
bool search(const std::string& key, std::string& result);
bool getParamNames(std::vector<std::string>& keys);
void unsubscribeCachedParam(const std::string& key);

template <typename T>
bool param(const std::string& name, T& value, const T& default_value) {
  if (has(name) && get(name, value)) return true;
  value = default_value;
  return false;
}
template <typename T>
T param(const std::string& name, const T& default_value) {
  T value;
  param(name, value, default_value);
  return value;
}

}  // namespace param
}  // namespace ros
