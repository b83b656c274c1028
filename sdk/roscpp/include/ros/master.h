#pragma once

#include "ros/forwards.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
namespace master {

/** Call the master; with `wait_for_master`, wait until it can be reached. False if it reports an error. */
bool execute(const std::string& method, const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& response,
             XmlRpc::XmlRpcValue& payload, bool wait_for_master);
const std::string& getHost();
uint32_t getPort();
const std::string& getURI();
/** True if the master answers. */
bool check();

struct TopicInfo {
  TopicInfo() {}
  TopicInfo(const std::string& name_, const std::string& datatype_) : name(name_), datatype(datatype_) {}
  std::string name, datatype;
};
typedef std::vector<TopicInfo> V_TopicInfo;
bool getTopics(V_TopicInfo& topics);
bool getNodes(V_string& nodes);
void setRetryTimeout(ros::WallDuration timeout);

}  // namespace master
}  // namespace ros
