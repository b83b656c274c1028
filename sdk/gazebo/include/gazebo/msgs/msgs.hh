// Messages between plugins of the process.
#ifndef GAZEBO_MSGS_MSGS_HH_
#define GAZEBO_MSGS_MSGS_HH_

#include <string>

#include <boost/shared_ptr.hpp>

#include <ignition/math/Color.hh>
#include <ignition/math/Pose3.hh>

#include <gazebo/msgs/fields.h>
#include <gazebo/common/Time.hh>
#include <gazebo/math/Pose.hh>

namespace gazebo {
namespace msgs {

class Time {
  TRUNDLE_FIELD(int32_t, sec)
  TRUNDLE_FIELD(int32_t, nsec)

 public:
  void Clear() { *this = Time(); }
};

class Vector2d {
  TRUNDLE_FIELD(double, x)
  TRUNDLE_FIELD(double, y)

 public:
  void Clear() { *this = Vector2d(); }
};

class Vector3d {
  TRUNDLE_FIELD(double, x)
  TRUNDLE_FIELD(double, y)
  TRUNDLE_FIELD(double, z)

 public:
  void Clear() { *this = Vector3d(); }
};

class Quaternion {
  TRUNDLE_FIELD(double, x)
  TRUNDLE_FIELD(double, y)
  TRUNDLE_FIELD(double, z)
  TRUNDLE_FIELD(double, w)

 public:
  void Clear() { *this = Quaternion(); }
};

class Color {
  TRUNDLE_FIELD(float, r)
  TRUNDLE_FIELD(float, g)
  TRUNDLE_FIELD(float, b)
  TRUNDLE_FIELD(float, a)

 public:
  void Clear() { *this = Color(); }
};

class Pose {
  TRUNDLE_FIELD(std::string, name)
  TRUNDLE_FIELD(uint32_t, id)
  TRUNDLE_MESSAGE(Vector3d, position)
  TRUNDLE_MESSAGE(Quaternion, orientation)

 public:
  void Clear() { *this = Pose(); }
};

class PoseStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGE(Pose, pose)

 public:
  void Clear() { *this = PoseStamped(); }
};

class PosesStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGES(Pose, pose)

 public:
  void Clear() { *this = PosesStamped(); }
};

class Wrench {
  TRUNDLE_MESSAGE(Vector3d, force)
  TRUNDLE_MESSAGE(Vector3d, torque)

 public:
  void Clear() { *this = Wrench(); }
};

class WrenchStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGE(Wrench, wrench)

 public:
  void Clear() { *this = WrenchStamped(); }
};

class Twist {
  TRUNDLE_MESSAGE(Vector3d, linear)
  TRUNDLE_MESSAGE(Vector3d, angular)

 public:
  void Clear() { *this = Twist(); }
};

class JointWrench {
  TRUNDLE_FIELD(std::string, body_1_name)
  TRUNDLE_FIELD(uint32_t, body_1_id)
  TRUNDLE_FIELD(std::string, body_2_name)
  TRUNDLE_FIELD(uint32_t, body_2_id)
  TRUNDLE_MESSAGE(Wrench, body_1_wrench)
  TRUNDLE_MESSAGE(Wrench, body_2_wrench)

 public:
  void Clear() { *this = JointWrench(); }
};

class Contact {
  TRUNDLE_FIELD(std::string, collision1)
  TRUNDLE_FIELD(std::string, collision2)
  TRUNDLE_MESSAGES(Vector3d, position)
  TRUNDLE_MESSAGES(Vector3d, normal)
  TRUNDLE_FIELDS(double, depth)
  TRUNDLE_MESSAGES(JointWrench, wrench)
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_FIELD(std::string, world)

 public:
  void Clear() { *this = Contact(); }
};

class Contacts {
  TRUNDLE_MESSAGES(Contact, contact)
  TRUNDLE_MESSAGE(Time, time)

 public:
  void Clear() { *this = Contacts(); }
};

class GzString {
  TRUNDLE_FIELD(std::string, data)

 public:
  void Clear() { *this = GzString(); }
};

class Int {
  TRUNDLE_FIELD(int32_t, data)

 public:
  void Clear() { *this = Int(); }
};

class Double {
  TRUNDLE_FIELD(double, data)

 public:
  void Clear() { *this = Double(); }
};

class Boolean {
  TRUNDLE_FIELD(bool, data)

 public:
  void Clear() { *this = Boolean(); }
};

class GzString_V {
  TRUNDLE_FIELDS(std::string, data)

 public:
  void Clear() { *this = GzString_V(); }
};

class PID {
  TRUNDLE_FIELD(double, target)
  TRUNDLE_FIELD(double, p_gain)
  TRUNDLE_FIELD(double, i_gain)
  TRUNDLE_FIELD(double, d_gain)
  TRUNDLE_FIELD(double, i_max)
  TRUNDLE_FIELD(double, i_min)
  TRUNDLE_FIELD(double, limit)

