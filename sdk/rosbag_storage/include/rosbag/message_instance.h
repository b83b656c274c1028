#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <cstring>
#include <string>

#include "rosbag/structures.h"

namespace rosbag {

class Bag;

/** Message of a bag; its bytes are read when they are asked for. The bag must exist as long. */
class MessageInstance {
 public:
  MessageInstance(const ConnectionInfo* connection, const IndexEntry& entry, const Bag* bag)
      : connection_(connection), entry_(entry), bag_(bag) {}

  const ros::Time& getTime() const { return entry_.time; }
  const std::string& getTopic() const { return connection_->topic; }
  const std::string& getDataType() const { return connection_->datatype; }
  const std::string& getMD5Sum() const { return connection_->md5sum; }
  const std::string& getMessageDefinition() const { return connection_->msg_def; }
  boost::shared_ptr<ros::M_string> getConnectionHeader() const { return connection_->header; }
  /** Name of the node that published it; "" if the bag does not say. */
  std::string getCallerId() const;
  bool isLatching() const;
  uint32_t size() const {
    uint32_t length;
    bytes(length);
    return length;
  }

  template <class T>
  bool isType() const {
    const char* const md5sum = ros::message_traits::MD5Sum<T>::value();
    return md5sum == getMD5Sum() || std::strcmp(md5sum, "*") == 0;
  }
  /** The message; null if it is of another type. */
  template <class T>
  boost::shared_ptr<T> instantiate() const {
    if (!isType<T>()) return boost::shared_ptr<T>();
    const boost::shared_ptr<T> message = boost::make_shared<T>();
    ros::serialization::PreDeserializeParams<T> parameters;
    parameters.message = message;
    parameters.connection_header = getConnectionHeader();
    ros::serialization::PreDeserialize<T>::notify(parameters);
    uint32_t length;
    const uint8_t* const data = bytes(length);
    ros::serialization::IStream stream(const_cast<uint8_t*>(data), length);
    ros::serialization::deserialize(stream, *message);
    return message;
  }
  /** Write the serialized message. */
  template <class Stream>
  void write(Stream& stream) const {
    uint32_t length;
    const uint8_t* const data = bytes(length);
    if (length > 0) std::memcpy(stream.advance(length), data, length);
  }

 private:
  /** Serialized message, until the next is read. */
  const uint8_t* bytes(uint32_t& length) const;

  const ConnectionInfo* connection_;
  IndexEntry entry_;
  const Bag* bag_;
};

}  // namespace rosbag

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<rosbag::MessageInstance> {
  static const char* value(const rosbag::MessageInstance& m) { return m.getMD5Sum().c_str(); }
};
template <>
struct DataType<rosbag::MessageInstance> {
  static const char* value(const rosbag::MessageInstance& m) { return m.getDataType().c_str(); }
};
template <>
struct Definition<rosbag::MessageInstance> {
  static const char* value(const rosbag::MessageInstance& m) { return m.getMessageDefinition().c_str(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<rosbag::MessageInstance> {
  template <typename Stream>
  static void write(Stream& stream, const rosbag::MessageInstance& m) {
    m.write(stream);
  }
  static uint32_t serializedLength(const rosbag::MessageInstance& m) { return m.size(); }
};
}  // namespace serialization
}  // namespace ros
