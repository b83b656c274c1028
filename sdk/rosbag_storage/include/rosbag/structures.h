#pragma once

#include <ros/datatypes.h>
#include <ros/time.h>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <string>

namespace rosbag {

/** Connection: a topic of one type, as one publisher described it. */
struct ConnectionInfo {
  ConnectionInfo() : id(0) {}
  uint32_t id;
  std::string topic, datatype, md5sum, msg_def;
  boost::shared_ptr<ros::M_string> header;
};

/** Place of a message in a bag. */
struct IndexEntry {
  ros::Time time;
  uint64_t chunk_pos;
  /** Offset in the chunk's uncompressed bytes. */
  uint32_t offset;
  bool operator<(const IndexEntry& other) const { return time < other.time; }
};

}  // namespace rosbag
