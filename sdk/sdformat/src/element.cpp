#include <algorithm>
#include <cstdlib>
#include <iostream>

#include <sdf/Element.hh>

namespace sdf {

namespace {

thread_local std::string last_missing;

bool read_double(const std::string& text, double& value) {
  const char* begin = text.c_str();
  char* end = nullptr;
  const double number = std::strtod(begin, &end);
  if (end == begin) return false;
  value = number;
  return true;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '"') result += "&quot;";
    else result += c;
  return result;
}

}  // namespace

std::string LastMissingElement() { return last_missing; }

bool Param::Read(const std::string& text, bool& value) {
  std::string word;
  std::istringstream(text) >> word;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word.empty()) return false;
  value = word == "true" || word == "1";
  return true;
}

bool Param::Read(const std::string& text, double& value) { return read_double(text, value); }

bool Param::Read(const std::string& text, float& value) {
  double number = 0.0;
  if (!read_double(text, number)) return false;
  value = static_cast<float>(number);
  return true;
}

bool Param::Read(const std::string& text, int8_t& value) {
  int number = 0;
  if (!Read(text, number)) return false;
  value = static_cast<int8_t>(number);
  return true;
}

bool Param::Read(const std::string& text, uint8_t& value) {
  int number = 0;
  if (!Read(text, number)) return false;
  value = static_cast<uint8_t>(number);
  return true;
}

Element::Element() {}

ParamPtr Element::GetAttribute(const std::string& key) const {
  for (const ParamPtr& attribute : attributes_)
    if (attribute->GetKey() == key) return attribute;
  return ParamPtr();
}

ParamPtr Element::GetAttribute(unsigned int index) const {
  return index < attributes_.size() ? attributes_[index] : ParamPtr();
}

bool Element::HasAttribute(const std::string& key) const { return GetAttribute(key) != nullptr; }

bool Element::GetAttributeSet(const std::string& key) const {
  const ParamPtr attribute = GetAttribute(key);
  return attribute && attribute->GetSet();
}

void Element::AddAttribute(const std::string& key, const std::string& type, const std::string& value, bool required,
                           const std::string&) {
  attributes_.push_back(std::make_shared<Param>(key, type, value, required));
}

void Element::AddValue(const std::string& type, const std::string& value, bool required, const std::string&) {
  value_ = std::make_shared<Param>(name_, type, value, required);
}

ElementPtr Element::FindElement(const std::string& name) const {
  for (const ElementPtr& child : children_)
    if (child->name_ == name) return child;
  return ElementPtr();
}

bool Element::HasElement(const std::string& name) const { return FindElement(name) != nullptr; }

ElementPtr Element::GetElement(const std::string& name) const {
  const ElementPtr found = FindElement(name);
  if (!found) last_missing = "<" + name_ + "> has no <" + name + ">";
  return found;
}

ElementPtr Element::GetElement(const std::string& name) { return static_cast<const Element*>(this)->GetElement(name); }

ElementPtr Element::GetFirstElement() const { return children_.empty() ? ElementPtr() : children_.front(); }

ElementPtr Element::GetNextElement(const std::string& name) const {
  const ElementPtr parent = parent_.lock();
  if (!parent) return ElementPtr();
  auto next = std::find_if(parent->children_.begin(), parent->children_.end(),
                           [this](const ElementPtr& child) { return child.get() == this; });
  if (next == parent->children_.end()) return ElementPtr();
  next = std::find_if(next + 1, parent->children_.end(),
                      [&name](const ElementPtr& child) { return name.empty() || child->name_ == name; });
  return next == parent->children_.end() ? ElementPtr() : *next;
}

std::set<std::string> Element::GetElementTypeNames() const {
  std::set<std::string> names;
  for (const ElementPtr& child : children_) names.insert(child->name_);
  return names;
}

ElementPtr Element::AddElement(const std::string& name) {
  const ElementPtr child = std::make_shared<Element>();
  child->SetName(name);
  InsertElement(child, true);
  return child;
}

void Element::InsertElement(ElementPtr element) { InsertElement(element, true); }

void Element::InsertElement(ElementPtr element, bool set_parent) {
  if (set_parent) element->SetParent(shared_from_this());
  children_.push_back(element);
}

void Element::RemoveChild(ElementPtr child) {
  children_.erase(std::remove(children_.begin(), children_.end(), child), children_.end());
}

void Element::RemoveFromParent() {
  if (const ElementPtr parent = parent_.lock()) parent->RemoveChild(shared_from_this());
  parent_.reset();
}

void Element::Clear() {
  children_.clear();
  attributes_.clear();
  value_.reset();
}

ElementPtr Element::Clone() const {
  const ElementPtr copy = std::make_shared<Element>();
  copy->name_ = name_;
  for (const ParamPtr& attribute : attributes_) copy->attributes_.push_back(attribute->Clone());
  if (value_) copy->value_ = value_->Clone();
  for (const ElementPtr& child : children_) copy->InsertElement(child->Clone(), true);
  return copy;
}

void Element::Copy(const ElementPtr element) {
  const ElementPtr copy = element->Clone();
  name_ = copy->name_;
  attributes_ = copy->attributes_;
  value_ = copy->value_;
  children_.clear();
  for (const ElementPtr& child : copy->children_) InsertElement(child, true);
}

std::string Element::ToString(const std::string& prefix) const {
  std::string text = prefix + "<" + name_;
  for (const ParamPtr& attribute : attributes_)
    text += " " + attribute->GetKey() + "=\"" + escaped(attribute->GetAsString()) + "\"";
  const std::string value = value_ ? escaped(value_->GetAsString()) : std::string();
  if (children_.empty()) return text + (value.empty() ? "/>\n" : ">" + value + "</" + name_ + ">\n");
  text += ">\n";
  for (const ElementPtr& child : children_) text += child->ToString(prefix + "  ");
  return text + prefix + "</" + name_ + ">\n";
}

void Element::PrintValues(const std::string prefix) const { std::cout << ToString(prefix); }

ParamPtr Element::Find(const std::string& key) const {
  if (key.empty()) return value_;
  if (const ParamPtr attribute = GetAttribute(key)) return attribute;
  const ElementPtr child = FindElement(key);
  return child ? child->value_ : ParamPtr();
}

void Element::ReportUnreadable(const std::string& key, const Param& param) const {
  std::cerr << "<" << (key.empty() ? name_ : key) << ">: " << param.GetAsString()
            << " is not of the type that is read\n";
}

}  // namespace sdf
