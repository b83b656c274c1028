// XML-RPC's encoding of values.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <sstream>

#include "xmlrpcpp/XmlRpcUtil.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace XmlRpc {
namespace {

constexpr int kMaxDepth = 100;
constexpr size_t kLineBytes = 54;  // of base64, in 72 characters
constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(const std::vector<char>& bytes) {
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    unsigned block = 0;
    for (size_t k = 0; k < 3; ++k)
      block = block << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[block >> (18 - 6 * k) & 0x3F];
    if ((i + 3) % kLineBytes == 0 || i + 3 >= bytes.size()) text += '\n';
  }
  return text;
}

std::vector<char> fromBase64(const std::string& text) {
  std::vector<char> bytes;
  unsigned block = 0, bits = 0;
  const std::string digits = kDigits;
  for (const char c : text) {
    const size_t digit = digits.find(c);
    if (digit == std::string::npos) continue;
    block = block << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(block >> bits & 0xFF));
  }
  return bytes;
}

std::string number(double value) {
  if (!XmlRpcValue::getDoubleFormat().empty()) {
    char text[128];  // cut off there, as by the original
    std::snprintf(text, sizeof(text), XmlRpcValue::getDoubleFormat().c_str(), value);
    return text;
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << value;
  return text.str();
}

std::string date(const struct tm& t) {
  char text[100];
  std::snprintf(text, sizeof(text), "%4d%02d%02dT%02d:%02d:%02d", t.tm_year, t.tm_mon, t.tm_mday, t.tm_hour, t.tm_min,
                t.tm_sec);
  return text;
}

}  // namespace

/** Reads a value's XML; every position is checked, and nesting is bounded. */
class XmlReader {
 public:
  XmlReader(const std::string& xml, size_t offset) : xml_(xml), at_(offset) {}

  bool value(XmlRpcValue& out, int depth) {
    bool is_empty = false;
    if (depth > kMaxDepth || !open("value", is_empty)) return false;
    if (is_empty) {
      out = XmlRpcValue("");
      return true;
    }
    return typed(out, depth) && close("value");
  }
  size_t position() const { return at_; }

 private:
  void skip() {
    while (at_ < xml_.size() && std::isspace(static_cast<unsigned char>(xml_[at_]))) ++at_;
  }

  bool literal(const std::string& text) {
    if (xml_.compare(at_, text.size(), text) != 0) return false;
    at_ += text.size();
    return true;
  }

  /** Enter an element; `is_empty` if it is written as <name/>. */
  bool open(const std::string& name, bool& is_empty) {
    const size_t start = at_;
    skip();
    if (literal("<" + name)) {
      while (at_ < xml_.size() && std::isspace(static_cast<unsigned char>(xml_[at_]))) ++at_;
      if (literal(">")) {
        is_empty = false;
        return true;
      }
      if (literal("/>")) {
        is_empty = true;
        return true;
      }
    }
    at_ = start;
    return false;
  }

  bool close(const std::string& name) {
    skip();
    return literal("</" + name + ">");
  }

