#pragma once

#include <ros/exception.h>

#include <string>

namespace rosbag {

/** Base of the exceptions of bags. */
class BagException : public ros::Exception {
 public:
  explicit BagException(const std::string& message) : ros::Exception(message) {}
};
/** The file cannot be read or written. */
class BagIOException : public BagException {
 public:
  explicit BagIOException(const std::string& message) : BagException(message) {}
};
/** The file is not a bag, or is damaged. */
class BagFormatException : public BagException {
 public:
  explicit BagFormatException(const std::string& message) : BagException(message) {}
};
/** The bag was not closed: `rosbag reindex` writes its index. */
class BagUnindexedException : public BagException {
 public:
  BagUnindexedException()
      : BagException("the bag has no index, as its recording was killed; rosbag reindex makes one") {}
};

}  // namespace rosbag
