#pragma once

namespace ros {

/** Connection of roscpp to another node. */
class Connection {
 public:
  /** Why a connection ends; after TransportDisconnect a subscriber connects again. */
  enum DropReason { TransportDisconnect, HeaderError, Destructing };
};

}  // namespace ros
