#pragma once

#include <boost/shared_ptr.hpp>
#include <cstdint>

#include "ros/connection.h"

namespace ros {

class ConnectionManager;
typedef boost::shared_ptr<ConnectionManager> ConnectionManagerPtr;

/** Connections of topics to other nodes. */
class ConnectionManager {
 public:
  static const ConnectionManagerPtr& instance();

  /** End all connections. */
  void clear(Connection::DropReason reason);
  uint16_t getTCPPort() const;
};

}  // namespace ros
