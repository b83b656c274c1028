#pragma once

#include <string>

namespace XmlRpc {

/**
 * Tags in texts of XML, such as "<value>", and special characters.
 *
 * Each function seeks from an offset, and moves the offset behind what it finds. Without it, or with an offset outside
 * the text, the result is empty or false, and the offset stays.
 */
class XmlRpcUtil {
 public:
  /** Text between the next such tag and its end. */
  static std::string parseTag(const char* tag, const std::string& xml, int* offset);
  static bool findTag(const char* tag, const std::string& xml, int* offset);
  /** The tag that follows, after spaces only. */
  static std::string getNextTag(const std::string& xml, int* offset);
  static bool nextTagIs(const char* tag, const std::string& xml, int* offset);
  /** Text without tags in the tag that follows, after spaces only. */
  static std::string nextTagData(const char* tag, const std::string& xml, int* offset);
  static std::string xmlEncode(const std::string& text);
  static std::string xmlDecode(const std::string& text);
};

}  // namespace XmlRpc
