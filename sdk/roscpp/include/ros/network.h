#pragma once

#include "ros/common.h"

namespace ros {
namespace network {

bool splitURI(const std::string& uri, std::string& host, uint32_t& port);
/** Host name or address in this node's URIs. */
const std::string& getHost();
uint16_t getTCPROSPort();

}  // namespace network
}  // namespace ros
