// COLLADA: the triangles of its scene. Its <unit> and <up_axis> do not count.
#include <urdf_parser/shallow_xml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <map>
#include <sstream>
#include <vector>

#include "mesh_files.h"

namespace shapes {
namespace files {
namespace {

using boost::property_tree::ptree;

constexpr int kMaxDepth = 64;
constexpr std::size_t kMaxNodes = 100'000;  // nodes may name each other, and so become many
constexpr std::size_t kMaxOffset = 64;      // of an input of <p>
constexpr double kRadiansPerDegree = 0.017453292519943295;

std::string attribute(const ptree& element, const char* name) {
  return element.get<std::string>(std::string("<xmlattr>.") + name, "");
}

std::size_t count(const ptree& element, const char* name, std::size_t fallback) {
  const std::string text = attribute(element, name);
  return text.empty() ? fallback : std::strtoul(text.c_str(), nullptr, 10);
}

std::vector<double> numbers(const ptree& element, const char* tag) {
  std::istringstream in(element.data());
  in.imbue(std::locale::classic());
  std::vector<double> values;
  for (double value = 0.0; in >> value;) values.push_back(value);
  if (!in.eof()) throw std::runtime_error(std::string("<") + tag + "> is no list of numbers");
  return values;
}

std::vector<std::size_t> indices(const ptree& element) {
  std::vector<std::size_t> values;
  const char* at = element.data().c_str();
  for (char* end = nullptr;; at = end) {
    const unsigned long value = std::strtoul(at, &end, 10);
    if (end == at) break;
    values.push_back(value);
  }
  if (std::string(at).find_first_not_of(" \t\r\n") != std::string::npos)
    throw std::runtime_error("<p> is no list of numbers");
  return values;
}

/** The transform of a node, of its elements in their order. */
Eigen::Affine3d transformOf(const ptree& node) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (const auto& [tag, element] : node) {
    const std::size_t needed = tag == "matrix"                        ? 16
                               : tag == "rotate"                      ? 4
                               : tag == "translate" || tag == "scale" ? 3
                                                                      : 0;
    if (tag == "lookat" || tag == "skew") throw std::runtime_error("<" + tag + "> of a node is not known");
    if (needed == 0) continue;
    const std::vector<double> values = numbers(element, tag.c_str());
    if (values.size() != needed)
      throw std::runtime_error("<" + tag + "> has no " + std::to_string(needed) + " numbers");
    const Eigen::Vector3d vector(values.data());
    if (tag == "matrix")
      result.matrix() = result.matrix() * Eigen::Matrix<double, 4, 4, Eigen::RowMajor>(values.data());
    else if (tag == "translate") result.translate(vector);
    else if (tag == "scale") result.scale(vector);
    else if (!vector.isZero()) result.rotate(Eigen::AngleAxisd(values[3] * kRadiansPerDegree, vector.normalized()));
  }
  return result;
}

class Document {
 public:
  explicit Document(const ptree& root) { index(root); }

  Triangles read(const ptree& root) {
    const ptree* scene = nullptr;
    if (const auto instance = root.get_child_optional("scene.instance_visual_scene")) scene = &find(*instance, "url");
    else if (const auto first = root.get_child_optional("library_visual_scenes.visual_scene")) scene = &*first;
    if (scene == nullptr) throw std::runtime_error("it has no scene");
    readNode(*scene, Eigen::Affine3d::Identity(), 0);
    return std::move(points_);
  }

 private:
  void index(const ptree& element) {
    for (const auto& entry : element) {
      const std::string id = attribute(entry.second, "id");
      if (!id.empty()) elements_.emplace(id, &entry.second);
      index(entry.second);
    }
  }

  /** The element that an attribute names, such as url="#base". */
  const ptree& find(const ptree& element, const char* name) const {
    const std::string url = attribute(element, name);
    const auto found = url.empty() || url[0] != '#' ? elements_.end() : elements_.find(url.substr(1));
    if (found == elements_.end()) throw std::runtime_error("it names '" + url + "', which it has not");
    return *found->second;
  }

  void readNode(const ptree& node, const Eigen::Affine3d& scene_from_parent, int depth) {
    if (depth > kMaxDepth || ++nodes_ > kMaxNodes) throw std::runtime_error("its nodes are too many, or endless");
    const Eigen::Affine3d scene_from_node = scene_from_parent * transformOf(node);
    for (const auto& [tag, element] : node)
      if (tag == "node") readNode(element, scene_from_node, depth + 1);
      else if (tag == "instance_node") readNode(find(element, "url"), scene_from_node, depth + 1);
      else if (tag == "instance_geometry") add(find(element, "url"), scene_from_node);
      else if (tag == "instance_controller") addSkin(find(element, "url"), scene_from_node, 0);
  }

  void addSkin(const ptree& controller, const Eigen::Affine3d& scene_from_node, int depth) {
    if (depth > kMaxDepth) throw std::runtime_error("its controllers are endless");
    for (const auto& [tag, element] : controller) {
      if (tag != "skin" && tag != "morph") continue;
      const ptree& source = find(element, "source");
      if (source.count("mesh") > 0) add(source, scene_from_node);
      else addSkin(source, scene_from_node, depth + 1);
    }
  }

  void add(const ptree& geometry, const Eigen::Affine3d& scene_from_node) {
    auto known = geometries_.find(&geometry);
    if (known == geometries_.end()) known = geometries_.emplace(&geometry, trianglesOf(geometry)).first;
    const Triangles& local = known->second;
    if ((points_.size() + local.size()) / 3 > kMaxTriangles)
      throw std::runtime_error("it has more than " + std::to_string(kMaxTriangles) + " triangles");
    const bool is_mirrored = scene_from_node.linear().determinant() < 0.0;
    for (std::size_t i = 0; i + 2 < local.size(); i += 3)
      for (const std::size_t k :
           {std::size_t{0}, std::size_t{is_mirrored ? 2u : 1u}, std::size_t{is_mirrored ? 1u : 2u}})
        points_.push_back(scene_from_node * local[i + k]);
  }

