#include <ros/console.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fstream>
#include <locale>
#include <sstream>

#include "urdf_parser/shallow_xml.h"
#include "urdf_parser/urdf_parser.h"

namespace urdf {
namespace {

using boost::property_tree::ptree;

std::vector<double> numbers(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::vector<double> result;
  for (double value = 0.0; stream >> value;) result.push_back(value);
  if (!stream.eof()) throw ParseError("'" + text + "' is no list of numbers");
  return result;
}

std::string attribute(const ptree& element, const std::string& name, const std::string& fallback = "") {
  return element.get<std::string>(ptree::path_type("<xmlattr>/" + name, '/'), fallback);
}
std::string required(const ptree& element, const std::string& name, const std::string& of) {
  const std::string value = attribute(element, name);
  if (value.empty()) throw ParseError(of + " lacks the attribute " + name);
  return value;
}
double number(const ptree& element, const std::string& name, double fallback) {
  const std::string text = attribute(element, name);
  if (text.empty()) return fallback;
  const std::vector<double> values = numbers(text);
  if (values.size() != 1) throw ParseError(name + "=\"" + text + "\" is no number");
  return values[0];
}
Vector3 vector(const std::string& text) {
  Vector3 v;
  v.init(text);
  return v;
}

Pose pose(const ptree& parent) {
  Pose result;
  const auto origin = parent.get_child_optional("origin");
  if (!origin) return result;
  const std::string xyz = attribute(*origin, "xyz"), rpy = attribute(*origin, "rpy");
  if (!xyz.empty()) result.position.init(xyz);
  if (!rpy.empty()) result.rotation.init(rpy);
  return result;
}

GeometrySharedPtr geometry(const ptree& parent, const std::string& of) {
  const auto element = parent.get_child_optional("geometry");
  if (!element) throw ParseError(of + " has no <geometry>");
  for (const auto& shape : *element) {
    if (shape.first == "box") {
      const auto box = std::make_shared<Box>();
      box->dim.init(required(shape.second, "size", "<box> of " + of));
      return box;
    }
    if (shape.first == "sphere") {
      const auto sphere = std::make_shared<Sphere>();
      sphere->radius = number(shape.second, "radius", 0.0);
      return sphere;
    }
    if (shape.first == "cylinder") {
      const auto cylinder = std::make_shared<Cylinder>();
      cylinder->length = number(shape.second, "length", 0.0);
      cylinder->radius = number(shape.second, "radius", 0.0);
      return cylinder;
    }
    if (shape.first == "mesh") {
      const auto mesh = std::make_shared<Mesh>();
      mesh->filename = required(shape.second, "filename", "<mesh> of " + of);
      const std::string scale = attribute(shape.second, "scale");
      if (!scale.empty()) mesh->scale.init(scale);
      return mesh;
    }
  }
  throw ParseError(of + " has a <geometry> without box, sphere, cylinder or mesh");
}

MaterialSharedPtr material(const ptree& element) {
  const auto result = std::make_shared<Material>();
  result->name = attribute(element, "name");
  if (const auto texture = element.get_child_optional("texture"))
    result->texture_filename = attribute(*texture, "filename");
  if (const auto color = element.get_child_optional("color")) {
    const std::vector<double> rgba = numbers(attribute(*color, "rgba"));
    if (rgba.size() != 4) throw ParseError("the color of material '" + result->name + "' has no 4 numbers");
    result->color.r = static_cast<float>(rgba[0]);
    result->color.g = static_cast<float>(rgba[1]);
    result->color.b = static_cast<float>(rgba[2]);
    result->color.a = static_cast<float>(rgba[3]);
  }
  return result;
}

InertialSharedPtr inertial(const ptree& element) {
  const auto result = std::make_shared<Inertial>();
  result->origin = pose(element);
  if (const auto mass = element.get_child_optional("mass")) result->mass = number(*mass, "value", 0.0);
  if (const auto inertia = element.get_child_optional("inertia")) {
    result->ixx = number(*inertia, "ixx", 0.0);
    result->ixy = number(*inertia, "ixy", 0.0);
    result->ixz = number(*inertia, "ixz", 0.0);
    result->iyy = number(*inertia, "iyy", 0.0);
    result->iyz = number(*inertia, "iyz", 0.0);
    result->izz = number(*inertia, "izz", 0.0);
  }
  return result;
}

LinkSharedPtr link(const ptree& element, std::map<std::string, MaterialSharedPtr>& materials) {
  const auto result = std::make_shared<Link>();
  result->name = required(element, "name", "a <link>");
  const std::string of = "link '" + result->name + "'";
  for (const auto& child : element) {
    if (child.first == "inertial") result->inertial = inertial(child.second);
    if (child.first == "visual") {
      const auto visual = std::make_shared<Visual>();
      visual->name = attribute(child.second, "name");
      visual->origin = pose(child.second);
      visual->geometry = geometry(child.second, "a visual of " + of);
      if (const auto shade = child.second.get_child_optional("material")) {
        visual->material = material(*shade);
        visual->material_name = visual->material->name;
        const bool has_own = shade->get_child_optional("color") || shade->get_child_optional("texture");
        if (has_own) materials.emplace(visual->material_name, visual->material);
      }
      result->visual_array.push_back(visual);
    }
    if (child.first == "collision") {
      const auto collision = std::make_shared<Collision>();
      collision->name = attribute(child.second, "name");
      collision->origin = pose(child.second);
      collision->geometry = geometry(child.second, "a collision of " + of);
      result->collision_array.push_back(collision);
    }
  }
  if (!result->visual_array.empty()) result->visual = result->visual_array[0];
  if (!result->collision_array.empty()) result->collision = result->collision_array[0];
  return result;
}

JointSharedPtr joint(const ptree& element) {
  static const std::map<std::string, int> types{{"revolute", Joint::REVOLUTE},   {"continuous", Joint::CONTINUOUS},
                                                {"prismatic", Joint::PRISMATIC}, {"floating", Joint::FLOATING},
                                                {"planar", Joint::PLANAR},       {"fixed", Joint::FIXED}};
  const auto result = std::make_shared<Joint>();
  result->name = required(element, "name", "a <joint>");
  const std::string of = "joint '" + result->name + "'", type = required(element, "type", of);
  if (!types.count(type)) throw ParseError(of + " has the unknown type '" + type + "'");
  result->type = types.at(type);
  result->parent_to_joint_origin_transform = pose(element);
  for (const auto& child : element) {
    const ptree& e = child.second;
    if (child.first == "parent") result->parent_link_name = attribute(e, "link");
    if (child.first == "child") result->child_link_name = attribute(e, "link");
    if (child.first == "axis" && !attribute(e, "xyz").empty()) result->axis = vector(attribute(e, "xyz"));
    if (child.first == "limit") {
      result->limits = std::make_shared<JointLimits>();
      result->limits->lower = number(e, "lower", 0.0);
      result->limits->upper = number(e, "upper", 0.0);
      result->limits->effort = number(e, "effort", 0.0);
      result->limits->velocity = number(e, "velocity", 0.0);
    }
    if (child.first == "dynamics") {
      result->dynamics = std::make_shared<JointDynamics>();
      result->dynamics->damping = number(e, "damping", 0.0);
      result->dynamics->friction = number(e, "friction", 0.0);
    }
    if (child.first == "safety_controller") {
      result->safety = std::make_shared<JointSafety>();
      result->safety->soft_lower_limit = number(e, "soft_lower_limit", 0.0);
      result->safety->soft_upper_limit = number(e, "soft_upper_limit", 0.0);
      result->safety->k_position = number(e, "k_position", 0.0);
      result->safety->k_velocity = number(e, "k_velocity", 0.0);
    }
    if (child.first == "calibration") {
      result->calibration = std::make_shared<JointCalibration>();
      if (!attribute(e, "rising").empty()) result->calibration->rising.reset(new double(number(e, "rising", 0.0)));
      if (!attribute(e, "falling").empty()) result->calibration->falling.reset(new double(number(e, "falling", 0.0)));
    }
    if (child.first == "mimic") {
      result->mimic = std::make_shared<JointMimic>();
      result->mimic->joint_name = required(e, "joint", "<mimic> of " + of);
      result->mimic->multiplier = number(e, "multiplier", 1.0);
      result->mimic->offset = number(e, "offset", 0.0);
    }
  }
  const bool is_limited = result->type == Joint::REVOLUTE || result->type == Joint::PRISMATIC;
  if (is_limited && !result->limits) throw ParseError(of + " is " + type + " but has no <limit>");
  return result;
}

/** Connect the links by the joints, and find the root. */
void connect(ModelInterface& model) {
  for (const auto& entry : model.joints_) {
    const JointSharedPtr& one = entry.second;
    const auto parent = model.links_.find(one->parent_link_name), child = model.links_.find(one->child_link_name);
    for (const auto& end : {parent, child})
      if (end == model.links_.end())
        throw ParseError("joint '" + one->name + "': no link '" +
                         (end == parent ? one->parent_link_name : one->child_link_name) + "'");
    if (child->second->parent_joint) throw ParseError("link '" + child->first + "' has two parents");
    child->second->setParent(parent->second);
    child->second->parent_joint = one;
    parent->second->child_joints.push_back(one);
    parent->second->child_links.push_back(child->second);
  }
  for (const auto& entry : model.links_) {
    if (entry.second->getParent()) continue;
    if (model.root_link_)
      throw ParseError("Two root links found: [" + model.root_link_->name + "] and [" + entry.first + "]");
    model.root_link_ = entry.second;
  }
  if (!model.root_link_) throw ParseError("No root link found: the joints make a loop");
}

void read(const std::string& xml, ModelInterface& model) {
  if (!isShallow(xml)) throw ParseError("there are too many elements in elements");
  std::istringstream stream(xml);
  ptree document;
  boost::property_tree::read_xml(stream, document);
  const auto robot = document.get_child_optional("robot");
  if (!robot) throw ParseError("Could not find the 'robot' element in the xml file");
  model.name_ = required(*robot, "name", "<robot>");
  for (const auto& child : *robot) {
    if (child.first != "material") continue;
    const MaterialSharedPtr one = material(child.second);
    if (!model.materials_.emplace(one->name, one).second) throw ParseError("two materials '" + one->name + "'");
  }
  for (const auto& child : *robot) {
    if (child.first == "link") {
      const LinkSharedPtr one = link(child.second, model.materials_);
      if (!model.links_.emplace(one->name, one).second) throw ParseError("two links '" + one->name + "'");
    } else if (child.first == "joint") {
      const JointSharedPtr one = joint(child.second);
      if (!model.joints_.emplace(one->name, one).second) throw ParseError("two joints '" + one->name + "'");
    }
  }
  for (const auto& entry : model.links_)
    for (const VisualSharedPtr& visual : entry.second->visual_array)
      if (visual->material && model.materials_.count(visual->material_name))
        visual->material = model.materials_[visual->material_name];
  if (model.links_.empty()) throw ParseError("No link elements found in urdf file");
  connect(model);
}

}  // namespace

void Vector3::init(const std::string& text) {
  const std::vector<double> values = numbers(text);
  if (values.size() != 3) throw ParseError("'" + text + "' has " + std::to_string(values.size()) + " numbers, not 3");
  *this = Vector3(values[0], values[1], values[2]);
}

void Rotation::init(const std::string& rpy) {
  Vector3 angles;
  angles.init(rpy);
  setFromRPY(angles.x, angles.y, angles.z);
}

ModelInterfaceSharedPtr parseURDF(const std::string& xml_string) {
  const auto model = std::make_shared<ModelInterface>();
  try {
    read(xml_string, *model);
    return model;
  } catch (const boost::property_tree::xml_parser_error& error) {
    ROS_ERROR("URDF, line %lu: %s", error.line(), error.message().c_str());
  } catch (const ParseError& error) {
    ROS_ERROR("URDF: %s", error.what());
  }
  return ModelInterfaceSharedPtr();
}

ModelInterfaceSharedPtr parseURDFFile(const std::string& filename) {
  std::ifstream file(filename);
  if (!file) {
    ROS_ERROR("File [%s] could not be opened", filename.c_str());
    return ModelInterfaceSharedPtr();
  }
  std::stringstream text;
  text << file.rdbuf();
  return parseURDF(text.str());
}

}  // namespace urdf
