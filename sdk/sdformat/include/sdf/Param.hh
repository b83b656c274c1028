// Value of an element or an attribute.
#ifndef SDF_PARAM_HH_
#define SDF_PARAM_HH_

#include <cstdint>
#include <sstream>
#include <string>

#include <sdf/Types.hh>

namespace sdf {

class Param {
 public:
  Param(const std::string& key, const std::string& type, const std::string& value, bool required = false)
      : key_(key), type_(type), default_(value), value_(value), required_(required), set_(false) {}

  const std::string& GetKey() const { return key_; }
  const std::string& GetTypeName() const { return type_; }
  bool GetRequired() const { return required_; }
  bool GetSet() const { return set_; }
  std::string GetAsString() const { return value_; }
  std::string GetDefaultAsString() const { return default_; }
  bool SetFromString(const std::string& value) {
    value_ = value;
    return set_ = true;
  }
  void Reset() {
    value_ = default_;
    set_ = false;
  }
  ParamPtr Clone() const { return std::make_shared<Param>(*this); }

  template <typename T>
  bool Get(T& value) const {
    return Read(value_, value);
  }
  template <typename T>
  bool GetDefault(T& value) const {
    return Read(default_, value);
  }
  template <typename T>
  bool Set(const T& value) {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return SetFromString(out.str());
  }

  // Read a value from a text; false leaves it as it is, or at its type's zero.
  template <typename T>
  static bool Read(const std::string& text, T& value) {
    std::istringstream in(text);
    return static_cast<bool>(in >> value);
  }
  static bool Read(const std::string& text, std::string& value) {
    value = text;
    return true;
  }
  static bool Read(const std::string& text, bool& value);
  static bool Read(const std::string& text, double& value);
  static bool Read(const std::string& text, float& value);
  static bool Read(const std::string& text, int8_t& value);
  static bool Read(const std::string& text, uint8_t& value);

 private:
  std::string key_, type_, default_, value_;
  bool required_, set_;
};

}  // namespace sdf

#endif
