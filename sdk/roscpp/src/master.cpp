#include "ros/master.h"

#include <atomic>
#include <cstdlib>
#include <set>

#include "node.h"
#include "ros/init.h"
#include "ros/network.h"
#include "ros/this_node.h"
#include "xml_rpc.h"

namespace ros {

const std::string& getDefaultMasterURI() {
  static const std::string uri = "http://localhost:11311";
  return uri;
}

namespace master {
namespace {

std::string uri, host;
uint32_t port = 0;
WallDuration retry_timeout;

}  // namespace

void init(const M_string& remappings) {
  const auto remapped = remappings.find("__master");
  const char* const variable = std::getenv("ROS_MASTER_URI");
  uri = remapped != remappings.end() ? remapped->second : variable && *variable ? variable : getDefaultMasterURI();
  if (!network::splitURI(uri, host, port)) {
    ROS_FATAL("Couldn't parse the master URI [%s] into a host:port pair.", uri.c_str());
    ROS_BREAK();
  }
}

const std::string& getHost() { return host; }
uint32_t getPort() { return port; }
const std::string& getURI() { return uri; }
void setRetryTimeout(WallDuration timeout) { retry_timeout = timeout; }

bool check() {
  XmlRpc::XmlRpcValue args, result, payload;
  args[0] = this_node::getName();
  return execute("getPid", args, result, payload, false);
}

bool execute(const std::string& method, const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& response,
             XmlRpc::XmlRpcValue& payload, bool wait_for_master) {
  const SteadyTime start = SteadyTime::now();
  bool is_reported = false;
  if (isShuttingDown() && !isStarted()) net::abortWaiting(1000);  // one call, also after the node's end
  while (true) {
    try {
      response = net::callXmlRpc(host, static_cast<uint16_t>(port), method, request);
      if (is_reported && ok()) ROS_INFO("Connected to master at [%s:%d]", host.c_str(), static_cast<int>(port));
      break;
    } catch (const net::NetError& error) {
      if (isShuttingDown() || !wait_for_master) return false;
      if (!is_reported)
        ROS_ERROR("[%s] Failed to contact master at [%s:%d].  Retrying...", method.c_str(), host.c_str(),
                  static_cast<int>(port));
      is_reported = true;
      if (!retry_timeout.isZero() && SteadyTime::now() - start >= retry_timeout) {
        ROS_ERROR("[%s] Timed out trying to connect to the master after [%f] seconds", method.c_str(),
                  retry_timeout.toSec());
        return false;
      }
      if (!node::waitMs(100)) return false;
    }
  }
  if (response.getType() != XmlRpc::XmlRpcValue::TypeArray || response.size() < 2 ||
      response[0].getType() != XmlRpc::XmlRpcValue::TypeInt)
    return false;
  if (response.size() > 2) payload = XmlRpc::XmlRpcValue(response[2]);
  return static_cast<int>(response[0]) == 1;
}

bool getTopics(V_TopicInfo& topics) {
  XmlRpc::XmlRpcValue args, payload;
  args[0] = std::string("");
  if (!node::callMaster("getPublishedTopics", args, payload)) return false;
  topics.clear();
  for (int i = 0; i < payload.size(); ++i) topics.emplace_back(payload[i][0], payload[i][1]);
  return true;
}

bool getNodes(V_string& nodes) {
  XmlRpc::XmlRpcValue args, payload;
  args.setSize(0);
  if (!node::callMaster("getSystemState", args, payload)) return false;
  std::set<std::string> found;
  for (int kind = 0; kind < payload.size(); ++kind)
    for (int i = 0; i < payload[kind].size(); ++i)
      for (int k = 0; k < payload[kind][i][1].size(); ++k) found.insert(payload[kind][i][1][k]);
  nodes.assign(found.begin(), found.end());
  return true;
}

}  // namespace master

namespace node {

bool callMaster(const std::string& method, const XmlRpc::XmlRpcValue& arguments, XmlRpc::XmlRpcValue& payload,
                bool waits) {
  XmlRpc::XmlRpcValue request, response;
  request[0] = this_node::getName();
  for (int i = 0; i < arguments.size(); ++i) request[i + 1] = arguments[i];
  return master::execute(method, request, response, payload, waits);
}

}  // namespace node
}  // namespace ros
