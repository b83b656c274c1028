#include "xmlrpcpp/XmlRpcUtil.h"

#include <climits>
#include <cstdlib>

namespace XmlRpc {
namespace {

constexpr char kSpaces[] = " \t\r\n";

void appendUtf8(std::string& out, unsigned long code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | code >> 6);
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    out += static_cast<char>(0xE0 | code >> 12);
    out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x110000) {
    out += static_cast<char>(0xF0 | code >> 18);
    out += static_cast<char>(0x80 | (code >> 12 & 0x3F));
    out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
}

/** True if the tag may be sought at the offset. */
bool isValid(const char* tag, const std::string& xml, const int* offset) {
  return tag && offset && *offset >= 0 && xml.size() <= INT_MAX && static_cast<size_t>(*offset) < xml.size();
}

/** Place of the first character at or after the offset that is no space. */
size_t nextText(const std::string& xml, int offset) {
  return xml.find_first_not_of(kSpaces, static_cast<size_t>(offset));
}

std::string endOf(const std::string& tag) { return "</" + tag.substr(1); }

}  // namespace

std::string XmlRpcUtil::parseTag(const char* tag, const std::string& xml, int* offset) {
  if (!isValid(tag, xml, offset)) return std::string();
  const size_t start = xml.find(tag, static_cast<size_t>(*offset));
  if (start == std::string::npos) return std::string();
  const std::string name = tag, last = endOf(name);
  const size_t end = xml.find(last, start + name.size());
  if (end == std::string::npos) return std::string();
  *offset = static_cast<int>(end + last.size());
  return xml.substr(start + name.size(), end - start - name.size());
}

bool XmlRpcUtil::findTag(const char* tag, const std::string& xml, int* offset) {
  if (!isValid(tag, xml, offset)) return false;
  const std::string name = tag;
  const size_t start = xml.find(name, static_cast<size_t>(*offset));
  if (start == std::string::npos) return false;
  *offset = static_cast<int>(start + name.size());
  return true;
}

bool XmlRpcUtil::nextTagIs(const char* tag, const std::string& xml, int* offset) {
  if (!isValid(tag, xml, offset)) return false;
  const std::string name = tag;
  const size_t start = nextText(xml, *offset);
  if (start == std::string::npos || xml.compare(start, name.size(), name) != 0) return false;
  *offset = static_cast<int>(start + name.size());
  return true;
}

std::string XmlRpcUtil::getNextTag(const std::string& xml, int* offset) {
  if (!isValid("", xml, offset)) return std::string();
  const size_t start = nextText(xml, *offset);
  if (start == std::string::npos || xml[start] != '<') return std::string();
  const size_t end = xml.find('>', start);
  const std::string tag = xml.substr(start, end == std::string::npos ? end : end + 1 - start);
  *offset = static_cast<int>(start + tag.size());
  return tag;
}

std::string XmlRpcUtil::nextTagData(const char* tag, const std::string& xml, int* offset) {
  int start = offset ? *offset : 0;
  if (!nextTagIs(tag, xml, offset ? &start : nullptr)) return std::string();
  const size_t end = xml.find('<', static_cast<size_t>(start));
  const std::string last = endOf(tag);
  if (end == std::string::npos || xml.compare(end, last.size(), last) != 0) return std::string();
  *offset = static_cast<int>(end + last.size());
  return xml.substr(static_cast<size_t>(start), end - static_cast<size_t>(start));
}

std::string XmlRpcUtil::xmlEncode(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) switch (c) {
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '&': result += "&amp;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&apos;"; break;
      default: result += c;
    }
  return result;
}

std::string XmlRpcUtil::xmlDecode(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const size_t end = text[i] == '&' ? text.find(';', i) : std::string::npos;
    if (end == std::string::npos || end - i > 10) {
      result += text[i];
      continue;
    }
    const std::string name = text.substr(i + 1, end - i - 1);
    if (name == "lt") result += '<';
    else if (name == "gt") result += '>';
    else if (name == "amp") result += '&';
    else if (name == "quot") result += '"';
    else if (name == "apos") result += '\'';
    else if (name.size() > 1 && name[0] == '#')
      appendUtf8(result, name[1] == 'x' ? std::strtoul(name.c_str() + 2, nullptr, 16)
                                        : std::strtoul(name.c_str() + 1, nullptr, 10));
    else {
      result += text[i];
      continue;
    }
    i = end;
  }
  return result;
}

}  // namespace XmlRpc
