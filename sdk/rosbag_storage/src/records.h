#pragma once

#include <ros/time.h>

#include <cstring>
#include <map>
#include <string>

#include "rosbag/exceptions.h"

namespace rosbag {

/** Kinds of records, by the field `op`. */
enum Operation : uint8_t { kMessage = 2, kFileHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

/** Number in a bag: little-endian, as on all machines that the kit knows. */
template <class T>
std::string packed(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}
inline std::string packed(const ros::Time& time) { return packed(time.sec) + packed(time.nsec); }
template <class T>
T unpacked(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/** Header of a record: its fields by their names. */
class Fields {
 public:
  Fields() {}
  /** Throws BagFormatException. */
  Fields(const char* bytes, size_t size) {
    for (size_t at = 0; at < size;) {
      const uint32_t length = size - at < 4 ? 0 : unpacked<uint32_t>(bytes + at);
      const char* const equals = length == 0 || length > size - at - 4
                                     ? nullptr
                                     : static_cast<const char*>(memchr(bytes + at + 4, '=', length));
      if (!equals) throw BagFormatException("a record's header is damaged");
      const size_t name = static_cast<size_t>(equals - bytes) - at - 4;
      fields_[std::string(bytes + at + 4, name)] = std::string(equals + 1, length - name - 1);
      at += 4 + length;
    }
  }

  Fields& set(const std::string& name, const std::string& value) {
    fields_[name] = value;
    return *this;
  }
  std::string text() const {
    std::string text;
    for (const auto& [name, value] : fields_)
      text += packed(static_cast<uint32_t>(name.size() + 1 + value.size())) + name + "=" + value;
    return text;
  }
  const std::map<std::string, std::string>& all() const { return fields_; }
  std::string word(const std::string& name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? "" : found->second;
  }
  /** Number of a field; throws BagFormatException if there is none of that size. */
  template <class T>
  T number(const std::string& name) const {
    const std::string value = word(name);
    if (value.size() != sizeof(T)) throw BagFormatException("a record has no valid field " + name);
    return unpacked<T>(value.data());
  }
  ros::Time time(const std::string& name) const {
    const uint64_t both = number<uint64_t>(name);
    return timeOf(static_cast<uint32_t>(both), static_cast<uint32_t>(both >> 32));
  }
  static ros::Time timeOf(uint32_t sec, uint32_t nsec) {
    if (nsec >= 1000000000u) throw BagFormatException("a time has more than 999999999 ns");
    return ros::Time(sec, nsec);
  }

 private:
  std::map<std::string, std::string> fields_;
};

/** Record: the lengths of header and data, each before its bytes. */
inline std::string record(const Fields& fields, const std::string& data) {
  const std::string header = fields.text();
  return packed(static_cast<uint32_t>(header.size())) + header + packed(static_cast<uint32_t>(data.size())) + data;
}

}  // namespace rosbag
