#pragma once

#include <boost/type_traits/integral_constant.hpp>
#include <boost/type_traits/remove_const.hpp>
#include <boost/type_traits/remove_reference.hpp>
#include <string>

#include "ros/message_forward.h"
#include "ros/time.h"

namespace std_msgs {
ROS_DECLARE_MESSAGE(Header)
}

#define ROS_IMPLEMENT_SIMPLE_TOPIC_TRAITS(msg, md5sum, datatype, definition) \
  namespace ros {                                                            \
  namespace message_traits {                                                 \
  template <>                                                                \
  struct MD5Sum<msg> {                                                       \
    static const char* value() { return md5sum; }                            \
    static const char* value(const msg&) { return value(); }                 \
  };                                                                         \
  template <>                                                                \
  struct DataType<msg> {                                                     \
    static const char* value() { return datatype; }                          \
    static const char* value(const msg&) { return value(); }                 \
  };                                                                         \
  template <>                                                                \
  struct Definition<msg> {                                                   \
    static const char* value() { return definition; }                        \
    static const char* value(const msg&) { return value(); }                 \
  };                                                                         \
  }                                                                          \
  }

namespace ros {
/** Traits of message types; generated headers specialize them, and programs may do so for their own types. */
namespace message_traits {

typedef boost::true_type TrueType;
typedef boost::false_type FalseType;

/** True for types that have the same bytes in memory and on the wire. */
template <typename M>
struct IsSimple : FalseType {};
template <typename M>
struct IsSimple<const M> : IsSimple<M> {};
/** True for types whose serialized length is the same for all values. */
template <typename M>
struct IsFixedSize : FalseType {};
template <typename M>
struct IsFixedSize<const M> : IsFixedSize<M> {};
/** True for types whose first field is `header`. */
template <typename M>
struct HasHeader : FalseType {};
template <typename M>
struct HasHeader<const M> : HasHeader<M> {};
template <typename M>
struct IsMessage : FalseType {};
template <typename M>
struct IsMessage<const M> : IsMessage<M> {};

template <typename M>
struct MD5Sum {
  static const char* value() { return M::__s_getMD5Sum().c_str(); }
  static const char* value(const M& m) { return m.__getMD5Sum().c_str(); }
};
template <typename M>
struct DataType {
  static const char* value() { return M::__s_getDataType().c_str(); }
  static const char* value(const M& m) { return m.__getDataType().c_str(); }
};
template <typename M>
struct Definition {
  static const char* value() { return M::__s_getMessageDefinition().c_str(); }
  static const char* value(const M& m) { return m.__getMessageDefinition().c_str(); }
};

/** Fields of a message's header; null if it has none. */
template <typename M, bool has_header>
struct FieldsOfHeader {
  static std_msgs::Header* whole(M&) { return nullptr; }
  static std_msgs::Header const* whole(const M&) { return nullptr; }
  static std::string* frame(M&) { return nullptr; }
  static std::string const* frame(const M&) { return nullptr; }
  static ros::Time* stamp(M&) { return nullptr; }
  static ros::Time const* stamp(const M&) { return nullptr; }
};
template <typename M>
struct FieldsOfHeader<M, true> {
  static std_msgs::Header* whole(M& m) { return &m.header; }
  static std_msgs::Header const* whole(const M& m) { return &m.header; }
  static std::string* frame(M& m) { return &m.header.frame_id; }
  static std::string const* frame(const M& m) { return &m.header.frame_id; }
  static ros::Time* stamp(M& m) { return &m.header.stamp; }
  static ros::Time const* stamp(const M& m) { return &m.header.stamp; }
};
template <typename M, typename Enable = void>
struct Header {
  static std_msgs::Header* pointer(M& m) { return FieldsOfHeader<M, HasHeader<M>::value>::whole(m); }
  static std_msgs::Header const* pointer(const M& m) { return FieldsOfHeader<M, HasHeader<M>::value>::whole(m); }
};
template <typename M, typename Enable = void>
struct FrameId {
  static std::string* pointer(M& m) { return FieldsOfHeader<M, HasHeader<M>::value>::frame(m); }
  static std::string const* pointer(const M& m) { return FieldsOfHeader<M, HasHeader<M>::value>::frame(m); }
  static std::string value(const M& m) { return pointer(m) ? *pointer(m) : std::string(); }
};
template <typename M, typename Enable = void>
struct TimeStamp {
  static ros::Time* pointer(M& m) { return FieldsOfHeader<M, HasHeader<M>::value>::stamp(m); }
  static ros::Time const* pointer(const M& m) { return FieldsOfHeader<M, HasHeader<M>::value>::stamp(m); }
  static ros::Time value(const M& m) { return pointer(m) ? *pointer(m) : ros::Time(); }
};

template <typename M>
inline const char* md5sum() {
  return MD5Sum<typename boost::remove_const<typename boost::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* datatype() {
  return DataType<typename boost::remove_const<typename boost::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* definition() {
  return Definition<typename boost::remove_const<typename boost::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* md5sum(const M& m) {
  return MD5Sum<typename boost::remove_const<M>::type>::value(m);
}
template <typename M>
inline const char* datatype(const M& m) {
  return DataType<typename boost::remove_const<M>::type>::value(m);
}
template <typename M>
inline const char* definition(const M& m) {
  return Definition<typename boost::remove_const<M>::type>::value(m);
}
template <typename M>
inline std_msgs::Header* header(M& m) {
  return Header<M>::pointer(m);
}
template <typename M>
inline std_msgs::Header const* header(const M& m) {
  return Header<M>::pointer(m);
}
template <typename M>
inline std::string* frameId(M& m) {
  return FrameId<M>::pointer(m);
}
template <typename M>
inline std::string const* frameId(const M& m) {
  return FrameId<M>::pointer(m);
}
template <typename M>
inline ros::Time* timeStamp(M& m) {
  return TimeStamp<M>::pointer(m);
}
template <typename M>
inline ros::Time const* timeStamp(const M& m) {
  return TimeStamp<M>::pointer(m);
}
template <typename M>
inline bool isSimple() {
  return IsSimple<typename boost::remove_reference<M>::type>::value;
}
template <typename M>
inline bool isFixedSize() {
  return IsFixedSize<typename boost::remove_reference<M>::type>::value;
}
template <typename M>
inline bool hasHeader() {
  return HasHeader<typename boost::remove_reference<M>::type>::value;
}

}  // namespace message_traits
}  // namespace ros
