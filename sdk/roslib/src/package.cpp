#include "ros/package.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>

namespace ros {
namespace package {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 8;

std::string readFile(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/** Text between two words, stripped; "" if there is none. */
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const size_t start = text.find(before);
  const size_t end = start == std::string::npos ? start : text.find(after, start + before.size());
  if (end == std::string::npos) return "";
  const std::string found = text.substr(start + before.size(), end - start - before.size());
  const size_t first = found.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : found.substr(first, found.find_last_not_of(" \t\r\n") - first + 1);
}

std::string nameOf(const fs::path& manifest) { return between(readFile(manifest), "<name>", "</name>"); }

void crawl(const fs::path& folder, int depth, M_string& found) {
  std::error_code error;
  if (fs::exists(folder / "CATKIN_IGNORE", error)) return;
  if (fs::exists(folder / "package.xml", error)) {
    found.emplace(nameOf(folder / "package.xml"), folder.string());  // the first package of a name on the path wins
    return;
  }
  if (depth == kMaxDepth) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error) && entry.path().filename().string()[0] != '.') crawl(entry.path(), depth + 1, found);
}

/** Name → folder of all packages, found once. */
const M_string& packages(bool again = false) {
  static std::mutex mutex;
  static M_string* found = nullptr;
  const std::lock_guard<std::mutex> lock(mutex);
  if (found && !again) return *found;
  found = new M_string;  // not freed, as other threads may still read the old map
  const char* const variable = std::getenv("ROS_PACKAGE_PATH");
  std::stringstream path(variable ? variable : "");
  for (std::string folder; std::getline(path, folder, ':');)
    if (!folder.empty()) crawl(folder, 0, *found);
  found->erase("");
  return *found;
}

}  // namespace

std::string getPath(const std::string& package_name) {
  const auto found = packages().find(package_name);
  return found == packages().end() ? "" : found->second;
}

bool getAll(V_string& names) {
  for (const auto& entry : packages()) names.push_back(entry.first);
  return true;
}

void getPlugins(const std::string& name, const std::string& attribute,
                std::vector<std::pair<std::string, std::string> >& plugins, bool force_recrawl) {
  for (const auto& entry : packages(force_recrawl)) {
    const std::string text = readFile(fs::path(entry.second) / "package.xml");
    const std::string exported = between(text, "<export>", "</export>");
    for (size_t at = 0; (at = exported.find("<" + name + " ", at)) != std::string::npos; ++at) {
      const std::string tag = exported.substr(at, exported.find('>', at) - at);
      std::string value = between(tag, attribute + "=\"", "\"");
      if (value.empty()) value = between(tag, attribute + "='", "'");
      if (value.empty()) continue;
      for (size_t k; (k = value.find("${prefix}")) != std::string::npos;) value.replace(k, 9, entry.second);
      plugins.emplace_back(entry.first, value);
    }
  }
}

void getPlugins(const std::string& name, const std::string& attribute, V_string& plugins, bool force_recrawl) {
  std::vector<std::pair<std::string, std::string> > pairs;
  getPlugins(name, attribute, pairs, force_recrawl);
  for (const auto& pair : pairs) plugins.push_back(pair.second);
}

void getPlugins(const std::string& name, const std::string& attribute, M_string& plugins, bool force_recrawl) {
  std::vector<std::pair<std::string, std::string> > pairs;
  getPlugins(name, attribute, pairs, force_recrawl);
  plugins.insert(pairs.begin(), pairs.end());
}

}  // namespace package
}  // namespace ros
