#pragma once

#include <iomanip>
#include <ostream>
#include <string>
#include <vector>

namespace ros {
namespace message_operations {

/** Prints a message, a line per field; generated headers specialize it. */
template <typename M>
struct Printer {
  template <typename Stream>
  static void stream(Stream& s, const std::string& indent, const M& value) {
    (void)indent;
    s << value << "\n";
  }
};
template <>
struct Printer<int8_t> {
  template <typename Stream>
  static void stream(Stream& s, const std::string&, int8_t value) {
    s << static_cast<int32_t>(value) << "\n";
  }
};
template <>
struct Printer<uint8_t> {
  template <typename Stream>
  static void stream(Stream& s, const std::string&, uint8_t value) {
    s << static_cast<uint32_t>(value) << "\n";
  }
};

/** Prints the elements of an array, each with its index. */
template <typename Stream, typename Array>
void printArray(Stream& s, const std::string& indent, const char* name, const Array& array, bool are_messages) {
  s << indent << name << "[]\n";
  for (size_t i = 0; i < array.size(); ++i) {
    s << indent << "  " << name << "[" << i << "]: ";
    if (are_messages) s << "\n";
    Printer<typename Array::value_type>::stream(s, indent + (are_messages ? "    " : "  "), array[i]);
  }
}

}  // namespace message_operations
}  // namespace ros
