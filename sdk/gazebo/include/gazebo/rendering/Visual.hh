// A visual of a link as far as it needs no Ogre: the page and cameras draw it as a plugin changes it.
#ifndef GAZEBO_RENDERING_VISUAL_HH_
#define GAZEBO_RENDERING_VISUAL_HH_

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <sdf/sdf.hh>

#include <gazebo/common/Time.hh>
#include <gazebo/math/Pose.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/rendering/DynamicLines.hh>
#include <gazebo/rendering/RenderTypes.hh>

namespace gazebo {
namespace rendering {

// What is set is drawn at most ten times a second, as the world is compiled for it; lines fifty times.
class Visual : public std::enable_shared_from_this<Visual> {
 public:
  Visual(const physics::LinkPtr& link, const sdf::ElementPtr& sdf);
  virtual ~Visual();

  // `model::link::visual`
  std::string Name() const { return name_; }
  uint32_t GetId() const { return id_; }
  sdf::ElementPtr GetSDF() const { return sdf_; }
  // In the link's frame.
  ignition::math::Pose3d Pose() const;
  ignition::math::Pose3d InitialRelativePose() const { return initial_; }
  ignition::math::Vector3d Position() const { return Pose().Pos(); }
  ignition::math::Quaterniond Rotation() const { return Pose().Rot(); }
  ignition::math::Pose3d WorldPose() const;
  void SetPose(const ignition::math::Pose3d& pose);
  void SetPosition(const ignition::math::Vector3d& position);
  void SetRotation(const ignition::math::Quaterniond& rotation);
  void SetWorldPose(const ignition::math::Pose3d& pose);
  void SetWorldPosition(const ignition::math::Vector3d& position);
  // Of unit shapes, as in the file: a sphere's is its diameter.
  ignition::math::Vector3d Scale() const { return scale_; }
  bool GetVisible() const;
  void SetVisible(bool is_visible, bool cascade = true);
  void ToggleVisible() { SetVisible(!GetVisible()); }
  // 0 opaque to 1 invisible.
  float GetTransparency() const;
  void SetTransparency(float transparency);
  // Name of a material of Gazebo, such as Gazebo/Red.
  void SetMaterial(const std::string& name, bool unique = true, const bool cascade = true);
  std::string GetMaterialName() const;

  // Lines in the visual's axes, which are scaled with it, until they are deleted.
  DynamicLines* CreateDynamicLine(RenderOpType type = RENDERING_LINE_STRIP);
  void DeleteDynamicLine(DynamicLines* line);

  // Names up to Gazebo 8.
  std::string GetName() const { return Name(); }
  math::Pose GetPose() const { return Pose(); }
  math::Pose GetWorldPose() const { return WorldPose(); }
  math::Vector3 GetScale() const { return Scale(); }
  math::Vector3 GetPosition() const { return Position(); }

  // For the library: draw what has changed.
  void Send(const common::Time& time);

 private:
  Visual(const Visual&);
  void Change();
  std::string LineName(const DynamicLines& line) const;
  void SendLine(DynamicLines& line, const ignition::math::Pose3d& world_from_visual);

  mutable std::mutex mutex_;
  physics::LinkPtr link_;
  boost::weak_ptr<physics::World> world_;
  std::string name_, material_;
  uint32_t id_;
  int last_line_ = 0;
  sdf::ElementPtr sdf_;
  ignition::math::Pose3d initial_, pose_;
  ignition::math::Vector3d scale_;
  float transparency_ = 0.0f;
  bool is_visible_ = true, has_changed_ = false;
  common::Time sent_, sent_lines_;
  std::vector<std::unique_ptr<DynamicLines>> lines_;
};

}  // namespace rendering
}  // namespace gazebo

#endif
