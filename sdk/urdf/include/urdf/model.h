#pragma once

#include <ros/node_handle.h>

#include <string>

#include "urdf_model/model.h"
#include "urdf_parser/urdf_parser.h"

namespace urdf {

/** Robot of a file, a text, or a parameter such as robot_description; the functions return false if it is invalid. */
class Model : public ModelInterface {
 public:
  bool initFile(const std::string& filename);
  bool initParam(const std::string& param);
  bool initParamWithNodeHandle(const std::string& param, const ros::NodeHandle& nh = ros::NodeHandle());
  bool initString(const std::string& xmlstring);
};
typedef std::shared_ptr<Model> ModelSharedPtr;
typedef std::shared_ptr<const Model> ModelConstSharedPtr;

}  // namespace urdf
