#pragma once

#include <ros/datatypes.h>
#include <stdint.h>

#include <boost/array.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_array.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/utility/enable_if.hpp>
#include <cstring>
#include <list>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ros/builtin_message_traits.h"
#include "ros/exception.h"
#include "ros/message_traits.h"
#include "ros/serialized_message.h"
#include "ros/types.h"

#define ROS_DECLARE_ALLINONE_SERIALIZER                         \
  template <typename Stream, typename T>                        \
  inline static void write(Stream& stream, const T& t) {        \
    allInOne<Stream, const T&>(stream, t);                      \
  }                                                             \
  template <typename Stream, typename T>                        \
  inline static void read(Stream& stream, T& t) {               \
    allInOne<Stream, T&>(stream, t);                            \
  }                                                             \
  template <typename T>                                         \
  inline static uint32_t serializedLength(const T& t) {         \
    ros::serialization::LStream stream;                         \
    allInOne<ros::serialization::LStream, const T&>(stream, t); \
    return stream.getLength();                                  \
  }

namespace ros {
/** Messages as the bytes of the wire: little-endian, without padding, lengths before strings and arrays. */
namespace serialization {

namespace mt = message_traits;

/** A read or write would go beyond the end of the bytes. */
class StreamOverrunException : public ros::Exception {
 public:
  explicit StreamOverrunException(const std::string& what) : Exception(what) {}
};

inline void throwStreamOverrun() { throw StreamOverrunException("Buffer Overrun"); }

/** Reads and writes a type, and computes its length; specialized for each type. */
template <typename T>
struct Serializer {
  template <typename Stream>
  inline static void write(Stream& stream, const T& t) {
    t.serialize(stream.getData(), 0);
  }
  template <typename Stream>
  inline static void read(Stream& stream, T& t) {
    t.deserialize(stream.getData());
  }
  inline static uint32_t serializedLength(const T& t) { return t.serializationLength(); }
};

template <typename T, typename Stream>
inline void serialize(Stream& stream, const T& t) {
  Serializer<T>::write(stream, t);
}
template <typename T, typename Stream>
inline void deserialize(Stream& stream, T& t) {
  Serializer<T>::read(stream, t);
}
template <typename T>
inline uint32_t serializationLength(const T& t) {
  return Serializer<T>::serializedLength(t);
}

namespace stream_types {
enum StreamType { Input, Output, Length };
}

/** Position in a buffer of known length. */
struct Stream {
  uint8_t* getData() { return data_; }
  uint32_t getLength() { return static_cast<uint32_t>(end_ - data_); }
  /** Return the present position and go on by `len` bytes; throws at the end of the buffer. */
  uint8_t* advance(uint32_t len) {
    if (len > static_cast<size_t>(end_ - data_)) throwStreamOverrun();
    uint8_t* const old = data_;
    data_ += len;
    return old;
  }

 protected:
  Stream(uint8_t* data, uint32_t count) : data_(data), end_(data + count) {}

 private:
  uint8_t *data_, *end_;
};

struct IStream : public Stream {
  static const stream_types::StreamType stream_type = stream_types::Input;
  IStream(uint8_t* data, uint32_t count) : Stream(data, count) {}
  template <typename T>
  void next(T& t) {
    deserialize(*this, t);
  }
  template <typename T>
  IStream& operator>>(T& t) {
    deserialize(*this, t);
    return *this;
  }
};

struct OStream : public Stream {
  static const stream_types::StreamType stream_type = stream_types::Output;
  OStream(uint8_t* data, uint32_t count) : Stream(data, count) {}
  template <typename T>
  void next(const T& t) {
    serialize(*this, t);
  }
  template <typename T>
  OStream& operator<<(const T& t) {
    serialize(*this, t);
    return *this;
  }
};

/** Adds up lengths. */
struct LStream {
  static const stream_types::StreamType stream_type = stream_types::Length;
  LStream() : count_(0) {}
  template <typename T>
  void next(const T& t) {
    count_ += serializationLength(t);
  }
  uint32_t advance(uint32_t len) {
    const uint32_t old = count_;
    count_ += len;
    return old;
  }
  uint32_t getLength() { return count_; }

