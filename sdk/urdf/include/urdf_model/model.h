#pragma once

#include <map>
#include <string>
#include <vector>

#include "urdf_model/link.h"

namespace urdf {

/** Links and joints of a robot, by their names. */
class ModelInterface {
 public:
  std::map<std::string, LinkSharedPtr> links_;
  std::map<std::string, JointSharedPtr> joints_;
  std::map<std::string, MaterialSharedPtr> materials_;
  std::string name_;
  LinkSharedPtr root_link_;

  LinkConstSharedPtr getRoot() const { return root_link_; }
  LinkConstSharedPtr getLink(const std::string& name) const {
    const auto found = links_.find(name);
    return found == links_.end() ? LinkConstSharedPtr() : found->second;
  }
  JointConstSharedPtr getJoint(const std::string& name) const {
    const auto found = joints_.find(name);
    return found == joints_.end() ? JointConstSharedPtr() : found->second;
  }
  const std::string& getName() const { return name_; }
  void getLinks(std::vector<LinkSharedPtr>& links) const {
    for (const auto& entry : links_) links.push_back(entry.second);
  }
  void getLink(const std::string& name, LinkSharedPtr& link) const {
    const auto found = links_.find(name);
    link = found == links_.end() ? LinkSharedPtr() : found->second;
  }
  MaterialSharedPtr getMaterial(const std::string& name) const {
    const auto found = materials_.find(name);
    return found == materials_.end() ? MaterialSharedPtr() : found->second;
  }
  void clear() { *this = ModelInterface(); }
};

}  // namespace urdf