 public:
  void Clear() { *this = PID(); }
};

class JointCmd {
  TRUNDLE_FIELD(std::string, name)
  TRUNDLE_FIELD(int32_t, axis)
  TRUNDLE_FIELD(double, force)
  TRUNDLE_MESSAGE(PID, position)
  TRUNDLE_MESSAGE(PID, velocity)
  TRUNDLE_FIELD(bool, reset)

 public:
  void Clear() { *this = JointCmd(); }
};

class WorldStatistics {
  TRUNDLE_MESSAGE(Time, sim_time)
  TRUNDLE_MESSAGE(Time, pause_time)
  TRUNDLE_MESSAGE(Time, real_time)
  TRUNDLE_FIELD(bool, paused)
  TRUNDLE_FIELD(uint64_t, iterations)
  TRUNDLE_FIELD(int32_t, model_count)

 public:
  void Clear() { *this = WorldStatistics(); }
};

class LaserScan {
  TRUNDLE_FIELD(std::string, frame)
  TRUNDLE_MESSAGE(Pose, world_pose)
  TRUNDLE_FIELD(double, angle_min)
  TRUNDLE_FIELD(double, angle_max)
  TRUNDLE_FIELD(double, angle_step)
  TRUNDLE_FIELD(double, range_min)
  TRUNDLE_FIELD(double, range_max)
  TRUNDLE_FIELD(uint32_t, count)
  TRUNDLE_FIELD(double, vertical_angle_min)
  TRUNDLE_FIELD(double, vertical_angle_max)
  TRUNDLE_FIELD(double, vertical_angle_step)
  TRUNDLE_FIELD(uint32_t, vertical_count)
  TRUNDLE_FIELDS(double, ranges)
  TRUNDLE_FIELDS(double, intensities)

 public:
  void Clear() { *this = LaserScan(); }
};

class LaserScanStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGE(LaserScan, scan)

 public:
  void Clear() { *this = LaserScanStamped(); }
};

class Sonar {
  TRUNDLE_FIELD(std::string, frame)
  TRUNDLE_MESSAGE(Pose, world_pose)
  TRUNDLE_FIELD(double, range_min)
  TRUNDLE_FIELD(double, range_max)
  TRUNDLE_FIELD(double, radius)
  TRUNDLE_FIELD(double, range)

 public:
  void Clear() { *this = Sonar(); }
};

class SonarStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGE(Sonar, sonar)

 public:
  void Clear() { *this = SonarStamped(); }
};

class LogicalCameraImage_Model {
  TRUNDLE_FIELD(std::string, name)
  TRUNDLE_MESSAGE(Pose, pose)

 public:
  void Clear() { *this = LogicalCameraImage_Model(); }
};

class LogicalCameraImage {
 public:
  typedef LogicalCameraImage_Model Model;
  TRUNDLE_MESSAGE(Pose, pose)
  TRUNDLE_MESSAGES(Model, model)

 public:
  void Clear() { *this = LogicalCameraImage(); }
};

class Tactile {
  TRUNDLE_FIELDS(std::string, collision_name)
  TRUNDLE_FIELDS(int32_t, collision_id)
  TRUNDLE_FIELDS(double, pressure)
  TRUNDLE_MESSAGE(Time, time)

 public:
  void Clear() { *this = Tactile(); }
};

class Vector3d_V {
  TRUNDLE_MESSAGES(Vector3d, vector3)

 public:
  void Clear() { *this = Vector3d_V(); }
};

