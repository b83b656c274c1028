#pragma once

#include <string>

#include "xml_rpc.h"

namespace ros {
/** Servers of the node: XML-RPC, and TCPROS for topics and services. */
namespace server {

void start();
void stop();
/** Set the time by /clock. */
void followClock();
/** Answer an XML-RPC method; false if it has an answer. Another thread may ask for it at the same time. */
bool bind(const std::string& method, const net::XmlRpcMethod& answer);
/** Leave a method without an answer. */
void unbind(const std::string& method);

}  // namespace server
}  // namespace ros
