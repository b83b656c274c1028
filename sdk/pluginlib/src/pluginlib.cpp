#include <ros/console.h>
#include <ros/package.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "pluginlib/class_loader.hpp"

namespace pluginlib {
namespace {

namespace fs = std::filesystem;
using boost::property_tree::ptree;

constexpr size_t kMaxDepth = 100;  // the reader calls itself for each element

/** Read a file of XML; throws InvalidXMLException. */
ptree readXml(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InvalidXMLException("XML Document '" + path + "' cannot be opened");
  std::stringstream text;
  text << file.rdbuf();
  const std::string xml = text.str();
  size_t depth = 0;
  for (size_t i = 0; i + 1 < xml.size() && depth <= kMaxDepth; ++i) {
    if (xml[i] == '<' && xml[i + 1] != '?' && xml[i + 1] != '!') depth += xml[i + 1] == '/' ? -1 : 1;
    if (xml[i] == '/' && xml[i + 1] == '>') --depth;
    if (depth > xml.size()) depth = 0;
  }
  if (depth > kMaxDepth) throw InvalidXMLException("XML Document '" + path + "' has too many elements in elements");
  ptree tree;
  try {
    boost::property_tree::read_xml(text, tree, boost::property_tree::xml_parser::trim_whitespace);
  } catch (const boost::property_tree::xml_parser_error& error) {
    throw InvalidXMLException("XML Document '" + path + "' has line " + std::to_string(error.line()) + ": " +
                              error.message());
  }
  return tree;
}

std::string attribute(const ptree& element, const std::string& name) {
  return element.get<std::string>(ptree::path_type("<xmlattr>/" + name, '/'), "");
}

/** True for a package of the development kit, which is not on ROS_PACKAGE_PATH. */
bool isOfKit(const std::string& package) {
  return std::string(" " TRUNDLE_PACKAGES " ").find(" " + package + " ") != std::string::npos;
}

/** Folders of libraries: of the sourced workspaces, and of the one that a package is in. */
std::vector<fs::path> libraryFolders(const std::string& package) {
  std::vector<fs::path> folders;
  const char* const variable = std::getenv("CMAKE_PREFIX_PATH");
  std::stringstream prefixes(variable ? variable : "");
  for (std::string prefix; std::getline(prefixes, prefix, ':');)
    if (!prefix.empty()) folders.emplace_back(fs::path(prefix) / "lib");
  const fs::path folder = ros::package::getPath(package);
  for (fs::path above = folder; !above.empty() && above != above.parent_path(); above = above.parent_path())
    for (const char* const space : {"devel/lib", "install/lib", "lib"}) folders.push_back(above / space);
  folders.push_back(folder);
  return folders;
}

}  // namespace

Plugins::Plugins(const std::string& package, const std::string& base_class, const std::string& attribute,
                 const std::vector<std::string>& xml_paths)
    : package_(package), base_class_(base_class), attribute_(attribute), given_paths_(xml_paths) {
  refreshDeclaredClasses();
  if (xml_paths_.empty() && ros::package::getPath(package).empty() && !isOfKit(package))
    throw ClassLoaderException("Unable to find package: " + package +
                               ", which is not on ROS_PACKAGE_PATH, and for which no package exports plugins");
}

void Plugins::refreshDeclaredClasses() {
  classes_.clear();
  xml_paths_.clear();
  std::vector<std::pair<std::string, std::string> > files;
  for (const std::string& path : given_paths_) files.emplace_back(std::string(), path);
  if (files.empty()) ros::package::getPlugins(package_, attribute_, files, true);
  for (const auto& file : files) {
    xml_paths_.push_back(file.second);
    try {
      read(file.first, file.second);
    } catch (const InvalidXMLException& error) {
      ROS_ERROR_NAMED("pluginlib.ClassLoader", "Skipped loading plugin with error: %s.", error.what());
    }
  }
}

void Plugins::read(const std::string& package, const std::string& xml) {
  const ptree document = readXml(xml);
  std::vector<const ptree*> libraries;
  for (const auto& root : document) {
    if (root.first == "library") libraries.push_back(&root.second);
    if (root.first != "class_libraries") continue;
    for (const auto& child : root.second)
      if (child.first == "library") libraries.push_back(&child.second);
  }
  if (libraries.empty())
    throw InvalidXMLException("XML Document '" + xml + "' has no root element <library> or <class_libraries>");
  for (const ptree* const library : libraries)
    for (const auto& child : *library) {
      if (child.first != "class") continue;
      PluginClass found;
      found.derived_class = attribute(child.second, "type");
      found.lookup_name = attribute(child.second, "name");
      if (found.lookup_name.empty()) found.lookup_name = found.derived_class;
      found.base_class = attribute(child.second, "base_class_type");
      found.description = child.second.get<std::string>("description", "No 'description' tag for this plugin.");
      found.library = attribute(*library, "path");
      found.package = package;
      found.xml = xml;
      if (found.base_class == base_class_) classes_.emplace(found.lookup_name, found);
    }
}

std::vector<std::string> Plugins::getDeclaredClasses() const {
  std::vector<std::string> names;
  for (const auto& entry : classes_) names.push_back(entry.first);
  return names;
}

std::vector<std::string> Plugins::getRegisteredLibraries() const {
  std::set<std::string> libraries;
  for (const auto& entry : classes_) libraries.insert(entry.second.library);
  return std::vector<std::string>(libraries.begin(), libraries.end());
}

PluginClass Plugins::get(const std::string& lookup_name) const {
  const auto found = classes_.find(lookup_name);
  return found == classes_.end() ? PluginClass() : found->second;
}

std::string Plugins::unknown(const std::string& lookup_name) const {
  std::string names;
  for (const auto& entry : classes_) names += " " + entry.first;
  return "According to the loaded plugin descriptions the class " + lookup_name + " with base class type " +
         base_class_ + " does not exist. Declared types are " + names;
}

std::string Plugins::getClassLibraryPath(const std::string& lookup_name) const {
  const PluginClass found = get(lookup_name);
  if (found.library.empty()) return "";
  const fs::path named(found.library);
  if (named.is_absolute() && fs::exists(named)) return named.string();
  for (const fs::path& folder : libraryFolders(found.package))
    for (const fs::path& path : {named, named.filename()})
      for (const std::string& suffix : {class_loader::systemLibrarySuffix(), std::string()}) {
        const fs::path candidate = folder / (path.string() + suffix);
        std::error_code error;
        if (fs::is_regular_file(candidate, error)) return candidate.string();
      }
  return "";
}

bool Plugins::isClassLoaded(const std::string& lookup_name) const {
  const auto found = loads_.find(get(lookup_name).library);
  return found != loads_.end() && found->second > 0;
}

void Plugins::loadLibraryForClass(const std::string& lookup_name) {
  if (!isClassAvailable(lookup_name)) throw LibraryLoadException(unknown(lookup_name));
  const std::string path = getClassLibraryPath(lookup_name);
  if (path.empty())
    throw LibraryLoadException("Could not find library corresponding to plugin " + lookup_name +
                               ". Make sure that the plugin description " + get(lookup_name).xml +
                               " has the correct name of the library, and that catkin_make has built it.");
  try {
    class_loader::impl::load(path);
  } catch (const class_loader::LibraryLoadException& error) {
    throw LibraryLoadException("Failed to load library " + path + ". Error string: " + error.what());
  }
  ++loads_[get(lookup_name).library];
}

int Plugins::unloadLibraryForClass(const std::string& lookup_name) {
  if (!isClassAvailable(lookup_name) || !isClassLoaded(lookup_name))
    throw LibraryUnloadException("Cannot unload library of class " + lookup_name + ", which was never loaded.");
  return --loads_[get(lookup_name).library];
}

void* Plugins::create(const std::string& lookup_name, const std::type_info& base) {
  if (!isClassLoaded(lookup_name)) loadLibraryForClass(lookup_name);
  const std::string path = getClassLibraryPath(lookup_name), type = getClassType(lookup_name);
  const class_loader::impl::Create create = class_loader::impl::findClass(path, type, base);
  if (!create)
    throw CreateClassException("library " + path + " does not export class " + type +
                               " for this base class: PLUGINLIB_EXPORT_CLASS is missing, or names other classes.");
  return create();
}

}  // namespace pluginlib
