#pragma once

#include <ctime>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "xmlrpcpp/XmlRpcException.h"

namespace XmlRpc {

/** Value of a parameter or of a call: scalar, array or struct. An invalid one takes the type of what is assigned. */
class XmlRpcValue {
 public:
  enum Type {
    TypeInvalid,
    TypeBoolean,
    TypeInt,
    TypeDouble,
    TypeString,
    TypeDateTime,
    TypeBase64,
    TypeArray,
    TypeStruct
  };
  typedef std::vector<char> BinaryData;
  typedef std::vector<XmlRpcValue> ValueArray;
  typedef std::map<std::string, XmlRpcValue> ValueStruct;
  typedef ValueStruct::iterator iterator;
  typedef ValueStruct::const_iterator const_iterator;

  XmlRpcValue() : _type(TypeInvalid) { _value.asBinary = nullptr; }
  XmlRpcValue(bool value) : _type(TypeBoolean) { _value.asBool = value; }
  XmlRpcValue(int value) : _type(TypeInt) { _value.asInt = value; }
  XmlRpcValue(double value) : _type(TypeDouble) { _value.asDouble = value; }
  XmlRpcValue(const std::string& value) : _type(TypeString) { _value.asString = new std::string(value); }
  XmlRpcValue(const char* value) : _type(TypeString) { _value.asString = new std::string(value); }
  XmlRpcValue(struct tm* value) : _type(TypeDateTime) { _value.asTime = new struct tm(*value); }
  XmlRpcValue(void* value, int size);
  /** Read the value in XML at an offset, and move the offset behind it; invalid if there is no value. */
  XmlRpcValue(const std::string& xml, int* offset) : _type(TypeInvalid) {
    _value.asBinary = nullptr;
    fromXml(xml, offset);
  }
  XmlRpcValue(const XmlRpcValue& other) : _type(TypeInvalid) { *this = other; }
  XmlRpcValue(XmlRpcValue&& other) noexcept : _type(other._type), _value(other._value) { other._type = TypeInvalid; }
  ~XmlRpcValue() { clear(); }

  void clear();
  XmlRpcValue& operator=(const XmlRpcValue& other);
  XmlRpcValue& operator=(XmlRpcValue&& other) noexcept;
  XmlRpcValue& operator=(const int& value) { return *this = XmlRpcValue(value); }
  XmlRpcValue& operator=(const double& value) { return *this = XmlRpcValue(value); }
  XmlRpcValue& operator=(const char* value) { return *this = XmlRpcValue(value); }
  XmlRpcValue& operator=(const std::string& value) { return *this = XmlRpcValue(value); }
  XmlRpcValue& operator=(bool value) { return *this = XmlRpcValue(value); }
  bool operator==(const XmlRpcValue& other) const;
  bool operator!=(const XmlRpcValue& other) const { return !(*this == other); }

  operator bool&();
  operator int&();
  operator double&();
  operator std::string&();
  operator BinaryData&();
  operator struct tm&();
  operator const bool&() const;
  operator const int&() const;
  operator const double&() const;
  operator const std::string&() const;
  operator const BinaryData&() const;
  operator const struct tm&() const;

  XmlRpcValue& operator[](int i);
  const XmlRpcValue& operator[](int i) const;
  XmlRpcValue& operator[](const std::string& key);
  XmlRpcValue& operator[](const char* key) { return (*this)[std::string(key)]; }
  const XmlRpcValue& operator[](const std::string& key) const;
  const XmlRpcValue& operator[](const char* key) const { return (*this)[std::string(key)]; }

  iterator begin();
  iterator end();
  const_iterator begin() const;
  const_iterator end() const;

  bool valid() const { return _type != TypeInvalid; }
  const Type& getType() const { return _type; }
  /** Length of a string, binary, array or struct. */
  int size() const;
  void setSize(int size);
  bool hasMember(const std::string& name) const;

  bool fromXml(const std::string& xml, int* offset);
  std::string toXml() const;
  std::ostream& write(std::ostream& out) const;

  static const std::string& getDoubleFormat();
  static void setDoubleFormat(const char* format);

 private:
  friend class XmlReader;
  void become(Type type);
  void require(Type type) const;

 protected:  // programs derive classes that fill a value
  Type _type;
  union {
    bool asBool;
    int asInt;
    double asDouble;
    struct tm* asTime;
    std::string* asString;
    BinaryData* asBinary;
    ValueArray* asArray;
    ValueStruct* asStruct;
  } _value;
};

std::ostream& operator<<(std::ostream& out, const XmlRpcValue& value);

}  // namespace XmlRpc
