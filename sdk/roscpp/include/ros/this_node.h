#pragma once

#include "ros/common.h"

namespace ros {
namespace this_node {

const std::string& getName();
const std::string& getNamespace();
void getAdvertisedTopics(V_string& topics);
void getSubscribedTopics(V_string& topics);

}  // namespace this_node
}  // namespace ros
