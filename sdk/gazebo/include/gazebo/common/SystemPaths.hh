// Folders of Gazebo's variables, and the files that they have.
#ifndef GAZEBO_COMMON_SYSTEMPATHS_HH_
#define GAZEBO_COMMON_SYSTEMPATHS_HH_

#include <list>
#include <mutex>
#include <string>

namespace gazebo {
namespace common {

class SystemPaths {
 public:
  static SystemPaths* Instance();

  // Where Gazebo keeps its logs: GAZEBO_LOG_PATH, or ~/.gazebo.
  std::string GetLogPath() const;
  std::string TmpPath() const;
  // Of GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH and GAZEBO_PLUGIN_PATH.
  const std::list<std::string>& GetGazeboPaths();
  const std::list<std::string>& GetModelPaths();
  const std::list<std::string>& GetPluginPaths();

  // Of file://, model:// and plain names; empty if there is none.
  std::string FindFileURI(const std::string& uri);
  // Of the working folder, of GetGazeboPaths or of their subfolders that AddSearchPathSuffix named.
  std::string FindFile(const std::string& name, bool search_here = true);

  // Folders, with colons between.
  void AddGazeboPaths(const std::string& folders);
  void AddSearchPathSuffix(const std::string& suffix);

 private:
  SystemPaths();
  std::string Find(const std::list<std::string>& folders, const std::string& name, bool with_suffixes) const;

  std::recursive_mutex mutex_;
  std::list<std::string> gazebo_, models_, plugins_, suffixes_;
};

}  // namespace common
}  // namespace gazebo

#endif
