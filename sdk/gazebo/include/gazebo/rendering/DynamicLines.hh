// Lines that a plugin draws; the page shows them, cameras do not.
#ifndef GAZEBO_RENDERING_DYNAMICLINES_HH_
#define GAZEBO_RENDERING_DYNAMICLINES_HH_

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <ignition/math/Color.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/rendering/RenderTypes.hh>

namespace gazebo {
namespace rendering {

// A strip, or pairs of points, in the axes of the visual that made it. It has one color: the material's, else that of
// its first point.
class DynamicLines {
 public:
  explicit DynamicLines(RenderOpType type = RENDERING_LINE_STRIP) : type_(type), number_(0) {}

  void AddPoint(const ignition::math::Vector3d& point,
                const ignition::math::Color& color = ignition::math::Color::White);
  void AddPoint(double x, double y, double z, const ignition::math::Color& color = ignition::math::Color::White) {
    AddPoint(ignition::math::Vector3d(x, y, z), color);
  }
  // Of a point that there is; else a warning.
  void SetPoint(unsigned int index, const ignition::math::Vector3d& point);
  void SetColor(unsigned int index, const ignition::math::Color& color);
  ignition::math::Vector3d Point(unsigned int index) const;
  ignition::math::Vector3d GetPoint(unsigned int index) const { return Point(index); }
  unsigned int GetPointCount() const;
  void Clear();
  // What has changed is shown by itself.
  void Update() {}
  // Of Ogre's renderables: a material of Gazebo, such as Gazebo/Purple.
  void setMaterial(const std::string& name);
  // Cameras see no lines, whatever their mask.
  void setVisibilityFlags(uint32_t) {}

 private:
  friend class Visual;
  mutable std::mutex mutex_;
  RenderOpType type_;
  int number_;  // of the visual's lines
  std::string material_;
  std::vector<ignition::math::Vector3d> points_;
  std::vector<ignition::math::Color> colors_;
  std::vector<double> sent_;  // what the page shows
  std::string sent_material_;
};

}  // namespace rendering
}  // namespace gazebo

#endif
