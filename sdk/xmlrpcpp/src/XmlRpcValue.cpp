#include "xmlrpcpp/XmlRpcValue.h"

#include <cstring>
#include <ostream>
#include <stdexcept>

namespace XmlRpc {
namespace {

constexpr int kMaxElements = 10000000;  // larger indices are a program's mistake

const char* nameOf(XmlRpcValue::Type type) {
  static const char* const kNames[] = {"invalid", "boolean", "int",   "double", "string",
                                       "date",    "binary",  "array", "struct"};
  return kNames[type];
}

std::string& doubleFormat() {
  static std::string format;
  return format;
}

}  // namespace

XmlRpcValue::XmlRpcValue(void* value, int size) : _type(TypeBase64) {
  const char* const bytes = static_cast<const char*>(value);
  _value.asBinary = new BinaryData(bytes, bytes + size);
}

void XmlRpcValue::clear() {
  switch (_type) {
    case TypeString: delete _value.asString; break;
    case TypeDateTime: delete _value.asTime; break;
    case TypeBase64: delete _value.asBinary; break;
    case TypeArray: delete _value.asArray; break;
    case TypeStruct: delete _value.asStruct; break;
    default: break;
  }
  _type = TypeInvalid;
  _value.asBinary = nullptr;
}

XmlRpcValue& XmlRpcValue::operator=(const XmlRpcValue& other) {
  if (this == &other) return *this;
  decltype(_value) copy = other._value;
  switch (other._type) {
    case TypeString: copy.asString = new std::string(*other._value.asString); break;
    case TypeDateTime: copy.asTime = new struct tm(*other._value.asTime); break;
    case TypeBase64: copy.asBinary = new BinaryData(*other._value.asBinary); break;
    case TypeArray: copy.asArray = new ValueArray(*other._value.asArray); break;
    case TypeStruct: copy.asStruct = new ValueStruct(*other._value.asStruct); break;
    default: break;
  }
  const Type type = other._type;  // `other` may be an element of this value
  clear();
  _type = type;
  _value = copy;
  return *this;
}

XmlRpcValue& XmlRpcValue::operator=(XmlRpcValue&& other) noexcept {
  if (this == &other) return *this;
  const Type type = other._type;
  const decltype(_value) value = other._value;
  other._type = TypeInvalid;
  clear();
  _type = type;
  _value = value;
  return *this;
}

bool XmlRpcValue::operator==(const XmlRpcValue& other) const {
  if (_type != other._type) return false;
  switch (_type) {
    case TypeBoolean: return _value.asBool == other._value.asBool;
    case TypeInt: return _value.asInt == other._value.asInt;
    case TypeDouble: return _value.asDouble == other._value.asDouble;
    case TypeString: return *_value.asString == *other._value.asString;
    case TypeDateTime: {
      const struct tm &a = *_value.asTime, &b = *other._value.asTime;
      return a.tm_sec == b.tm_sec && a.tm_min == b.tm_min && a.tm_hour == b.tm_hour && a.tm_mday == b.tm_mday &&
             a.tm_mon == b.tm_mon && a.tm_year == b.tm_year;
    }
    case TypeBase64: return *_value.asBinary == *other._value.asBinary;
    case TypeArray: return *_value.asArray == *other._value.asArray;
    case TypeStruct: return *_value.asStruct == *other._value.asStruct;
    default: return true;
  }
}

void XmlRpcValue::require(Type type) const {
  if (_type != type)
    throw XmlRpcException(std::string("type error: expected ") + nameOf(type) + ", got " + nameOf(_type));
}

/** An invalid value becomes an empty one of the type; any other value must have the type already. */
void XmlRpcValue::become(Type type) {
  if (_type == TypeInvalid) switch (type) {
      case TypeBoolean: *this = false; break;
      case TypeInt: *this = 0; break;
      case TypeDouble: *this = 0.0; break;
      case TypeString: *this = ""; break;
      case TypeDateTime: _value.asTime = new struct tm(); break;
      case TypeBase64: _value.asBinary = new BinaryData(); break;
      case TypeArray: _value.asArray = new ValueArray(); break;
      case TypeStruct: _value.asStruct = new ValueStruct(); break;
      default: break;
    }
  if (_type == TypeInvalid) _type = type;
  require(type);
}

#define XMLRPC_CAST(Result, type, member)       \
  XmlRpcValue::operator Result&() {             \
    become(type);                               \
    return member;                              \
  }                                             \
  XmlRpcValue::operator const Result&() const { \
    require(type);                              \
    return member;                              \
  }
XMLRPC_CAST(bool, TypeBoolean, _value.asBool)
XMLRPC_CAST(int, TypeInt, _value.asInt)
XMLRPC_CAST(double, TypeDouble, _value.asDouble)
XMLRPC_CAST(std::string, TypeString, *_value.asString)
XMLRPC_CAST(XmlRpcValue::BinaryData, TypeBase64, *_value.asBinary)
XMLRPC_CAST(struct tm, TypeDateTime, *_value.asTime)
#undef XMLRPC_CAST

XmlRpcValue& XmlRpcValue::operator[](int i) {
  become(TypeArray);
  if (i < 0 || i >= kMaxElements) throw XmlRpcException("range error: array index too small or too large");
  if (static_cast<size_t>(i) >= _value.asArray->size()) _value.asArray->resize(static_cast<size_t>(i) + 1);
  return (*_value.asArray)[static_cast<size_t>(i)];
}

const XmlRpcValue& XmlRpcValue::operator[](int i) const {
  require(TypeArray);
  if (i < 0 || static_cast<size_t>(i) >= _value.asArray->size())
    throw XmlRpcException("range error: array index too small or too large");
  return (*_value.asArray)[static_cast<size_t>(i)];
}

XmlRpcValue& XmlRpcValue::operator[](const std::string& key) {
  become(TypeStruct);
  return (*_value.asStruct)[key];
}

const XmlRpcValue& XmlRpcValue::operator[](const std::string& key) const {
  require(TypeStruct);
  const const_iterator found = _value.asStruct->find(key);
  if (found == _value.asStruct->end()) throw XmlRpcException("no member '" + key + "' in the struct");
  return found->second;
}

XmlRpcValue::iterator XmlRpcValue::begin() {
  require(TypeStruct);
  return _value.asStruct->begin();
}
XmlRpcValue::iterator XmlRpcValue::end() {
  require(TypeStruct);
  return _value.asStruct->end();
}
XmlRpcValue::const_iterator XmlRpcValue::begin() const {
  require(TypeStruct);
  return _value.asStruct->begin();
}
XmlRpcValue::const_iterator XmlRpcValue::end() const {
  require(TypeStruct);
  return _value.asStruct->end();
}

int XmlRpcValue::size() const {
  switch (_type) {
    case TypeString: return static_cast<int>(_value.asString->size());
    case TypeBase64: return static_cast<int>(_value.asBinary->size());
    case TypeArray: return static_cast<int>(_value.asArray->size());
    case TypeStruct: return static_cast<int>(_value.asStruct->size());
    default: throw XmlRpcException(std::string("type error: a value of type ") + nameOf(_type) + " has no size");
  }
}

void XmlRpcValue::setSize(int size) {
  become(TypeArray);
  if (size < 0 || size > kMaxElements) throw XmlRpcException("range error: array size too small or too large");
  _value.asArray->resize(static_cast<size_t>(size));
}

bool XmlRpcValue::hasMember(const std::string& name) const {
  return _type == TypeStruct && _value.asStruct->find(name) != _value.asStruct->end();
}

const std::string& XmlRpcValue::getDoubleFormat() { return doubleFormat(); }
void XmlRpcValue::setDoubleFormat(const char* format) { doubleFormat() = format; }

std::ostream& operator<<(std::ostream& out, const XmlRpcValue& value) { return value.write(out); }

}  // namespace XmlRpc
