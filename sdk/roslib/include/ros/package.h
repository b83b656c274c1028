#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ros {
/** Packages on ROS_PACKAGE_PATH. */
namespace package {

typedef std::vector<std::string> V_string;
typedef std::map<std::string, std::string> M_string;

/** Folder of a package; "" if it is not found. */
std::string getPath(const std::string& package_name);
/** Names of all packages. */
bool getAll(V_string& packages);
/** Values of an attribute of <NAME> in the <export> of each package; `${prefix}` becomes the package's folder. */
void getPlugins(const std::string& name, const std::string& attribute, V_string& plugins, bool force_recrawl = false);
void getPlugins(const std::string& name, const std::string& attribute, M_string& plugins, bool force_recrawl = false);
void getPlugins(const std::string& name, const std::string& attribute,
                std::vector<std::pair<std::string, std::string> >& plugins, bool force_recrawl = false);

}  // namespace package
}  // namespace ros
