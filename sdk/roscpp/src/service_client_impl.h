#pragma once

#include <mutex>

#include "ros/service_client.h"
#include "socket.h"

namespace ros {

struct ServiceClient::Impl {
  std::string name, md5sum;
  M_string header;
  bool is_persistent = false;
  std::mutex mutex;
  net::Socket socket;
  bool was_connected = false, is_shut_down = false;
};

}  // namespace ros