inline void Set(Vector3d* to, const ignition::math::Vector3d& v) {
  to->set_x(v.X());
  to->set_y(v.Y());
  to->set_z(v.Z());
}
inline void Set(Vector2d* to, const ignition::math::Vector2d& v) {
  to->set_x(v.X());
  to->set_y(v.Y());
}
inline void Set(Quaternion* to, const ignition::math::Quaterniond& q) {
  to->set_w(q.W());
  to->set_x(q.X());
  to->set_y(q.Y());
  to->set_z(q.Z());
}
inline void Set(Pose* to, const ignition::math::Pose3d& pose) {
  Set(to->mutable_position(), pose.Pos());
  Set(to->mutable_orientation(), pose.Rot());
}
inline void Set(Color* to, const ignition::math::Color& c) {
  to->set_r(c.R());
  to->set_g(c.G());
  to->set_b(c.B());
  to->set_a(c.A());
}
inline void Set(Time* to, const common::Time& t) {
  to->set_sec(t.sec);
  to->set_nsec(t.nsec);
}
inline ignition::math::Vector3d ConvertIgn(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline ignition::math::Quaterniond ConvertIgn(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline ignition::math::Pose3d ConvertIgn(const Pose& p) {
  return {ConvertIgn(p.position()), ConvertIgn(p.orientation())};
}
inline ignition::math::Color Convert(const Color& c) { return {c.r(), c.g(), c.b(), c.a()}; }
inline common::Time Convert(const Time& t) { return common::Time(t.sec(), t.nsec()); }
inline math::Vector3 Convert(const Vector3d& v) { return ConvertIgn(v); }
inline math::Quaternion Convert(const Quaternion& q) { return ConvertIgn(q); }
inline math::Pose Convert(const Pose& p) { return ConvertIgn(p); }
inline Vector3d Convert(const ignition::math::Vector3d& v) {
  Vector3d to;
  Set(&to, v);
  return to;
}
inline Quaternion Convert(const ignition::math::Quaterniond& q) {
  Quaternion to;
  Set(&to, q);
  return to;
}
inline Pose Convert(const ignition::math::Pose3d& p) {
  Pose to;
  Set(&to, p);
  return to;
}
inline Time Convert(const common::Time& t) {
  Time to;
  Set(&to, t);
  return to;
}

typedef boost::shared_ptr<Time> TimePtr;
typedef boost::shared_ptr<Vector2d> Vector2dPtr;
typedef boost::shared_ptr<Vector3d> Vector3dPtr;
typedef boost::shared_ptr<Quaternion> QuaternionPtr;
typedef boost::shared_ptr<Color> ColorPtr;
typedef boost::shared_ptr<Pose> PosePtr;
typedef boost::shared_ptr<PoseStamped> PoseStampedPtr;
typedef boost::shared_ptr<PosesStamped> PosesStampedPtr;
typedef boost::shared_ptr<Wrench> WrenchPtr;
typedef boost::shared_ptr<WrenchStamped> WrenchStampedPtr;
typedef boost::shared_ptr<Twist> TwistPtr;
typedef boost::shared_ptr<JointWrench> JointWrenchPtr;
typedef boost::shared_ptr<Contact> ContactPtr;
typedef boost::shared_ptr<Contacts> ContactsPtr;
typedef boost::shared_ptr<GzString> GzStringPtr;
typedef boost::shared_ptr<Int> IntPtr;
typedef boost::shared_ptr<Double> DoublePtr;
typedef boost::shared_ptr<Boolean> BooleanPtr;
typedef boost::shared_ptr<GzString_V> GzString_VPtr;
typedef boost::shared_ptr<PID> PIDPtr;
typedef boost::shared_ptr<JointCmd> JointCmdPtr;
typedef boost::shared_ptr<WorldStatistics> WorldStatisticsPtr;
typedef boost::shared_ptr<LaserScan> LaserScanPtr;
typedef boost::shared_ptr<LaserScanStamped> LaserScanStampedPtr;
typedef boost::shared_ptr<SonarStamped> SonarStampedPtr;
typedef boost::shared_ptr<LogicalCameraImage> LogicalCameraImagePtr;

}  // namespace msgs
}  // namespace gazebo

// Types of callbacks' arguments, outside of the namespace, as Gazebo's.
typedef const boost::shared_ptr<const gazebo::msgs::Time> ConstTimePtr;
typedef const boost::shared_ptr<const gazebo::msgs::Vector2d> ConstVector2dPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Vector3d> ConstVector3dPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Quaternion> ConstQuaternionPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Color> ConstColorPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Pose> ConstPosePtr;
typedef const boost::shared_ptr<const gazebo::msgs::PoseStamped> ConstPoseStampedPtr;
typedef const boost::shared_ptr<const gazebo::msgs::PosesStamped> ConstPosesStampedPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Wrench> ConstWrenchPtr;
typedef const boost::shared_ptr<const gazebo::msgs::WrenchStamped> ConstWrenchStampedPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Twist> ConstTwistPtr;
typedef const boost::shared_ptr<const gazebo::msgs::JointWrench> ConstJointWrenchPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Contact> ConstContactPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Contacts> ConstContactsPtr;
typedef const boost::shared_ptr<const gazebo::msgs::GzString> ConstGzStringPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Int> ConstIntPtr;
typedef const boost::shared_ptr<const gazebo::msgs::Double> ConstDoublePtr;
typedef const boost::shared_ptr<const gazebo::msgs::Boolean> ConstBooleanPtr;
typedef const boost::shared_ptr<const gazebo::msgs::GzString_V> ConstGzString_VPtr;
typedef const boost::shared_ptr<const gazebo::msgs::PID> ConstPIDPtr;
typedef const boost::shared_ptr<const gazebo::msgs::JointCmd> ConstJointCmdPtr;
typedef const boost::shared_ptr<const gazebo::msgs::WorldStatistics> ConstWorldStatisticsPtr;
typedef const boost::shared_ptr<const gazebo::msgs::LaserScan> ConstLaserScanPtr;
typedef const boost::shared_ptr<const gazebo::msgs::LaserScanStamped> ConstLaserScanStampedPtr;
typedef const boost::shared_ptr<const gazebo::msgs::SonarStamped> ConstSonarStampedPtr;
typedef const boost::shared_ptr<const gazebo::msgs::LogicalCameraImage> ConstLogicalCameraImagePtr;

#include <gazebo/msgs/image_messages.h>
#include <gazebo/msgs/world_messages.h>

#endif
