#ifndef GAZEBO_SENSORS_SENSORTYPES_HH_
#define GAZEBO_SENSORS_SENSORTYPES_HH_

#include <memory>
#include <vector>

#include <gazebo/common/CommonTypes.hh>

namespace gazebo {
namespace sensors {

class Sensor;
typedef std::shared_ptr<Sensor> SensorPtr;
typedef std::vector<SensorPtr> Sensor_V;

}  // namespace sensors
}  // namespace gazebo

#endif
