#pragma once

namespace ros {
/** Servers of the node: XML-RPC, and TCPROS for topics and services. */
namespace server {

void start();
void stop();
/** Set the time by /clock. */
void followClock();

}  // namespace server
}  // namespace ros
