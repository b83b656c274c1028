// Element of SDF: attributes, a value, and elements inside.
#ifndef SDF_ELEMENT_HH_
#define SDF_ELEMENT_HH_

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sdf/Param.hh>
#include <sdf/Types.hh>

namespace sdf {

class Element : public std::enable_shared_from_this<Element> {
 public:
  Element();

  const std::string& GetName() const { return name_; }
  void SetName(const std::string& name) { name_ = name; }
  ElementPtr GetParent() const { return parent_.lock(); }
  void SetParent(const ElementPtr& parent) { parent_ = parent; }
  std::string GetDescription() const { return std::string(); }
  std::string GetInclude() const { return std::string(); }
  std::string ReferenceSDF() const { return std::string(); }

  // Whether an attribute exists.
  bool HasAttribute(const std::string& key) const;
  size_t GetAttributeCount() const { return attributes_.size(); }
  // Null where there is none.
  ParamPtr GetAttribute(const std::string& key) const;
  ParamPtr GetAttribute(unsigned int index) const;
  bool GetAttributeSet(const std::string& key) const;
  void AddAttribute(const std::string& key, const std::string& type, const std::string& value, bool required,
                    const std::string& description = "");

  // Null where there is none.
  ParamPtr GetValue() const { return value_; }
  void AddValue(const std::string& type, const std::string& value, bool required, const std::string& description = "");

  bool HasElement(const std::string& name) const;
  // First child of this name; as in Gazebo, null where a plugin's parameters have none.
  ElementPtr GetElement(const std::string& name);
  ElementPtr GetElement(const std::string& name) const;
  ElementPtr FindElement(const std::string& name) const;
  ElementPtr GetFirstElement() const;
  // Next element inside the same parent; with a name, the next of it.
  ElementPtr GetNextElement(const std::string& name = "") const;
  std::set<std::string> GetElementTypeNames() const;
  bool HasElementDescription(const std::string& name) const { return HasElement(name); }
  ElementPtr AddElement(const std::string& name);
  void InsertElement(ElementPtr element);
  void InsertElement(ElementPtr element, bool set_parent);
  void RemoveChild(ElementPtr child);
  void RemoveFromParent();
  void ClearElements() { children_.clear(); }
  void Clear();
  void Reset() { Clear(); }
  ElementPtr Clone() const;
  void Copy(const ElementPtr element);

  std::string ToString(const std::string& prefix) const;
  void PrintValues(const std::string prefix) const;

  // Value of this element, or of an attribute or child of it; the type's zero where there is none.
  template <typename T>
  T Get(const std::string& key = "") const {
    return Get<T>(key, T()).first;
  }
  // Value, and whether there is one.
  template <typename T>
  std::pair<T, bool> Get(const std::string& key, const T& default_value) const {
    const ParamPtr param = Find(key);
    std::pair<T, bool> result(default_value, false);
    if (param) {
      T value = T();
      result.second = param->Get(value);
      if (result.second) result.first = value;
      else ReportUnreadable(key, *param);
    }
    return result;
  }
  template <typename T>
  bool Get(const std::string& key, T& value, const T& default_value) const {
    const std::pair<T, bool> result = Get<T>(key, default_value);
    value = result.first;
    return result.second;
  }
  template <typename T>
  bool Set(const T& value) {
    if (!value_) AddValue("string", "", false);
    return value_->Set(value);
  }

  // Names of SDF's first years.
  double GetValueDouble(const std::string& key = "") const { return Get<double>(key); }
  float GetValueFloat(const std::string& key = "") const { return Get<float>(key); }
  int GetValueInt(const std::string& key = "") const { return Get<int>(key); }
  unsigned int GetValueUInt(const std::string& key = "") const { return Get<unsigned int>(key); }
  bool GetValueBool(const std::string& key = "") const { return Get<bool>(key); }
  std::string GetValueString(const std::string& key = "") const { return Get<std::string>(key); }

 private:
  ParamPtr Find(const std::string& key) const;
  void ReportUnreadable(const std::string& key, const Param& param) const;

  std::string name_;
  ElementWeakPtr parent_;
  Param_V attributes_;
  ParamPtr value_;
  ElementPtr_V children_;
};

// What GetElement last did not find in a thread, for messages.
std::string LastMissingElement();

}  // namespace sdf

#endif
