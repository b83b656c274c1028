#pragma once

#include <string>

#include "ros/forwards.h"

namespace ros {
namespace names {

/** Name without double and final slashes. */
std::string clean(const std::string& name);
/** Absolute name, remapped; throws InvalidNameException. NodeHandle resolves private names (`~`). */
std::string resolve(const std::string& name, bool remap = true);
std::string resolve(const std::string& ns, const std::string& name, bool remap = true);
std::string append(const std::string& left, const std::string& right);
std::string remap(const std::string& name);
bool validate(const std::string& name, std::string& error);
const M_string& getRemappings();
const M_string& getUnresolvedRemappings();
std::string parentNamespace(const std::string& name);

}  // namespace names
}  // namespace ros
