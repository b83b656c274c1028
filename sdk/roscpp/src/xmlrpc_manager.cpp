#include "ros/xmlrpc_manager.h"

#include "node.h"
#include "ros/console.h"
#include "ros/init.h"
#include "ros/network.h"
#include "server.h"

namespace ros {
namespace xmlrpc {

using XmlRpc::XmlRpcValue;

template <class T>
static XmlRpcValue response(int code, const std::string& msg, const T& value) {
  XmlRpcValue answer;
  answer[0] = code;
  answer[1] = msg;
  answer[2] = value;
  return answer;
}

XmlRpcValue responseStr(int code, const std::string& msg, const std::string& value) {
  return response(code, msg, value);
}
XmlRpcValue responseInt(int code, const std::string& msg, int value) { return response(code, msg, value); }
XmlRpcValue responseBool(int code, const std::string& msg, bool value) { return response(code, msg, value); }

}  // namespace xmlrpc

const XMLRPCManagerPtr& XMLRPCManager::instance() {
  static const XMLRPCManagerPtr* const manager = new XMLRPCManagerPtr(new XMLRPCManager);
  return *manager;
}

bool XMLRPCManager::bind(const std::string& function_name, const XMLRPCFunc& cb) {
  return server::bind(function_name, [cb](const XmlRpc::XmlRpcValue& parameters) {
    XmlRpc::XmlRpcValue given = parameters, result;
    cb(given, result);
    return result;
  });
}

void XMLRPCManager::unbind(const std::string& function_name) { server::unbind(function_name); }
const std::string& XMLRPCManager::getServerURI() const { return node::uri(); }
uint32_t XMLRPCManager::getServerPort() const {
  std::string host;
  uint32_t port = 0;
  network::splitURI(node::uri(), host, port);
  return port;
}
bool XMLRPCManager::isShuttingDown() const { return ros::isShuttingDown(); }

bool XMLRPCManager::validateXmlrpcResponse(const std::string& method, XmlRpc::XmlRpcValue& response,
                                           XmlRpc::XmlRpcValue& payload) {
  using XmlRpc::XmlRpcValue;
  if (response.getType() != XmlRpcValue::TypeArray || response.size() < 2 ||
      response[0].getType() != XmlRpcValue::TypeInt || response[1].getType() != XmlRpcValue::TypeString) {
    ROS_DEBUG("XML-RPC call [%s] didn't return an array of a code, a text and a value", method.c_str());
    return false;
  }
  const int code = response[0];
  if (code != 1) {
    ROS_DEBUG("XML-RPC call [%s] returned code %d: %s", method.c_str(), code,
              static_cast<std::string>(response[1]).c_str());
    return false;
  }
  payload = response.size() > 2 ? response[2] : XmlRpcValue();
  return true;
}

}  // namespace ros
