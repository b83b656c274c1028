#pragma once

#include <ros/exception.h>
#include <ros/message_traits.h>
#include <ros/ros.h>
#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <cstring>
#include <string>
#include <vector>

namespace topic_tools {

class ShapeShifterException : public ros::Exception {
 public:
  explicit ShapeShifterException(const std::string& message) : ros::Exception(message) {}
};

/** Message of any type, which is known once it has arrived. */
class ShapeShifter {
 public:
  typedef boost::shared_ptr<ShapeShifter> Ptr;
  typedef boost::shared_ptr<const ShapeShifter> ConstPtr;

  const std::string& getDataType() const { return datatype_; }
  const std::string& getMD5Sum() const { return md5sum_; }
  const std::string& getMessageDefinition() const { return definition_; }
  bool isLatching() const { return is_latching_; }

  /** Take a type; messages are read as of this type from then on. */
  void morph(const std::string& md5sum, const std::string& datatype, const std::string& msg_def,
             const std::string& latching) {
    md5sum_ = md5sum;
    datatype_ = datatype;
    definition_ = msg_def;
    is_latching_ = latching == "1";
  }
  /** Advertise a topic of the present type. */
  ros::Publisher advertise(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size, bool latch = false,
                           const ros::SubscriberStatusCallback& connect_cb = ros::SubscriberStatusCallback()) const {
    ros::AdvertiseOptions options(topic, queue_size, md5sum_, datatype_, definition_, connect_cb);
    options.latch = latch;
    return nh.advertise(options);
  }
  /** The message as one of type M; throws ShapeShifterException if it is of another. */
  template <class M>
  boost::shared_ptr<M> instantiate() const {
    if (md5sum_.empty()) throw ShapeShifterException("the message has no type yet: read or morph it first");
    if (datatype_ != ros::message_traits::datatype<M>() || md5sum_ != ros::message_traits::md5sum<M>())
      throw ShapeShifterException("the message is a " + datatype_ + ", not a " + ros::message_traits::datatype<M>());
    const boost::shared_ptr<M> message = boost::make_shared<M>();
    ros::serialization::IStream stream(const_cast<uint8_t*>(bytes_.data()), size());
    ros::serialization::deserialize(stream, *message);
    return message;
  }
  template <typename Stream>
  void write(Stream& stream) const {
    if (!bytes_.empty()) std::memcpy(stream.advance(size()), bytes_.data(), bytes_.size());
  }
  template <typename Stream>
  void read(Stream& stream) {
    const uint32_t length = stream.getLength();
    const uint8_t* const first = stream.advance(length);
    bytes_.assign(first, first + length);
  }
  uint32_t size() const { return static_cast<uint32_t>(bytes_.size()); }

 private:
  std::string md5sum_, datatype_, definition_;
  bool is_latching_ = false;
  std::vector<uint8_t> bytes_;
};

}  // namespace topic_tools

namespace ros {
namespace message_traits {
template <>
struct IsMessage<topic_tools::ShapeShifter> : TrueType {};
template <>
struct MD5Sum<topic_tools::ShapeShifter> {
  static const char* value(const topic_tools::ShapeShifter& m) { return m.getMD5Sum().c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct DataType<topic_tools::ShapeShifter> {
  static const char* value(const topic_tools::ShapeShifter& m) { return m.getDataType().c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct Definition<topic_tools::ShapeShifter> {
  static const char* value(const topic_tools::ShapeShifter& m) { return m.getMessageDefinition().c_str(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<topic_tools::ShapeShifter> {
  template <typename Stream>
  static void write(Stream& stream, const topic_tools::ShapeShifter& m) {
    m.write(stream);
  }
  template <typename Stream>
  static void read(Stream& stream, topic_tools::ShapeShifter& m) {
    m.read(stream);
  }
  static uint32_t serializedLength(const topic_tools::ShapeShifter& m) { return m.size(); }
};
/** Takes the type from the connection's header. */
template <>
struct PreDeserialize<topic_tools::ShapeShifter> {
  static void notify(const PreDeserializeParams<topic_tools::ShapeShifter>& params) {
    std::map<std::string, std::string>& header = *params.connection_header;
    params.message->morph(header["md5sum"], header["type"], header["message_definition"], header["latching"]);
  }
};
}  // namespace serialization
}  // namespace ros
