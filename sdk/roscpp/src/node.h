#pragma once

#include <functional>
#include <string>
#include <thread>

#include "ros/datatypes.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {

/** Functions that the parts of a node call of each other; an internal interface of the kit. */
namespace node {

/** Address of this node's XML-RPC server. */
const std::string& uri();
/** Run a function in a thread, which shutdown() waits for. */
void runInThread(std::function<void()> function);
/** Wait [ms] in a thread of runInThread(); false once the node shuts down. */
bool waitMs(int duration);
/** Call the master with this node's name; false if the call fails, or the master reports an error. */
bool callMaster(const std::string& method, const XmlRpc::XmlRpcValue& arguments, XmlRpc::XmlRpcValue& payload,
                bool waits = true);

}  // namespace node

namespace names {
void init(const M_string& remappings);
}
namespace this_node {
void init(const std::string& name, const M_string& remappings, uint32_t options);
}
namespace network {
void init(const M_string& remappings);
void setTCPROSPort(uint16_t port);
}  // namespace network
namespace master {
void init(const M_string& remappings);
}
namespace param {
void init(const M_string& remappings);
/** A subscribed parameter has changed. */
void update(const std::string& key, const XmlRpc::XmlRpcValue& value);
}  // namespace param
namespace rosout {
void start();
void stop();
void serveLoggers();
}  // namespace rosout
namespace timers {
void stop();
}

}  // namespace ros
