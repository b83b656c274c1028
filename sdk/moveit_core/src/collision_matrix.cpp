#include "moveit/collision_detection/collision_matrix.h"

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace collision_detection {

AllowedCollisionMatrix::AllowedCollisionMatrix(const std::vector<std::string>& names, bool allowed) {
  setEntry(names, names, allowed);
}

AllowedCollisionMatrix::AllowedCollisionMatrix(const moveit_msgs::AllowedCollisionMatrix& message) {
  for (std::size_t i = 0; i < std::min(message.entry_names.size(), message.entry_values.size()); ++i) {
    const auto& row = message.entry_values[i].enabled;
    for (std::size_t j = 0; j < std::min(message.entry_names.size(), row.size()); ++j)
      entries_[message.entry_names[i]][message.entry_names[j]] = row[j];
  }
  for (std::size_t i = 0; i < std::min(message.default_entry_names.size(), message.default_entry_values.size()); ++i)
    defaults_[message.default_entry_names[i]] = message.default_entry_values[i];
}

bool AllowedCollisionMatrix::hasEntry(const std::string& name1, const std::string& name2) const {
  const auto row = entries_.find(name1);
  return row != entries_.end() && row->second.count(name2) > 0;
}

bool AllowedCollisionMatrix::getEntry(const std::string& name1, const std::string& name2,
                                      AllowedCollision::Type& type) const {
  if (!hasEntry(name1, name2)) return false;
  type = entries_.at(name1).at(name2) ? AllowedCollision::ALWAYS : AllowedCollision::NEVER;
  return true;
}

bool AllowedCollisionMatrix::getDefaultEntry(const std::string& name, AllowedCollision::Type& type) const {
  const auto found = defaults_.find(name);
  if (found == defaults_.end()) return false;
  type = found->second ? AllowedCollision::ALWAYS : AllowedCollision::NEVER;
  return true;
}

bool AllowedCollisionMatrix::getAllowedCollision(const std::string& name1, const std::string& name2,
                                                 AllowedCollision::Type& type) const {
  if (getEntry(name1, name2, type)) return true;
  AllowedCollision::Type first = AllowedCollision::ALWAYS, second = AllowedCollision::ALWAYS;
  const bool has_first = getDefaultEntry(name1, first), has_second = getDefaultEntry(name2, second);
  if (!has_first && !has_second) return false;
  const bool is_never = first == AllowedCollision::NEVER || second == AllowedCollision::NEVER;
  type = is_never ? AllowedCollision::NEVER : AllowedCollision::ALWAYS;
  return true;
}

void AllowedCollisionMatrix::setEntry(const std::string& name1, const std::string& name2, bool allowed) {
  entries_[name1][name2] = entries_[name2][name1] = allowed;
}

void AllowedCollisionMatrix::setEntry(const std::string& name, bool allowed) {
  std::vector<std::string> names;
  getAllEntryNames(names);
  setEntry(name, names, allowed);
}

void AllowedCollisionMatrix::setEntry(const std::string& name, const std::vector<std::string>& other_names,
                                      bool allowed) {
  for (const std::string& other : other_names)
    if (other != name) setEntry(name, other, allowed);
}

void AllowedCollisionMatrix::setEntry(const std::vector<std::string>& names1, const std::vector<std::string>& names2,
                                      bool allowed) {
  for (const std::string& name : names1) setEntry(name, names2, allowed);
}

void AllowedCollisionMatrix::setEntry(bool allowed) {
  for (auto& row : entries_)
    for (auto& entry : row.second) entry.second = allowed;
}

void AllowedCollisionMatrix::removeEntry(const std::string& name1, const std::string& name2) {
  for (const auto& pair : {std::make_pair(name1, name2), std::make_pair(name2, name1)}) {
    const auto row = entries_.find(pair.first);
    if (row != entries_.end()) row->second.erase(pair.second);
  }
}

void AllowedCollisionMatrix::removeEntry(const std::string& name) {
  entries_.erase(name);
  for (auto& row : entries_) row.second.erase(name);
}

void AllowedCollisionMatrix::getAllEntryNames(std::vector<std::string>& names) const {
  names.clear();
  for (const auto& row : entries_) names.push_back(row.first);
}

void AllowedCollisionMatrix::clear() {
  entries_.clear();
  defaults_.clear();
}

void AllowedCollisionMatrix::getMessage(moveit_msgs::AllowedCollisionMatrix& message) const {
  message = moveit_msgs::AllowedCollisionMatrix();
  getAllEntryNames(message.entry_names);
  for (const std::string& name : message.entry_names) {
    moveit_msgs::AllowedCollisionEntry row;
    for (const std::string& other : message.entry_names) {
      AllowedCollision::Type type = AllowedCollision::NEVER;
      row.enabled.push_back(getAllowedCollision(name, other, type) && type == AllowedCollision::ALWAYS);
    }
    message.entry_values.push_back(row);
  }
  for (const auto& entry : defaults_) {
    message.default_entry_names.push_back(entry.first);
    message.default_entry_values.push_back(entry.second);
  }
}

void AllowedCollisionMatrix::print(std::ostream& out) const {
  for (const auto& row : entries_) {
    out << std::setw(30) << row.first << ':';
    for (const auto& entry : row.second) out << ' ' << entry.first << (entry.second ? "=1" : "=0");
    out << '\n';
  }
}

}  // namespace collision_detection
