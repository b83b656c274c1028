#ifndef GAZEBO_PHYSICS_PHYSICSTYPES_HH_
#define GAZEBO_PHYSICS_PHYSICSTYPES_HH_

#include <map>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <boost/weak_ptr.hpp>

#define GZ_ALL_COLLIDE 0x0FFFFFFF
#define GZ_NONE_COLLIDE 0x00000000
#define GZ_FIXED_COLLIDE 0x00000001
#define GZ_SENSOR_COLLIDE 0x00000002
#define GZ_GHOST_COLLIDE 0x10000000

namespace gazebo {
namespace physics {

class Base;
class BoxShape;
class Collision;
class Contact;
class ContactManager;
class CylinderShape;
class Entity;
class FrictionPyramid;
class Inertial;
class Joint;
class JointController;
class JointWrench;
class Light;
class Link;
class MeshShape;
class Model;
class PhysicsEngine;
class PresetManager;
class Shape;
class SphereShape;
class SurfaceParams;
class MultiRayShape;
class World;

typedef boost::shared_ptr<Base> BasePtr;
typedef boost::shared_ptr<BoxShape> BoxShapePtr;
typedef boost::shared_ptr<Collision> CollisionPtr;
typedef boost::shared_ptr<CylinderShape> CylinderShapePtr;
typedef boost::shared_ptr<Entity> EntityPtr;
typedef boost::shared_ptr<FrictionPyramid> FrictionPyramidPtr;
typedef boost::shared_ptr<Inertial> InertialPtr;
typedef boost::shared_ptr<Joint> JointPtr;
typedef boost::shared_ptr<JointController> JointControllerPtr;
typedef boost::shared_ptr<Light> LightPtr;
typedef boost::shared_ptr<Link> LinkPtr;
typedef boost::shared_ptr<MeshShape> MeshShapePtr;
typedef boost::shared_ptr<Model> ModelPtr;
typedef boost::shared_ptr<Model> ActorPtr;
typedef boost::shared_ptr<PhysicsEngine> PhysicsEnginePtr;
typedef boost::shared_ptr<PresetManager> PresetManagerPtr;
typedef boost::shared_ptr<Shape> ShapePtr;
typedef boost::shared_ptr<SphereShape> SphereShapePtr;
typedef boost::shared_ptr<SurfaceParams> SurfaceParamsPtr;
typedef boost::shared_ptr<World> WorldPtr;
typedef boost::shared_ptr<MultiRayShape> MultiRayShapePtr;
typedef boost::weak_ptr<World> WorldWeakPtr;
typedef boost::weak_ptr<Model> ModelWeakPtr;

typedef std::vector<BasePtr> Base_V;
typedef std::vector<EntityPtr> Entity_V;
typedef std::vector<CollisionPtr> Collision_V;
typedef std::vector<JointControllerPtr> JointController_V;
typedef std::vector<JointPtr> Joint_V;
typedef std::vector<LightPtr> Light_V;
typedef std::vector<LinkPtr> Link_V;
typedef std::vector<ModelPtr> Model_V;
typedef std::map<std::string, JointPtr> JointState_M;

}  // namespace physics
}  // namespace gazebo

#endif
