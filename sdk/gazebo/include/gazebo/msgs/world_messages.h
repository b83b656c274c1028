// Messages about the world: what a plugin asks of it, and visuals.
#ifndef GAZEBO_MSGS_WORLD_MESSAGES_H_
#define GAZEBO_MSGS_WORLD_MESSAGES_H_

#include <cstdint>
#include <string>

#include <boost/shared_ptr.hpp>

#include <gazebo/msgs/fields.h>
#include <gazebo/msgs/msgs.hh>

namespace gazebo {
namespace msgs {

class Factory {
  TRUNDLE_FIELD(std::string, sdf)
  TRUNDLE_FIELD(std::string, sdf_filename)
  TRUNDLE_MESSAGE(Pose, pose)
  TRUNDLE_FIELD(std::string, edit_name)
  TRUNDLE_FIELD(std::string, clone_model_name)
  TRUNDLE_FIELD(bool, allow_renaming)

 public:
  void Clear() { *this = Factory(); }
};

class Physics {
 public:
  enum Type { ODE = 1, BULLET = 2, SIMBODY = 3, DART = 4 };

  TRUNDLE_FIELD(Type, type)
  TRUNDLE_FIELD(std::string, solver_type)
  TRUNDLE_FIELD(double, min_step_size)
  TRUNDLE_FIELD(int32_t, precon_iters)
  TRUNDLE_FIELD(int32_t, iters)
  TRUNDLE_FIELD(double, sor)
  TRUNDLE_FIELD(double, cfm)
  TRUNDLE_FIELD(double, erp)
  TRUNDLE_FIELD(double, contact_max_correcting_vel)
  TRUNDLE_FIELD(double, contact_surface_layer)
  TRUNDLE_MESSAGE(Vector3d, gravity)
  TRUNDLE_FIELD(bool, enable_physics)
  TRUNDLE_FIELD(double, real_time_factor)
  TRUNDLE_FIELD(double, real_time_update_rate)
  TRUNDLE_FIELD(double, max_step_size)
  TRUNDLE_FIELD(std::string, profile_name)
  TRUNDLE_MESSAGE(Vector3d, magnetic_field)

 public:
  void Clear() { *this = Physics(); }
};

class WorldReset {
  TRUNDLE_FIELD(bool, all)
  TRUNDLE_FIELD(bool, time_only)
  TRUNDLE_FIELD(bool, model_only)

 public:
  void Clear() { *this = WorldReset(); }
};

class WorldControl {
  TRUNDLE_FIELD(bool, pause)
  TRUNDLE_FIELD(bool, step)
  TRUNDLE_FIELD(uint32_t, multi_step)
  TRUNDLE_MESSAGE(WorldReset, reset)
  TRUNDLE_FIELD(uint32_t, seed)
  TRUNDLE_MESSAGE(Time, run_to_sim_time)

 public:
  void Clear() { *this = WorldControl(); }
};

class Request {
  TRUNDLE_FIELD(int32_t, id)
  TRUNDLE_FIELD(std::string, request)
  TRUNDLE_FIELD(std::string, data)
  TRUNDLE_FIELD(double, dbl_data)

 public:
  void Clear() { *this = Request(); }
};

class Response {
  TRUNDLE_FIELD(int32_t, id)
  TRUNDLE_FIELD(std::string, request)
  TRUNDLE_FIELD(std::string, response)
  TRUNDLE_FIELD(std::string, type)
  TRUNDLE_FIELD(std::string, serialized_data)

 public:
  void Clear() { *this = Response(); }
};

class BoxGeom {
  TRUNDLE_MESSAGE(Vector3d, size)

 public:
  void Clear() { *this = BoxGeom(); }
};

class CylinderGeom {
  TRUNDLE_FIELD(double, radius)
  TRUNDLE_FIELD(double, length)

 public:
  void Clear() { *this = CylinderGeom(); }
};

class SphereGeom {
  TRUNDLE_FIELD(double, radius)

 public:
  void Clear() { *this = SphereGeom(); }
};

class PlaneGeom {
  TRUNDLE_MESSAGE(Vector3d, normal)
  TRUNDLE_MESSAGE(Vector2d, size)
  TRUNDLE_FIELD(double, d)

 public:
  void Clear() { *this = PlaneGeom(); }
};

class MeshGeom {
  TRUNDLE_FIELD(std::string, filename)
  TRUNDLE_MESSAGE(Vector3d, scale)
  TRUNDLE_FIELD(std::string, submesh)
  TRUNDLE_FIELD(bool, center_submesh)

