// What every part of a world has: a name, a parent, children.
#ifndef GAZEBO_PHYSICS_BASE_HH_
#define GAZEBO_PHYSICS_BASE_HH_

#include <string>

#include <boost/enable_shared_from_this.hpp>

#include <sdf/sdf.hh>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo {
namespace physics {

class Base : public boost::enable_shared_from_this<Base> {
 public:
  enum EntityType {
    BASE = 0x00000000,
    ENTITY = 0x00000001,
    MODEL = 0x00000002,
    LINK = 0x00000004,
    COLLISION = 0x00000008,
    LIGHT = 0x00000010,
    VISUAL = 0x00000020,
    JOINT = 0x00000040,
    SHAPE = 0x00010000,
    BOX_SHAPE = 0x00020000,
    CYLINDER_SHAPE = 0x00040000,
    MESH_SHAPE = 0x00200000,
    PLANE_SHAPE = 0x00800000,
    SPHERE_SHAPE = 0x02000000
  };

  explicit Base(BasePtr parent);
  virtual ~Base() {}

  virtual void Init() {}
  virtual void Fini() {}
  virtual void Reset() {}
  virtual void Update() {}
  void SetName(const std::string& name) { name_ = name; }
  std::string GetName() const { return name_; }
  // Names from the model down, `model::link`; with the world's before them on request.
  std::string GetScopedName(bool prepend_world_name = false) const;
  uint32_t GetId() const { return id_; }
  void SetSaveable(bool) {}
  BasePtr GetParent() const { return parent_; }
  int GetParentId() const { return parent_ ? static_cast<int>(parent_->GetId()) : 0; }
  unsigned int GetChildCount() const { return static_cast<unsigned int>(children_.size()); }
  BasePtr GetChild(unsigned int index) const { return index < children_.size() ? children_[index] : BasePtr(); }
  BasePtr GetChild(const std::string& name) const;
  BasePtr GetByName(const std::string& name);
  unsigned int GetType() const { return type_; }
  bool HasType(const EntityType& type) const { return type == BASE || (type_ & type) == static_cast<unsigned>(type); }
  std::string TypeStr() const;
  const WorldPtr& GetWorld() const { return world_; }
  virtual const sdf::ElementPtr GetSDF() { return sdf_; }
  bool IsSelected() const { return false; }
  bool operator==(const Base& other) const { return name_ == other.name_; }

 protected:
  friend struct Builder;
  friend class PhysicsEngine;
  void AddChild(BasePtr child) { children_.push_back(child); }

  std::string name_;
  unsigned int type_;
  uint32_t id_;
  BasePtr parent_;
  Base_V children_;
  WorldPtr world_;
  sdf::ElementPtr sdf_;
};

}  // namespace physics
}  // namespace gazebo

#endif
