#pragma once

#include <string>

#include "xml_rpc.h"

namespace ros {
/** Servers of the node: XML-RPC, and TCPROS for topics and services. */
namespace server {

/** Answer a method of the slave API by a function; false if the name is bound already. */
bool bind(const std::string& name, const net::XmlRpcMethod& method);
/** Leave a method without an answer. */
void unbind(const std::string& name);
void start();
void stop();
/** Set the time by /clock. */
void followClock();

}  // namespace server
}  // namespace ros
