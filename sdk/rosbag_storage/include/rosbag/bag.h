#pragma once

#include <ros/console.h>
#include <ros/header.h>
#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <boost/format.hpp>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <queue>
#include <set>
#include <string>

#include "rosbag/constants.h"
#include "rosbag/exceptions.h"
#include "rosbag/stream.h"
#include "rosbag/structures.h"

namespace rosbag {
namespace bagmode {
/** Use of a bag's file; Append continues one, or creates it. */
enum BagMode { Write = 1, Read = 2, Append = 4 };
}  // namespace bagmode
typedef bagmode::BagMode BagMode;

class MessageInstance;
class View;

/** Bag of messages in format 2.0. */
class Bag {
 public:
  Bag();
  /** Throws BagIOException, BagFormatException or BagUnindexedException. */
  explicit Bag(const std::string& filename, uint32_t mode = bagmode::Read);
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;
  Bag(Bag&& other);
  Bag& operator=(Bag&& other);
  ~Bag();

  void open(const std::string& filename, uint32_t mode = bagmode::Read);
  /** Write what is left and the index. */
  void close();
  bool isOpen() const;
  std::string getFileName() const;
  BagMode getMode() const;
  uint32_t getMajorVersion() const { return 2; }
  uint32_t getMinorVersion() const { return 0; }
  /** Size of the file [bytes]. */
  uint64_t getSize() const;
  void setCompression(CompressionType compression);
  CompressionType getCompression() const;
  /** Size of messages [bytes] at which a chunk is written. */
  void setChunkThreshold(uint32_t chunk_threshold);
  uint32_t getChunkThreshold() const;
  void swap(Bag& other);

  template <class T>
  void write(const std::string& topic, const ros::MessageEvent<T>& event) {
    write(topic, event.getReceiptTime(), *event.getConstMessage(), event.getConnectionHeaderPtr());
  }
  template <class T>
  void write(const std::string& topic, const ros::Time& time, const boost::shared_ptr<T>& message,
             boost::shared_ptr<ros::M_string> connection_header = boost::shared_ptr<ros::M_string>()) {
    write(topic, time, *message, connection_header);
  }
  /** Write a message; `connection_header` describes its publisher. Throws BagException if the bag is read. */
  template <class T>
  void write(const std::string& topic, const ros::Time& time, const T& message,
             boost::shared_ptr<ros::M_string> connection_header = boost::shared_ptr<ros::M_string>()) {
    const Connection connection{topic, ros::message_traits::datatype(message), ros::message_traits::md5sum(message),
                                ros::message_traits::definition(message), connection_header};
    const uint32_t size = ros::serialization::serializationLength(message);
    ros::serialization::OStream stream(reserve(connection, time, size), size);
    ros::serialization::serialize(stream, message);
    finish();
  }

 private:
  friend class MessageInstance;
  friend class View;
  struct Impl;
  struct Connection {
    std::string topic, datatype, md5sum, definition;
    boost::shared_ptr<ros::M_string> header;
  };
  /** Begin a message, and return where its bytes go. */
  uint8_t* reserve(const Connection& connection, const ros::Time& time, uint32_t size);
  /** End it: write the chunk if it is long enough. */
  void finish();

  std::unique_ptr<Impl> impl_;
};

inline void swap(Bag& a, Bag& b) { a.swap(b); }

}  // namespace rosbag