  std::string text() {
    const size_t end = std::min(xml_.find('<', at_), xml_.size());
    const std::string found = xml_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  bool typed(XmlRpcValue& out, int depth) {
    bool is_empty = false;
    const char* const kScalars[] = {"string", "int", "i4", "double", "boolean", "base64", "dateTime.iso8601"};
    for (const char* const name : kScalars)
      if (open(name, is_empty)) {
        const std::string content = is_empty ? "" : text();
        return scalar(out, name, content) && (is_empty || close(name));
      }
    if (open("array", is_empty)) return is_empty || array(out, depth);
    if (open("struct", is_empty)) {
      out.become(XmlRpcValue::TypeStruct);
      return is_empty || members(out, depth);
    }
    out = XmlRpcValue(XmlRpcUtil::xmlDecode(text()));  // text without an element is a string
    return true;
  }

  static bool scalar(XmlRpcValue& out, const std::string& type, const std::string& content) {
    if (type == "string") {
      out = XmlRpcValue(XmlRpcUtil::xmlDecode(content));
      return true;
    }
    if (type == "base64") {
      std::vector<char> bytes = fromBase64(content);
      out = XmlRpcValue(bytes.data(), static_cast<int>(bytes.size()));
      return true;
    }
    if (type == "dateTime.iso8601") {
      struct tm t = {};
      if (std::sscanf(content.c_str(), "%4d%2d%2dT%2d:%2d:%2d", &t.tm_year, &t.tm_mon, &t.tm_mday, &t.tm_hour,
                      &t.tm_min, &t.tm_sec) != 6)
        return false;
      t.tm_isdst = -1;
      out = XmlRpcValue(&t);
      return true;
    }
    std::istringstream in(content);
    in.imbue(std::locale::classic());
    if (type == "double") {
      char* end = nullptr;
      double value = 0.0;
      if (!(in >> value)) {  // for inf and nan, which streams do not read
        value = std::strtod(content.c_str(), &end);
        if (end == content.c_str()) return false;
      }
      out = XmlRpcValue(value);
      return true;
    }
    long long value = 0;
    if (!(in >> value) || value < -2147483648LL || value > 2147483647LL) return false;
    if (type == "boolean") {
      if (value != 0 && value != 1) return false;
      out = XmlRpcValue(value == 1);
    } else {
      out = XmlRpcValue(static_cast<int>(value));
    }
    return true;
  }

  bool array(XmlRpcValue& out, int depth) {
    bool is_empty = false;
    out.become(XmlRpcValue::TypeArray);
    if (!open("data", is_empty)) return false;
    while (!is_empty) {
      const size_t before = at_;
      XmlRpcValue element;
      if (close("data")) break;
      at_ = before;
      if (!value(element, depth + 1)) return false;
      out._value.asArray->push_back(std::move(element));
    }
    return close("array");
  }

  bool members(XmlRpcValue& out, int depth) {
    bool is_empty = false;
    while (open("member", is_empty)) {
      if (is_empty || !open("name", is_empty)) return false;
      const std::string name = is_empty ? "" : XmlRpcUtil::xmlDecode(text());
      if (!is_empty && !close("name")) return false;
      XmlRpcValue element;
      if (!value(element, depth + 1) || !close("member")) return false;
      (*out._value.asStruct)[name] = std::move(element);
    }
    return close("struct");
  }

  const std::string& xml_;
  size_t at_;
};

bool XmlRpcValue::fromXml(const std::string& xml, int* offset) {
  clear();
  if (!offset) return false;
  XmlReader reader(xml, static_cast<size_t>(std::max(0, *offset)));
  if (static_cast<size_t>(*offset) > xml.size() || !reader.value(*this, 0)) {
    clear();
    return false;
  }
  *offset = static_cast<int>(reader.position());
  return true;
}

std::string XmlRpcValue::toXml() const {
  switch (_type) {
    case TypeBoolean: return std::string("<value><boolean>") + (_value.asBool ? "1" : "0") + "</boolean></value>";
    case TypeInt: return "<value><i4>" + std::to_string(_value.asInt) + "</i4></value>";
    case TypeDouble: return "<value><double>" + number(_value.asDouble) + "</double></value>";
    case TypeString: return "<value>" + XmlRpcUtil::xmlEncode(*_value.asString) + "</value>";
    case TypeDateTime: return "<value><dateTime.iso8601>" + date(*_value.asTime) + "</dateTime.iso8601></value>";
    case TypeBase64: return "<value><base64>" + base64(*_value.asBinary) + "</base64></value>";
    case TypeArray: {
      std::string xml = "<value><array><data>";
      for (const XmlRpcValue& element : *_value.asArray) xml += element.toXml();
      return xml + "</data></array></value>";
    }
    case TypeStruct: {
      std::string xml = "<value><struct>";
      for (const auto& member : *_value.asStruct)
        xml += "<member><name>" + XmlRpcUtil::xmlEncode(member.first) + "</name>" + member.second.toXml() + "</member>";
      return xml + "</struct></value>";
    }
    default: return "<value></value>";
  }
}

std::ostream& XmlRpcValue::write(std::ostream& out) const {
  switch (_type) {
    case TypeBoolean: return out << _value.asBool;
    case TypeInt: return out << _value.asInt;
    case TypeDouble: return getDoubleFormat().empty() ? out << _value.asDouble : out << number(_value.asDouble);
    case TypeString: return out << *_value.asString;
    case TypeDateTime: return out << date(*_value.asTime);
    case TypeBase64: return out << base64(*_value.asBinary);
    case TypeArray: {
      out << '{';
      for (size_t i = 0; i < _value.asArray->size(); ++i) (*_value.asArray)[i].write(i > 0 ? out << ',' : out);
      return out << '}';
    }
    case TypeStruct: {
      out << '[';
      for (const_iterator i = begin(); i != end(); ++i) {
        if (i != begin()) out << ',';
        i->second.write(out << i->first << ':');
      }
      return out << ']';
    }
    default: return out;
  }
}

}  // namespace XmlRpc
