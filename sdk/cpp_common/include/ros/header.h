#pragma once

#include <boost/shared_array.hpp>
#include <boost/shared_ptr.hpp>
#include <cstring>
#include <string>

#include "ros/datatypes.h"

namespace ros {

/** Fields of a connection's header or a bag's record: for each its length, in four bytes, and `name=value`. */
class Header {
 public:
  Header() : values_(new M_string) {}

  M_stringPtr getValues() { return values_; }
  bool getValue(const std::string& key, std::string& value) const {
    const M_string::const_iterator found = values_->find(key);
    if (found == values_->end()) return false;
    value = found->second;
    return true;
  }
  /** Add the fields of a buffer; false, with a reason, if it is none of a header. */
  bool parse(const boost::shared_array<uint8_t>& buffer, uint32_t size, std::string& error_msg) {
    return parse(buffer.get(), size, error_msg);
  }
  bool parse(uint8_t* buffer, uint32_t size, std::string& error_msg) {
    for (uint32_t at = 0; at < size;) {
      uint32_t length = 0;
      for (uint32_t i = 0; i < 4 && at + i < size; ++i) length |= static_cast<uint32_t>(buffer[at + i]) << 8 * i;
      if (size - at < 4 || length > size - at - 4) {
        error_msg = "a field of the header is longer than the header";
        return false;
      }
      const std::string field(reinterpret_cast<const char*>(buffer) + at + 4, length);
      const std::string::size_type equals = field.find('=');
      if (equals == std::string::npos) {
        error_msg = "a field of the header has no '='";
        return false;
      }
      (*values_)[field.substr(0, equals)] = field.substr(equals + 1);
      at += 4 + length;
    }
    return true;
  }
  static void write(const M_string& key_vals, boost::shared_array<uint8_t>& buffer, uint32_t& size) {
    size = 0;
    for (const M_string::value_type& field : key_vals)
      size += static_cast<uint32_t>(4 + field.first.size() + 1 + field.second.size());
    buffer.reset(new uint8_t[size]);
    uint8_t* at = buffer.get();
    for (const M_string::value_type& field : key_vals) {
      const std::string text = field.first + "=" + field.second;
      for (int i = 0; i < 4; ++i) *at++ = static_cast<uint8_t>(text.size() >> 8 * i);
      std::memcpy(at, text.data(), text.size());
      at += text.size();
    }
  }

 private:
  M_stringPtr values_;
};

}  // namespace ros
