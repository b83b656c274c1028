// Files by their names, as functions.
#ifndef GAZEBO_COMMON_COMMONIFACE_HH_
#define GAZEBO_COMMON_COMMONIFACE_HH_

#include <string>

#include <gazebo/common/SystemPaths.hh>

namespace gazebo {
namespace common {

inline void add_search_path_suffix(const std::string& suffix) { SystemPaths::Instance()->AddSearchPathSuffix(suffix); }
inline std::string find_file(const std::string& name) { return SystemPaths::Instance()->FindFile(name); }
inline std::string find_file(const std::string& name, bool search_here) {
  return SystemPaths::Instance()->FindFile(name, search_here);
}
// The folder of a file that find_file finds.
inline std::string find_file_path(const std::string& name) {
  const std::string path = find_file(name);
  return path.substr(0, path.rfind('/') == std::string::npos ? 0 : path.rfind('/'));
}

}  // namespace common
}  // namespace gazebo

#endif
