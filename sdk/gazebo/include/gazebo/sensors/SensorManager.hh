#ifndef GAZEBO_SENSORS_SENSORMANAGER_HH_
#define GAZEBO_SENSORS_SENSORMANAGER_HH_

#include <string>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// The sensors that have a plugin in C++.
class SensorManager {
 public:
  static SensorManager* Instance();

  // By its name, or its scoped name if several have that; null if there is none.
  SensorPtr GetSensor(const std::string& name) const;
  Sensor_V GetSensors() const;
  bool SensorsInitialized() const { return true; }

  // For the library: the sensor of an element in a link, or in a joint.
  SensorPtr Make(const physics::WorldPtr& world, const physics::BasePtr& parent, const sdf::ElementPtr& sdf);
  void Remove(const void* world, const std::string& model);
};

inline SensorPtr get_sensor(const std::string& name) { return SensorManager::Instance()->GetSensor(name); }

}  // namespace sensors
}  // namespace gazebo

#endif
