#include <atomic>

#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

Base::Base(BasePtr parent) : type_(BASE), parent_(parent) {
  static std::atomic<uint32_t> last_id(0);
  id_ = ++last_id;
  if (parent) world_ = parent->GetWorld();
}

std::string Base::GetScopedName(bool prepend_world_name) const {
  std::string name = name_;
  for (BasePtr above = parent_; above; above = above->GetParent()) name = above->GetName() + "::" + name;
  return prepend_world_name && world_ ? world_->Name() + "::" + name : name;
}

BasePtr Base::GetChild(const std::string& name) const {
  for (const BasePtr& child : children_)
    if (child->GetName() == name || child->GetScopedName() == name) return child;
  return BasePtr();
}

BasePtr Base::GetByName(const std::string& name) {
  if (GetScopedName() == name || name_ == name) return shared_from_this();
  for (const BasePtr& child : children_)
    if (const BasePtr found = child->GetByName(name)) return found;
  return BasePtr();
}

std::string Base::TypeStr() const {
  return type_ & MODEL       ? "model"
         : type_ & LINK      ? "link"
         : type_ & COLLISION ? "collision"
         : type_ & JOINT     ? "joint"
                             : "base";
}

Entity::Entity(BasePtr parent) : Base(parent), is_static_(false), is_canonical_(false) { type_ |= ENTITY; }

bool Entity::IsStatic() const { return is_static_; }

ModelPtr Entity::GetParentModel() {
  BasePtr top = shared_from_this();
  while (top->GetParent()) top = top->GetParent();
  return boost::dynamic_pointer_cast<Model>(top);
}

CollisionPtr Entity::GetChildCollision(const std::string& name) {
  return boost::dynamic_pointer_cast<Collision>(GetByName(name));
}

LinkPtr Entity::GetChildLink(const std::string& name) { return boost::dynamic_pointer_cast<Link>(GetByName(name)); }

namespace {

// Half of a shape's extent along its axes.
ignition::math::Vector3d half_extent(const ShapePtr& shape) {
  if (const auto box = boost::dynamic_pointer_cast<BoxShape>(shape)) return box->size * 0.5;
  if (const auto sphere = boost::dynamic_pointer_cast<SphereShape>(shape))
    return {sphere->radius, sphere->radius, sphere->radius};
  if (const auto cylinder = boost::dynamic_pointer_cast<CylinderShape>(shape))
    return {cylinder->radius, cylinder->radius, 0.5 * cylinder->length};
  return {};
}

// Add an entity's collisions to a box.
void add_box(const Base& base, ignition::math::Box& box) {
  if (const auto collision = dynamic_cast<const Collision*>(&base)) {
    const ignition::math::Pose3d pose = collision->WorldPose();
    const ignition::math::Matrix3d axes(pose.Rot());
    const ignition::math::Vector3d half = half_extent(collision->GetShape());
    ignition::math::Vector3d reach;
    for (unsigned int row = 0; row < 3; ++row)
      for (unsigned int column = 0; column < 3; ++column) reach[row] += std::abs(axes(row, column)) * half[column];
    box.Merge(ignition::math::Box(pose.Pos() - reach, pose.Pos() + reach));
  }
  for (unsigned int i = 0; i < base.GetChildCount(); ++i) add_box(*base.GetChild(i), box);
}

}  // namespace

ignition::math::Box Entity::BoundingBox() const {
  ignition::math::Box box;
  add_box(*this, box);
  return box;
}

ignition::math::Pose3d Entity::RelativePose() const { return WorldPose(); }
void Entity::SetRelativePose(const ignition::math::Pose3d& pose, bool notify, bool publish) {
  const EntityPtr above = boost::dynamic_pointer_cast<Entity>(parent_);
  SetWorldPose(above ? above->WorldPose() * pose : pose, notify, publish);
}
ignition::math::Pose3d Entity::WorldPose() const { return initial_; }
void Entity::SetWorldPose(const ignition::math::Pose3d&, bool, bool) {}

Collision::Collision(LinkPtr link) : Entity(link) { type_ |= COLLISION; }

std::vector<double> SurfaceParams::Values() const {
  const math::Vector3& along = friction_->direction1;
  return {friction_->MuPrimary(),           friction_->MuSecondary(), along.x, along.y, along.z,
          collideWithoutContact ? 1.0 : 0.0};
}

SurfaceParamsPtr Collision::GetSurface() const {
  if (!is_watched_) {
    is_watched_ = true;
    world_->surfaces_.push_back(boost::static_pointer_cast<const Collision>(shared_from_this()));
  }
  return surface_;
}

void Collision::TakeChange(std::vector<std::string>& words, std::vector<double>& numbers) const {
  const std::vector<double> values = surface_->Values();
  if (values == surface_->sent_) return;
  surface_->sent_ = values;
  words.push_back(GetScopedName());
  numbers.insert(numbers.end(), values.begin(), values.end());
}

LinkPtr Collision::GetLink() const { return boost::static_pointer_cast<Link>(parent_); }
ModelPtr Collision::GetModel() const { return GetLink()->GetModel(); }
ignition::math::Pose3d Collision::WorldPose() const { return GetLink()->WorldPose() * initial_; }
ignition::math::Vector3d Collision::WorldLinearVel() const { return GetLink()->WorldLinearVel(initial_.Pos()); }
ignition::math::Vector3d Collision::WorldAngularVel() const { return GetLink()->WorldAngularVel(); }

}  // namespace physics
}  // namespace gazebo
