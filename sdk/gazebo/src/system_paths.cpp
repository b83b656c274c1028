#include <gazebo/common/SystemPaths.hh>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace gazebo {
namespace common {

namespace {

bool exists(const std::string& path) { return access(path.c_str(), F_OK) == 0; }

std::string variable(const char* name, const std::string& missing) {
  const char* value = std::getenv(name);
  return value && *value ? value : missing;
}

void append(std::list<std::string>& folders, const std::string& text) {
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(':', from), text.size());
    const std::string folder = text.substr(from, to - from);
    bool is_new = !folder.empty();
    for (const std::string& known : folders) is_new = is_new && known != folder;
    if (is_new) folders.push_back(folder);
    from = to + 1;
  }
}

}  // namespace

SystemPaths* SystemPaths::Instance() {
  static SystemPaths* const instance = new SystemPaths;
  return instance;
}

SystemPaths::SystemPaths() : suffixes_{"/models", "/worlds"} {
  append(gazebo_, variable("GAZEBO_RESOURCE_PATH", ""));
  append(models_, variable("GAZEBO_MODEL_PATH", ""));
  append(models_, variable("HOME", "") + "/.gazebo/models");
  append(plugins_, variable("GAZEBO_PLUGIN_PATH", ""));
}

std::string SystemPaths::GetLogPath() const { return variable("GAZEBO_LOG_PATH", variable("HOME", "") + "/.gazebo"); }
std::string SystemPaths::TmpPath() const { return variable("TMPDIR", "/tmp"); }
const std::list<std::string>& SystemPaths::GetGazeboPaths() { return gazebo_; }
const std::list<std::string>& SystemPaths::GetModelPaths() { return models_; }
const std::list<std::string>& SystemPaths::GetPluginPaths() { return plugins_; }

std::string SystemPaths::FindFileURI(const std::string& uri) {
  const std::size_t at = uri.find("://");
  if (at == std::string::npos) return FindFile(uri);
  const std::string scheme = uri.substr(0, at), path = uri.substr(at + 3);
  if (scheme == "file") return FindFile(path);
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  return scheme == "model" ? Find(models_, path, false) : "";
}

std::string SystemPaths::FindFile(const std::string& name, bool search_here) {
  if (name.empty()) return "";
  if (name.find("://") != std::string::npos) return FindFileURI(name);
  if (name[0] == '/') return exists(name) ? name : "";
  char here[4096];
  if (search_here && getcwd(here, sizeof(here)) && exists(std::string(here) + "/" + name))
    return std::string(here) + "/" + name;
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  return Find(gazebo_, name, true);
}

std::string SystemPaths::Find(const std::list<std::string>& folders, const std::string& name,
                              bool with_suffixes) const {
  for (const std::string& folder : folders) {
    if (exists(folder + "/" + name)) return folder + "/" + name;
    if (!with_suffixes) continue;
    for (const std::string& suffix : suffixes_)
      if (exists(folder + suffix + "/" + name)) return folder + suffix + "/" + name;
  }
  return "";
}

void SystemPaths::AddGazeboPaths(const std::string& folders) {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  append(gazebo_, folders);
}

void SystemPaths::AddSearchPathSuffix(const std::string& suffix) {
  if (suffix.empty()) return;
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  const std::string folder = suffix.back() == '/' ? suffix.substr(0, suffix.size() - 1) : suffix;
  suffixes_.push_back(folder[0] == '/' ? folder : "/" + folder);
}

}  // namespace common
}  // namespace gazebo