 private:
  uint32_t count_;
};

#define ROS_SIMPLE_SERIALIZER(Type)                                                                      \
  template <>                                                                                            \
  struct Serializer<Type> {                                                                              \
    template <typename Stream>                                                                           \
    inline static void write(Stream& stream, const Type v) {                                             \
      std::memcpy(stream.advance(static_cast<uint32_t>(sizeof(v))), &v, sizeof(v));                      \
    }                                                                                                    \
    template <typename Stream>                                                                           \
    inline static void read(Stream& stream, Type& v) {                                                   \
      std::memcpy(&v, stream.advance(static_cast<uint32_t>(sizeof(v))), sizeof(v));                      \
    }                                                                                                    \
    inline static uint32_t serializedLength(const Type&) { return static_cast<uint32_t>(sizeof(Type)); } \
  }
ROS_SIMPLE_SERIALIZER(uint8_t);
ROS_SIMPLE_SERIALIZER(int8_t);
ROS_SIMPLE_SERIALIZER(uint16_t);
ROS_SIMPLE_SERIALIZER(int16_t);
ROS_SIMPLE_SERIALIZER(uint32_t);
ROS_SIMPLE_SERIALIZER(int32_t);
ROS_SIMPLE_SERIALIZER(uint64_t);
ROS_SIMPLE_SERIALIZER(int64_t);
ROS_SIMPLE_SERIALIZER(float);
ROS_SIMPLE_SERIALIZER(double);
#undef ROS_SIMPLE_SERIALIZER

template <>
struct Serializer<bool> {
  template <typename Stream>
  inline static void write(Stream& stream, const bool v) {
    *stream.advance(1) = v ? 1 : 0;
  }
  template <typename Stream>
  inline static void read(Stream& stream, bool& v) {
    v = *stream.advance(1) != 0;
  }
  inline static uint32_t serializedLength(bool) { return 1; }
};

template <class Allocator>
struct Serializer<std::basic_string<char, std::char_traits<char>, Allocator> > {
  typedef std::basic_string<char, std::char_traits<char>, Allocator> Text;
  template <typename Stream>
  inline static void write(Stream& stream, const Text& text) {
    const uint32_t size = static_cast<uint32_t>(text.size());
    stream.next(size);
    uint8_t* const target = stream.advance(size);
    if (size > 0) std::memcpy(target, text.data(), size);
  }
  template <typename Stream>
  inline static void read(Stream& stream, Text& text) {
    uint32_t size;
    stream.next(size);
    const uint8_t* const source = stream.advance(size);
    text.assign(reinterpret_cast<const char*>(source), size);
  }
  inline static uint32_t serializedLength(const Text& text) { return 4 + static_cast<uint32_t>(text.size()); }
};

template <>
struct Serializer<ros::Time> {
  template <typename Stream>
  inline static void write(Stream& stream, const ros::Time& v) {
    stream.next(v.sec);
    stream.next(v.nsec);
  }
  template <typename Stream>
  inline static void read(Stream& stream, ros::Time& v) {
    stream.next(v.sec);
    stream.next(v.nsec);
  }
  inline static uint32_t serializedLength(const ros::Time&) { return 8; }
};

template <>
struct Serializer<ros::Duration> {
  template <typename Stream>
  inline static void write(Stream& stream, const ros::Duration& v) {
    stream.next(v.sec);
    stream.next(v.nsec);
  }
  template <typename Stream>
  inline static void read(Stream& stream, ros::Duration& v) {
    stream.next(v.sec);
    stream.next(v.nsec);
  }
  inline static uint32_t serializedLength(const ros::Duration&) { return 8; }
};

/** Elements of an array, in one block if memory and wire are the same. */
template <typename T, bool is_simple = mt::IsSimple<T>::value>
struct Elements {
  template <typename Stream>
  inline static void write(Stream& stream, const T* first, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) stream.next(first[i]);
  }
  template <typename Stream>
  inline static void read(Stream& stream, T* first, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) stream.next(first[i]);
  }
  /** Reads an array after its count. Memory grows with the elements, not with the announced count. */
  template <typename Stream, class Vector>
  inline static void readInto(Stream& stream, Vector& v, uint32_t count) {
    if (count > stream.getLength() && !mt::IsFixedSize<T>::value) throwStreamOverrun();
    if (count <= 64) {
      v.resize(count);
      read(stream, v.data(), count);
      return;
    }
    v.resize(0);
    for (uint32_t i = 0; i < count; ++i) {
      if (stream.getLength() == 0) throwStreamOverrun();
      v.emplace_back();
      stream.next(v.back());
    }
  }
  inline static uint32_t length(const T* first, uint32_t count) {
    if (mt::IsFixedSize<T>::value) return count == 0 ? 0 : count * serializationLength(*first);
    uint32_t total = 0;
    for (uint32_t i = 0; i < count; ++i) total += serializationLength(first[i]);
    return total;
  }
};

