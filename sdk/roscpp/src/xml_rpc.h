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

/** Method of this node, which returns a call's result; null: there is none of a name. */
typedef std::function<XmlRpc::XmlRpcValue(const XmlRpc::XmlRpcValue&)> XmlRpcMethod;
typedef std::function<XmlRpcMethod(const std::string&)> XmlRpcLookup;

/** Serve methods on a connection, one request after the other. */
std::shared_ptr<Connection> serveXmlRpc(Socket socket, const XmlRpcLookup& find);

}  // namespace net
}  // namespace ros