  Triangles trianglesOf(const ptree& geometry) {
    Triangles result;
    for (const auto& [tag, mesh] : geometry)
      if (tag == "mesh")
        for (const auto& [kind, primitive] : mesh) addPrimitive(kind, primitive, result);
    return result;
  }

  /** Points of the source that a <vertices> names; each source is read once. */
  const Triangles& positions(const ptree& vertices) {
    for (const auto& [tag, input] : vertices) {
      if (tag != "input" || attribute(input, "semantic") != "POSITION") continue;
      const ptree& source = find(input, "source");
      auto known = sources_.find(&source);
      if (known == sources_.end()) known = sources_.emplace(&source, pointsOf(source)).first;
      return known->second;
    }
    throw std::runtime_error("a <vertices> has no POSITION");
  }

  static Triangles pointsOf(const ptree& source) {
    const auto array = source.get_child_optional("float_array");
    const auto accessor = source.get_child_optional("technique_common.accessor");
    if (!array || !accessor) throw std::runtime_error("a <source> has no <float_array> or <accessor>");
    const std::vector<double> values = numbers(*array, "float_array");
    const std::size_t stride = count(*accessor, "stride", 1), offset = count(*accessor, "offset", 0);
    std::size_t place[3] = {0, 1, 2}, next = 0;
    for (const auto& [name, param] : *accessor) {
      if (name != "param") continue;
      const std::string axis = attribute(param, "name");
      if (axis.size() == 1 && axis[0] >= 'X' && axis[0] <= 'Z') place[axis[0] - 'X'] = next;
      ++next;
    }
    if (stride < 3 || std::max({place[0], place[1], place[2]}) >= stride)
      throw std::runtime_error("a <source> of positions has no x, y and z");
    Triangles points;
    for (std::size_t at = offset; at < values.size() && values.size() - at >= stride; at += stride)
      points.emplace_back(values[at + place[0]], values[at + place[1]], values[at + place[2]]);
    return points;
  }

  void addPrimitive(const std::string& kind, const ptree& primitive, Triangles& result) {
    const bool is_strip = kind == "tristrips", is_fan = kind == "trifans" || kind == "polygons";
    if (kind != "triangles" && kind != "polylist" && !is_strip && !is_fan) return;
    const ptree* vertices = nullptr;
    std::size_t offset = 0, width = 1;
    for (const auto& [tag, input] : primitive) {
      if (tag != "input") continue;
      const std::size_t place = count(input, "offset", 0);
      if (place > kMaxOffset) throw std::runtime_error("the offset of an <input> is too large");
      width = std::max(width, place + 1);
      if (attribute(input, "semantic") != "VERTEX") continue;
      vertices = &find(input, "source");
      offset = place;
    }
    if (vertices == nullptr) throw std::runtime_error("<" + kind + "> has no VERTEX");
    const Triangles& points = positions(*vertices);
    std::vector<std::size_t> sides;
    if (const auto vcount = primitive.get_child_optional("vcount")) sides = indices(*vcount);
    for (const auto& [tag, list] : primitive) {
      if (tag != "p") continue;
      const std::vector<std::size_t> numbers = indices(list);
      const std::size_t corners = numbers.size() / width;
      const auto corner = [&](std::size_t i) -> const Eigen::Vector3d& {
        const std::size_t number = numbers[i * width + offset];
        if (number >= points.size())
          throw std::runtime_error("<p> names vertex " + std::to_string(number) + " of " +
                                   std::to_string(points.size()));
        return points[number];
      };
      const auto addTriangle = [&](std::size_t i, std::size_t j, std::size_t k) {
        result.insert(result.end(), {corner(i), corner(j), corner(k)});
      };
      const auto addFan = [&](std::size_t first, std::size_t size) {
        for (std::size_t i = 2; i < size; ++i) addTriangle(first, first + i - 1, first + i);
      };
      if (is_fan) {
        addFan(0, corners);
      } else if (is_strip) {
        for (std::size_t i = 2; i < corners; ++i) addTriangle(i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1);
      } else if (kind == "polylist") {
        std::size_t first = 0;
        for (const std::size_t size : sides) {
          if (size > corners - first) throw std::runtime_error("<p> has less corners than <vcount> says");
          addFan(first, size);
          first += size;
        }
      } else {
        for (std::size_t i = 0; i + 2 < corners; i += 3) addTriangle(i, i + 1, i + 2);
      }
    }
  }

  std::map<std::string, const ptree*> elements_;
  std::map<const ptree*, Triangles> sources_, geometries_;
  Triangles points_;
  std::size_t nodes_ = 0;
};

}  // namespace

Triangles readCollada(const std::string& data) {
  if (!urdf::isShallow(data)) throw std::runtime_error("there are too many elements in elements");
  std::istringstream in(data);
  ptree document;
  try {
    boost::property_tree::read_xml(in, document, boost::property_tree::xml_parser::no_comments);
  } catch (const boost::property_tree::xml_parser_error& error) {
    throw std::runtime_error("line " + std::to_string(error.line()) + ": " + error.message());
  }
  const auto root = document.get_child_optional("COLLADA");
  if (!root) throw std::runtime_error("it has no <COLLADA>");
  return Document(*root).read(*root);
}

}  // namespace files
}  // namespace shapes
