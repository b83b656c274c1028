#pragma once

#include <functional>
#include <string>

#include "loop.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
namespace net {

/** Call a method of a server, and wait for the answer; throws NetError. */
XmlRpc::XmlRpcValue callXmlRpc(const std::string& host, uint16_t port, const std::string& method,
                               const XmlRpc::XmlRpcValue& parameters);

/** Method of this node: returns the call's result. */
typedef std::function<XmlRpc::XmlRpcValue(const XmlRpc::XmlRpcValue&)> XmlRpcMethod;
/** Finds a method by its name; an empty function if there is none. */
typedef std::function<XmlRpcMethod(const std::string&)> XmlRpcMethods;

/** Serve methods on a connection, one request after the other. */
std::shared_ptr<Connection> serveXmlRpc(Socket socket, const XmlRpcMethods& methods);

}  // namespace net
}  // namespace ros
