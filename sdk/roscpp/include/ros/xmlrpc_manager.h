#pragma once

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <string>

#include "ros/common.h"
#include "xmlrpcpp/XmlRpc.h"

namespace ros {

/** Answers of methods: a code (1: success), a text and a value. */
namespace xmlrpc {
XmlRpc::XmlRpcValue responseStr(int code, const std::string& msg, const std::string& response);
XmlRpc::XmlRpcValue responseInt(int code, const std::string& msg, int response);
XmlRpc::XmlRpcValue responseBool(int code, const std::string& msg, bool response);
}  // namespace xmlrpc

typedef boost::function<void(XmlRpc::XmlRpcValue& params, XmlRpc::XmlRpcValue& result)> XMLRPCFunc;

class XMLRPCManager;
typedef boost::shared_ptr<XMLRPCManager> XMLRPCManagerPtr;

/** Methods of this node's slave API, such as shutdown, which a program may replace. */
class ROSCPP_DECL XMLRPCManager {
 public:
  static const XMLRPCManagerPtr& instance();

  /** Answer a method by a function, which runs in the thread of the node's sockets; false if it is bound already. */
  bool bind(const std::string& function_name, const XMLRPCFunc& cb);
  /** Answer a method no longer; one of the node itself can be bound then. */
  void unbind(const std::string& function_name);
  const std::string& getServerURI() const;
  uint32_t getServerPort() const;
  /** Whether an answer is one of success; `payload` is its value. */
  bool validateXmlrpcResponse(const std::string& method, XmlRpc::XmlRpcValue& response, XmlRpc::XmlRpcValue& payload);
  bool isShuttingDown() const;

 private:
  XMLRPCManager() {}
};

}  // namespace ros
