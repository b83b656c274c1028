#include "ros/names.h"

#include <cctype>

#include "node.h"
#include "ros/this_node.h"

namespace ros {
namespace names {
namespace {

M_string resolved_remappings, unresolved_remappings;

bool isAllowed(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/'; }

}  // namespace

void init(const M_string& remappings) {
  resolved_remappings.clear();
  unresolved_remappings.clear();
  for (const auto& entry : remappings) {
    const std::string& left = entry.first;
    if (left.empty() || left[0] == '_' || left == this_node::getName()) continue;
    resolved_remappings[resolve(left, false)] = resolve(entry.second, false);
    unresolved_remappings[left] = entry.second;
  }
}

bool validate(const std::string& name, std::string& error) {
  if (name.empty()) return true;
  const char first = name[0];
  if (!std::isalpha(static_cast<unsigned char>(first)) && first != '/' && first != '~') {
    error = std::string("Character [") + first + "] is not valid as the first character in Graph Resource Name [" +
            name + "].  Valid characters are a-z, A-Z, / and in some cases ~.";
    return false;
  }
  for (size_t i = 1; i < name.size(); ++i)
    if (!isAllowed(name[i])) {
      error = std::string("Character [") + name[i] + "] at element [" + std::to_string(i) +
              "] is not valid in Graph Resource Name [" + name + "].  Valid characters are a-z, A-Z, 0-9, / and _.";
      return false;
    }
  return true;
}

std::string clean(const std::string& name) {
  std::string result;
  for (const char c : name)
    if (c != '/' || result.empty() || result.back() != '/') result += c;
  if (!result.empty() && result.back() == '/') result.pop_back();
  return result;
}

std::string append(const std::string& left, const std::string& right) { return clean(left + "/" + right); }

std::string remap(const std::string& name) {
  const M_string::const_iterator found = resolved_remappings.find(resolve(name, false));
  return found == resolved_remappings.end() ? name : found->second;
}

std::string resolve(const std::string& name, bool remap) { return resolve(this_node::getNamespace(), name, remap); }

std::string resolve(const std::string& ns, const std::string& name, bool remap) {
  std::string error;
  if (!validate(name, error)) throw InvalidNameException(error);
  if (name.empty()) {
    if (ns.empty()) return "/";
    return ns[0] == '/' ? ns : append("/", ns);
  }
  std::string copy = name;
  if (copy[0] == '~') copy = append(this_node::getName(), copy.substr(1));
  if (copy[0] != '/') copy = append("/", append(ns, copy));
  copy = clean(copy);
  return remap ? names::remap(copy) : copy;
}

const M_string& getRemappings() { return resolved_remappings; }
const M_string& getUnresolvedRemappings() { return unresolved_remappings; }

std::string parentNamespace(const std::string& name) {
  std::string error;
  if (!validate(name, error)) throw InvalidNameException(error);
  if (name.empty()) return "";
  if (name == "/") return "/";
  const std::string stripped = name.back() == '/' ? name.substr(0, name.size() - 1) : name;
  const size_t last = stripped.rfind('/');
  if (last == std::string::npos) return "";
  return last == 0 ? "/" : stripped.substr(0, last);
}

}  // namespace names
}  // namespace ros