template <typename T>
struct Elements<T, true> {
  template <typename Stream>
  inline static void write(Stream& stream, const T* first, uint32_t count) {
    const uint32_t size = count * static_cast<uint32_t>(sizeof(T));
    uint8_t* const target = stream.advance(size);
    if (size > 0) std::memcpy(target, reinterpret_cast<const void*>(first), size);
  }
  template <typename Stream>
  inline static void read(Stream& stream, T* first, uint32_t count) {
    const uint32_t size = count * static_cast<uint32_t>(sizeof(T));
    const uint8_t* const source = stream.advance(size);
    if (size > 0) std::memcpy(reinterpret_cast<void*>(first), source, size);
  }
  template <typename Stream, class Vector>
  inline static void readInto(Stream& stream, Vector& v, uint32_t count) {
    if (count > stream.getLength() / sizeof(T)) throwStreamOverrun();
    v.resize(count);
    read(stream, v.data(), count);
  }
  inline static uint32_t length(const T*, uint32_t count) { return count * static_cast<uint32_t>(sizeof(T)); }
};

template <typename T, class Allocator>
struct Serializer<std::vector<T, Allocator> > {
  typedef std::vector<T, Allocator> Vector;
  template <typename Stream>
  inline static void write(Stream& stream, const Vector& v) {
    stream.next(static_cast<uint32_t>(v.size()));
    Elements<T>::write(stream, v.data(), static_cast<uint32_t>(v.size()));
  }
  template <typename Stream>
  inline static void read(Stream& stream, Vector& v) {
    uint32_t count;
    stream.next(count);
    Elements<T>::readInto(stream, v, count);
  }
  inline static uint32_t serializedLength(const Vector& v) {
    return 4 + Elements<T>::length(v.data(), static_cast<uint32_t>(v.size()));
  }
};

/** For programs that serialize their own types with std::vector<bool>, which does not store elements as bools. */
template <class Allocator>
struct Serializer<std::vector<bool, Allocator> > {
  typedef std::vector<bool, Allocator> Vector;
  template <typename Stream>
  inline static void write(Stream& stream, const Vector& v) {
    stream.next(static_cast<uint32_t>(v.size()));
    for (const bool b : v) stream.next(b);
  }
  template <typename Stream>
  inline static void read(Stream& stream, Vector& v) {
    uint32_t count;
    stream.next(count);
    if (count > stream.getLength()) throwStreamOverrun();
    v.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
      bool b;
      stream.next(b);
      v[i] = b;
    }
  }
  inline static uint32_t serializedLength(const Vector& v) { return 4 + static_cast<uint32_t>(v.size()); }
};

template <typename T, size_t N>
struct Serializer<boost::array<T, N> > {
  typedef boost::array<T, N> Array;
  template <typename Stream>
  inline static void write(Stream& stream, const Array& v) {
    Elements<T>::write(stream, v.data(), static_cast<uint32_t>(N));
  }
  template <typename Stream>
  inline static void read(Stream& stream, Array& v) {
    Elements<T>::read(stream, v.data(), static_cast<uint32_t>(N));
  }
  inline static uint32_t serializedLength(const Array& v) {
    return Elements<T>::length(v.data(), static_cast<uint32_t>(N));
  }
};

/** Serialize a message after its length. */
template <typename M>
inline SerializedMessage serializeMessage(const M& message) {
  SerializedMessage result;
  const uint32_t size = serializationLength(message);
  result.num_bytes = size + 4;
  result.buf.reset(new uint8_t[result.num_bytes]);
  OStream stream(result.buf.get(), static_cast<uint32_t>(result.num_bytes));
  serialize(stream, size);
  result.message_start = stream.getData();
  serialize(stream, message);
  return result;
}

/** Serialize a response of a service after a byte that tells whether the call succeeded. */
template <typename M>
inline SerializedMessage serializeServiceResponse(bool ok, const M& message) {
  SerializedMessage result;
  const uint32_t size = serializationLength(message);
  result.num_bytes = size + 5;
  result.buf.reset(new uint8_t[result.num_bytes]);
  OStream stream(result.buf.get(), static_cast<uint32_t>(result.num_bytes));
  serialize(stream, static_cast<uint8_t>(ok));
  serialize(stream, size);
  result.message_start = stream.getData();
  serialize(stream, message);
  return result;
}

template <typename M>
inline void deserializeMessage(const SerializedMessage& m, M& message) {
  const size_t before = static_cast<size_t>(m.message_start - m.buf.get());
  IStream stream(m.message_start, static_cast<uint32_t>(m.num_bytes - before));
  deserialize(stream, message);
}

template <typename M>
struct PreDeserializeParams {
  boost::shared_ptr<M> message;
  boost::shared_ptr<std::map<std::string, std::string> > connection_header;
};

/** Called with each message before it is read; programs may specialize it. */
template <typename M>
struct PreDeserialize {
  static void notify(const PreDeserializeParams<M>&) {}
};

}  // namespace serialization
}  // namespace ros
