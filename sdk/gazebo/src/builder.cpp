#include "builder.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <boost/make_shared.hpp>

#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

namespace {

ignition::math::Pose3d pose_of(const sdf::ElementPtr& sdf) {
  return sdf && sdf->HasElement("pose") ? sdf->Get<ignition::math::Pose3d>("pose") : ignition::math::Pose3d();
}

ignition::math::Inertiald inertial_of(const sdf::ElementPtr& sdf) {
  const sdf::ElementPtr inertial = sdf->FindElement("inertial");
  if (!inertial) return ignition::math::Inertiald(ignition::math::MassMatrix3d(1.0, {1, 1, 1}, {0, 0, 0}), {});
  const sdf::ElementPtr moments = inertial->FindElement("inertia");
  const auto moment = [&moments](const char* name, double missing) {
    return moments ? moments->Get<double>(name, missing).first : missing;
  };
  return ignition::math::Inertiald(
      ignition::math::MassMatrix3d(inertial->Get<double>("mass", 1.0).first,
                                   {moment("ixx", 1.0), moment("iyy", 1.0), moment("izz", 1.0)},
                                   {moment("ixy", 0.0), moment("ixz", 0.0), moment("iyz", 0.0)}),
      pose_of(inertial));
}

}  // namespace

sdf::ElementPtr read_elements(const char* text, int64_t size) {
  const char *next = text, *end = text + size;
  const auto word = [&next, end]() {
    const char* begin = next;
    while (next < end && *next) ++next;
    const std::string result(begin, next);
    if (next < end) ++next;
    return result;
  };
  std::vector<sdf::ElementPtr> open;
  while (next < end) {
    const std::size_t depth = static_cast<std::size_t>(std::strtoul(word().c_str(), nullptr, 10));
    const sdf::ElementPtr element = std::make_shared<sdf::Element>();
    element->SetName(word());
    element->AddValue("string", word(), false);
    for (unsigned long left = std::strtoul(word().c_str(), nullptr, 10); left && next < end; --left) {
      const std::string key = word();
      element->AddAttribute(key, "string", "", false);
      element->GetAttribute(key)->SetFromString(word());
    }
    if (depth < open.size()) open.resize(depth);
    if (!open.empty()) open.back()->InsertElement(element, true);
    open.push_back(element);
  }
  return open.empty() ? sdf::ElementPtr() : open.front();
}

void Builder::SetHost(const WorldPtr& world, const TrundleGazeboHost* host, const sdf::ElementPtr& sdf) {
  world->host_ = host;
  if (const sdf::ElementPtr place = sdf ? sdf->FindElement("spherical_coordinates") : sdf::ElementPtr()) {
    const auto degrees = [&place](const char* name) {
      return ignition::math::Angle(place->Get<double>(name, 0.0).first * 3.14159265358979323846 / 180.0);
    };
    world->spherical_coordinates_ = boost::make_shared<common::SphericalCoordinates>(
        common::SphericalCoordinates::EARTH_WGS84, degrees("latitude_deg"), degrees("longitude_deg"),
        place->Get<double>("elevation", 0.0).first, degrees("heading_deg"));
  }
  world->presets_ = boost::make_shared<PresetManager>(world->physics_, sdf);
  const sdf::ElementPtr physics = world->presets_->ProfileSDF(world->presets_->CurrentProfile());
  if (!physics) return;
  world->physics_->update_rate_ = physics->Get<double>("real_time_update_rate", 1000.0).first;
  world->physics_->real_time_factor_ = physics->Get<double>("real_time_factor", 1.0).first;
}

void Builder::CountPlugin(const ModelPtr& model) { ++model->plugin_count_; }