 public:
  void Clear() { *this = MeshGeom(); }
};

class Geometry {
 public:
  enum Type { BOX = 1, CYLINDER, SPHERE, PLANE, IMAGE, HEIGHTMAP, MESH, TRIANGLE_FAN, LINE_STRIP, POLYLINE, EMPTY };

  TRUNDLE_FIELD(Type, type)
  TRUNDLE_MESSAGE(BoxGeom, box)
  TRUNDLE_MESSAGE(CylinderGeom, cylinder)
  TRUNDLE_MESSAGE(PlaneGeom, plane)
  TRUNDLE_MESSAGE(SphereGeom, sphere)
  TRUNDLE_MESSAGE(MeshGeom, mesh)

 public:
  void Clear() { *this = Geometry(); }
};

class Material_Script {
  TRUNDLE_FIELDS(std::string, uri)
  TRUNDLE_FIELD(std::string, name)

 public:
  void Clear() { *this = Material_Script(); }
};

class Material {
 public:
  typedef Material_Script Script;

  TRUNDLE_MESSAGE(Material_Script, script)
  TRUNDLE_FIELD(std::string, normal_map)
  TRUNDLE_MESSAGE(Color, ambient)
  TRUNDLE_MESSAGE(Color, diffuse)
  TRUNDLE_MESSAGE(Color, specular)
  TRUNDLE_MESSAGE(Color, emissive)
  TRUNDLE_FIELD(bool, lighting)

 public:
  void Clear() { *this = Material(); }
};

class Visual {
  TRUNDLE_FIELD(std::string, name)
  TRUNDLE_FIELD(uint32_t, id)
  TRUNDLE_FIELD(std::string, parent_name)
  TRUNDLE_FIELD(uint32_t, parent_id)
  TRUNDLE_FIELD(bool, cast_shadows)
  TRUNDLE_FIELD(double, transparency)
  TRUNDLE_FIELD(double, laser_retro)
  TRUNDLE_MESSAGE(Pose, pose)
  TRUNDLE_MESSAGE(Geometry, geometry)
  TRUNDLE_MESSAGE(Material, material)
  TRUNDLE_FIELD(bool, visible)
  TRUNDLE_FIELD(bool, delete_me)
  TRUNDLE_FIELD(bool, is_static)
  TRUNDLE_MESSAGE(Vector3d, scale)

 public:
  void Clear() { *this = Visual(); }
};

// A request with a number of its own, to delete.
Request* CreateRequest(const std::string& request, const std::string& data = "");

typedef boost::shared_ptr<Factory> FactoryPtr;
typedef boost::shared_ptr<Physics> PhysicsPtr;
typedef boost::shared_ptr<WorldReset> WorldResetPtr;
typedef boost::shared_ptr<WorldControl> WorldControlPtr;
typedef boost::shared_ptr<Request> RequestPtr;
typedef boost::shared_ptr<Response> ResponsePtr;
typedef boost::shared_ptr<BoxGeom> BoxGeomPtr;
typedef boost::shared_ptr<CylinderGeom> CylinderGeomPtr;
typedef boost::shared_ptr<SphereGeom> SphereGeomPtr;
typedef boost::shared_ptr<PlaneGeom> PlaneGeomPtr;
typedef boost::shared_ptr<MeshGeom> MeshGeomPtr;
typedef boost::shared_ptr<Geometry> GeometryPtr;
typedef boost::shared_ptr<Material> MaterialPtr;
typedef boost::shared_ptr<Visual> VisualPtr;

}  // namespace msgs
}  // namespace gazebo

typedef const boost::shared_ptr<const gazebo::msgs::Factory> ConstFactoryPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Physics> ConstPhysicsPtr;
typedef const boost::shared_ptr<const gazebo::msgs::WorldReset> ConstWorldResetPtr;
typedef const boost::shared_ptr<const gazebo::msgs::WorldControl> ConstWorldControlPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Request> ConstRequestPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Response> ConstResponsePtr;
typedef const boost::shared_ptr<const gazebo::msgs::BoxGeom> ConstBoxGeomPtr;
typedef const boost::shared_ptr<const gazebo::msgs::CylinderGeom> ConstCylinderGeomPtr;
typedef const boost::shared_ptr<const gazebo::msgs::SphereGeom> ConstSphereGeomPtr;
typedef const boost::shared_ptr<const gazebo::msgs::PlaneGeom> ConstPlaneGeomPtr;
typedef const boost::shared_ptr<const gazebo::msgs::MeshGeom> ConstMeshGeomPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Geometry> ConstGeometryPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Material> ConstMaterialPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Visual> ConstVisualPtr;

#endif
