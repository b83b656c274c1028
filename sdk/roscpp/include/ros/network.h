#pragma once

#include "ros/common.h"

namespace ros {
namespace network {

bool splitURI(const std::string& uri, std::string& host, uint32_t& port);
/** Host that this node's addresses name. */
const std::string& getHost();
uint16_t getTCPROSPort();

}  // namespace network
}  // namespace ros