ModelPtr Builder::AddModel(const WorldPtr& world, const std::string& name, const sdf::ElementPtr& sdf) {
  const ModelPtr model = boost::make_shared<Model>(BasePtr());
  model->name_ = name;
  model->world_ = world;
  model->sdf_ = sdf;
  model->initial_ = pose_of(sdf);
  model->is_static_ = sdf->Get<bool>("static");
  model->self_collide_ = sdf->Get<bool>("self_collide");
  for (sdf::ElementPtr e = sdf->FindElement("link"); e; e = e->GetNextElement("link")) AddLink(model, e);
  const std::string canonical = sdf->Get<std::string>("canonical_link");
  for (const LinkPtr& link : model->links_)
    link->is_canonical_ = canonical.empty() ? link == model->links_.front() : link->name_ == canonical;
  for (sdf::ElementPtr e = sdf->FindElement("joint"); e; e = e->GetNextElement("joint")) AddJoint(model, e);
  world->models_.push_back(model);
  return model;
}

void Builder::RemoveModel(const WorldPtr& world, const std::string& name) {
  for (std::size_t i = 0; i < world->models_.size(); ++i)
    if (world->models_[i]->name_ == name) {
      auto& animated = world->animated_;
      animated.erase(std::remove_if(animated.begin(), animated.end(),
                                    [&](const EntityPtr& e) { return e->GetParentModel() == world->models_[i]; }),
                     animated.end());
      for (const LinkPtr& link : world->models_[i]->links_) link->SetGravityMode(link->written_gravity_);
      world->models_.erase(world->models_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
}

LinkPtr Builder::AddLink(const ModelPtr& model, const sdf::ElementPtr& sdf) {
  const LinkPtr link = boost::make_shared<Link>(model);
  link->name_ = sdf->Get<std::string>("name");
  link->world_ = model->world_;
  link->sdf_ = sdf;
  link->initial_ = pose_of(sdf);
  link->is_static_ = model->is_static_;
  link->gravity_ = link->written_gravity_ = sdf->Get<bool>("gravity", true).first;
  link->self_collide_ = sdf->Get<bool>("self_collide");
  link->kinematic_ = sdf->Get<bool>("kinematic");
  link->inertial_ = boost::make_shared<Inertial>(inertial_of(sdf));
  const TrundleGazeboHost* host = model->world_->host_;
  link->number_ = host->find(host->self, TRUNDLE_LINK, link->GetScopedName().c_str());
  for (sdf::ElementPtr e = sdf->FindElement("collision"); e; e = e->GetNextElement("collision")) AddCollision(link, e);
  for (sdf::ElementPtr e = sdf->FindElement("sensor"); e; e = e->GetNextElement("sensor"))
    link->sensor_names_.push_back(link->GetScopedName(true) + "::" + e->Get<std::string>("name"));
  model->links_.push_back(link);
  model->AddChild(link);
  return link;
}

void Builder::AddCollision(const LinkPtr& link, const sdf::ElementPtr& sdf) {
  const CollisionPtr collision = boost::make_shared<Collision>(link);
  collision->name_ = sdf->Get<std::string>("name");
  collision->world_ = link->world_;
  collision->sdf_ = sdf;
  collision->initial_ = pose_of(sdf);
  collision->is_static_ = link->is_static_;
  collision->surface_ = boost::make_shared<SurfaceParams>();
  const auto below = [](const sdf::ElementPtr& e, const char* name) { return e ? e->FindElement(name) : e; };
  const sdf::ElementPtr friction = below(below(sdf, "surface"), "friction");
  if (const sdf::ElementPtr ode = below(friction, "ode")) {
    physics::FrictionPyramid& pyramid = *collision->surface_->FrictionPyramid();
    pyramid.mu1_ = ode->Get<double>("mu", 1.0).first;
    pyramid.mu2_ = ode->Get<double>("mu2", 1.0).first;
    if (ode->HasElement("fdir1")) pyramid.direction1 = ode->Get<ignition::math::Vector3d>("fdir1");
  }
  if (const sdf::ElementPtr contact = below(below(sdf, "surface"), "contact"))
    collision->surface_->collideWithoutContact = contact->Get<bool>("collide_without_contact", false).first;
  collision->surface_->sent_ = collision->surface_->Values();
  if (const sdf::ElementPtr geometry = sdf->FindElement("geometry")) collision->shape_ = MakeShape(collision, geometry);
  link->collisions_.push_back(collision);
  link->AddChild(collision);
}

ShapePtr Builder::MakeShape(const CollisionPtr& collision, const sdf::ElementPtr& geometry) {
  if (const sdf::ElementPtr box = geometry->FindElement("box")) {
    const BoxShapePtr shape = boost::make_shared<BoxShape>(collision);
    shape->size = box->Get<ignition::math::Vector3d>("size");
    return shape;
  }
  if (const sdf::ElementPtr cylinder = geometry->FindElement("cylinder")) {
    const CylinderShapePtr shape = boost::make_shared<CylinderShape>(collision);
    shape->radius = cylinder->Get<double>("radius");
    shape->length = cylinder->Get<double>("length");
    return shape;
  }
  if (const sdf::ElementPtr sphere = geometry->FindElement("sphere")) {
    const SphereShapePtr shape = boost::make_shared<SphereShape>(collision);
    shape->radius = sphere->Get<double>("radius");
    return shape;
  }
  if (const sdf::ElementPtr mesh = geometry->FindElement("mesh")) {
    const MeshShapePtr shape = boost::make_shared<MeshShape>(collision);
    shape->uri = mesh->Get<std::string>("uri");
    return shape;
  }
  return boost::make_shared<Shape>(collision);
}

void Builder::AddJoint(const ModelPtr& model, const sdf::ElementPtr& sdf) {
  const JointPtr joint = boost::make_shared<Joint>(model);
  joint->name_ = sdf->Get<std::string>("name");
  joint->world_ = model->world_;
  joint->sdf_ = sdf;
  joint->model_ = model;
  joint->type_name_ = sdf->Get<std::string>("type");
  joint->child_from_joint_ = pose_of(sdf);
  joint->parent_link_ = model->GetLink(sdf->Get<std::string>("parent"));
  joint->child_link_ = model->GetLink(sdf->Get<std::string>("child"));
  const sdf::ElementPtr axes[2] = {sdf->FindElement("axis"), sdf->FindElement("axis2")};
  for (unsigned int i = 0; i < 2 && axes[i]; ++i) {
    joint->axis_[i] = axes[i]->Get<ignition::math::Vector3d>("xyz", ignition::math::Vector3d::UnitZ).first;
    const sdf::ElementPtr xyz = axes[i]->FindElement("xyz");
    if (xyz && xyz->Get<std::string>("expressed_in") == "__model__" && joint->child_link_) {
      const ignition::math::Pose3d model_from_joint =
          joint->child_link_->InitialRelativePose() * joint->child_from_joint_;
      joint->axis_[i] = model_from_joint.Rot().RotateVectorReverse(joint->axis_[i]);
    }
    if (const sdf::ElementPtr limit = axes[i]->FindElement("limit")) {
      joint->lower_[i] = limit->Get<double>("lower", joint->lower_[i]).first;
      joint->upper_[i] = limit->Get<double>("upper", joint->upper_[i]).first;
      joint->effort_limit_[i] = limit->Get<double>("effort", joint->effort_limit_[i]).first;
      joint->velocity_limit_[i] = limit->Get<double>("velocity", joint->velocity_limit_[i]).first;
    }
    if (const sdf::ElementPtr dynamics = axes[i]->FindElement("dynamics"))
      joint->damping_[i] = dynamics->Get<double>("damping", 0.0).first;
  }
  if (joint->parent_link_) joint->parent_link_->child_joints_.push_back(joint);
  if (joint->child_link_) joint->child_link_->parent_joints_.push_back(joint);
  model->joints_.push_back(joint);
  model->AddChild(joint);
}

}  // namespace physics
}  // namespace gazebo
