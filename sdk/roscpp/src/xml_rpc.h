#pragma once

#include <functional>
#include <map>
#include <string>

#include "loop.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
namespace net {

/** Call a method of a server, and wait for the answer; throws NetError. */
XmlRpc::XmlRpcValue callXmlRpc(const std::string& host, uint16_t port, const std::string& method,
                               const XmlRpc::XmlRpcValue& parameters);

/** Methods of this node by name; each returns the call's result. */
typedef std::map<std::string, std::function<XmlRpc::XmlRpcValue(const XmlRpc::XmlRpcValue&)>> XmlRpcMethods;

/** Serve methods on a connection, one request after the other. */
std::shared_ptr<Connection> serveXmlRpc(Socket socket, const XmlRpcMethods& methods);

}  // namespace net
}  // namespace ros
