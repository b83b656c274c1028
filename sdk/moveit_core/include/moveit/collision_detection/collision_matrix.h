#pragma once

#include <moveit_msgs/AllowedCollisionMatrix.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "moveit/macros/class_forward.h"

namespace collision_detection {

namespace AllowedCollision {
enum Type { NEVER, ALWAYS, CONDITIONAL };
}  // namespace AllowedCollision

MOVEIT_CLASS_FORWARD(AllowedCollisionMatrix)

/** Pairs of bodies that may, or may not, touch; a default is for all pairs of a body that have no entry. */
class AllowedCollisionMatrix {
 public:
  AllowedCollisionMatrix() {}
  explicit AllowedCollisionMatrix(const std::vector<std::string>& names, bool allowed = false);
  explicit AllowedCollisionMatrix(const moveit_msgs::AllowedCollisionMatrix& message);

  bool hasEntry(const std::string& name) const { return entries_.count(name) > 0; }
  bool hasEntry(const std::string& name1, const std::string& name2) const;
  /** False if there is no entry. */
  bool getEntry(const std::string& name1, const std::string& name2, AllowedCollision::Type& type) const;
  /** Entry of the pair, otherwise the default of one of them; false if there is neither. */
  bool getAllowedCollision(const std::string& name1, const std::string& name2, AllowedCollision::Type& type) const;
  void setEntry(const std::string& name1, const std::string& name2, bool allowed);
  /** Set the entries of a body with all that have some. */
  void setEntry(const std::string& name, bool allowed);
  void setEntry(const std::string& name, const std::vector<std::string>& other_names, bool allowed);
  void setEntry(const std::vector<std::string>& names1, const std::vector<std::string>& names2, bool allowed);
  void setEntry(bool allowed);
  void removeEntry(const std::string& name1, const std::string& name2);
  void removeEntry(const std::string& name);
  void setDefaultEntry(const std::string& name, bool allowed) { defaults_[name] = allowed; }
  bool getDefaultEntry(const std::string& name, AllowedCollision::Type& type) const;
  void getAllEntryNames(std::vector<std::string>& names) const;
  std::size_t getSize() const { return entries_.size(); }
  void clear();
  void getMessage(moveit_msgs::AllowedCollisionMatrix& message) const;
  void print(std::ostream& out) const;

 private:
  std::map<std::string, std::map<std::string, bool>> entries_;
  std::map<std::string, bool> defaults_;
};

}  // namespace collision_detection
