#include "urdf/model.h"

#include <ros/console.h>

namespace urdf {
namespace {

bool take(ModelInterface& model, const ModelInterfaceSharedPtr& read) {
  if (!read) return false;
  model = *read;
  return true;
}

}  // namespace

bool Model::initFile(const std::string& filename) { return take(*this, parseURDFFile(filename)); }

bool Model::initString(const std::string& xmlstring) { return take(*this, parseURDF(xmlstring)); }

bool Model::initParam(const std::string& param) { return initParamWithNodeHandle(param); }

bool Model::initParamWithNodeHandle(const std::string& param, const ros::NodeHandle& nh) {
  std::string name, text;
  if (!nh.searchParam(param, name)) {
    ROS_ERROR("Could not find parameter %s on parameter server", param.c_str());
    return false;
  }
  if (!nh.getParam(name, text)) {
    ROS_ERROR("Could not read parameter %s on parameter server", name.c_str());
    return false;
  }
  return initString(text);
}

}  // namespace urdf
