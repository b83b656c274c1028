// Sensors whose readings the simulator measures; a sensor measures while it is active, or anybody is connected with it.
#ifndef GAZEBO_SENSORS_SENSOR_HH_
#define GAZEBO_SENSORS_SENSOR_HH_

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include <sdf/sdf.hh>

#include <gazebo/trundle_host.h>
#include <gazebo/common/Event.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/math/Pose.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/sensors/SensorTypes.hh>

namespace gazebo {
namespace sensors {

class Sensor : public std::enable_shared_from_this<Sensor> {
 public:
  virtual ~Sensor() {}

  std::string Name() const { return name_; }
  // `world::model::link::sensor`.
  std::string ScopedName() const { return world_name_ + "::" + parent_name_ + "::" + name_; }
  // `model::link`.
  std::string ParentName() const { return parent_name_; }
  uint32_t ParentId() const { return parent_id_; }
  uint32_t Id() const { return id_; }
  std::string Type() const { return type_; }
  std::string WorldName() const { return world_name_; }
  virtual std::string Topic() const { return topic_; }
  SensorCategory Category() const { return category_; }
  // In the parent's frame.
  ignition::math::Pose3d Pose() const { return pose_; }
  // [Hz], of the file.
  double UpdateRate() const { return rate_; }
  // Readings come at the file's rate; a lower one leaves some out.
  void SetUpdateRate(double rate) { rate_ = rate; }
  bool Visualize() const { return visualize_; }
  virtual bool IsActive() const { return is_active_; }
  virtual void SetActive(bool is_active) { is_active_ = is_active; }
  virtual void Init() {}
  // Readings come by themselves.
  void Update(bool) {}
  common::Time LastUpdateTime() const { return last_; }
  common::Time LastMeasurementTime() const { return last_; }
  sdf::ElementPtr GetSDF() const { return sdf_; }

  // Null where the kind of sensor has none that a plugin can set: all but rays.
  virtual NoisePtr Noise(SensorNoiseType) const { return NoisePtr(); }
  NoisePtr GetNoise(unsigned int = 0) const { return Noise(RAY_NOISE); }

  // Called after each reading.
  event::ConnectionPtr ConnectUpdated(std::function<void()> subscriber) { return updated_.Connect(subscriber); }
  void DisconnectUpdated(event::ConnectionPtr connection) { updated_.Disconnect(connection); }

  // Names up to Gazebo 6.
  std::string GetName() const { return Name(); }
  std::string GetScopedName() const { return ScopedName(); }
  std::string GetParentName() const { return ParentName(); }
  uint32_t GetParentId() const { return ParentId(); }
  uint32_t GetId() const { return Id(); }
  std::string GetType() const { return Type(); }
  std::string GetWorldName() const { return WorldName(); }
  std::string GetTopic() const { return Topic(); }
  math::Pose GetPose() const { return Pose(); }
  double GetUpdateRate() const { return UpdateRate(); }
  bool GetVisualize() const { return Visualize(); }
  common::Time GetLastUpdateTime() const { return last_; }
  common::Time GetLastMeasurementTime() const { return last_; }

  // For the library: whether readings are wanted, and the next one.
  virtual bool IsWanted() const { return IsActive() || updated_.ConnectionCount() > 0; }
  void Take(const void* world, int64_t time_ns, const TrundleGazeboReading& reading);

 protected:
  explicit Sensor(SensorCategory category) : category_(category) {}
  // Of the file's <sensor>.
  virtual void Read(const sdf::ElementPtr&) {}
  virtual void Set(const TrundleGazeboReading&) {}
  // Tell of a reading: to topics, and to functions that get its data.
  virtual void Tell(const void*) {}
  // False: more readings of the same time follow.
  virtual bool IsComplete() const { return true; }
  template <typename M>
  static double Number(const M& sdf, const char* name, double missing) {
    return sdf ? sdf->template Get<double>(name, missing).first : missing;
  }

  mutable std::mutex mutex_;
  std::string topic_;
  common::Time last_;

 private:
  friend class SensorManager;
  std::string name_, parent_name_, type_, world_name_;
  uint32_t id_ = 0, parent_id_ = 0;
  SensorCategory category_;
  ignition::math::Pose3d pose_;
  double rate_ = 0.0;
  bool visualize_ = false;
  std::atomic<bool> is_active_{false};
  sdf::ElementPtr sdf_;
  event::EventT<void()> updated_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
