#ifndef GAZEBO_SENSORS_SENSORTYPES_HH_
#define GAZEBO_SENSORS_SENSORTYPES_HH_

#include <memory>
#include <vector>

#include <boost/pointer_cast.hpp>  // boost::dynamic_pointer_cast, as in Gazebo up to 6

#include <gazebo/common/CommonTypes.hh>

namespace gazebo {
namespace sensors {

class Sensor;
class RaySensor;
class GpuRaySensor;
class CameraSensor;
class DepthCameraSensor;
class MultiCameraSensor;
class ImuSensor;
class ContactSensor;
class GpsSensor;
class SonarSensor;
class LogicalCameraSensor;
class ForceTorqueSensor;
class Noise;
typedef std::shared_ptr<Sensor> SensorPtr;
typedef std::shared_ptr<RaySensor> RaySensorPtr;
typedef std::shared_ptr<GpuRaySensor> GpuRaySensorPtr;
typedef std::shared_ptr<CameraSensor> CameraSensorPtr;
typedef std::shared_ptr<DepthCameraSensor> DepthCameraSensorPtr;
typedef std::shared_ptr<MultiCameraSensor> MultiCameraSensorPtr;
typedef std::shared_ptr<ImuSensor> ImuSensorPtr;
typedef std::shared_ptr<ContactSensor> ContactSensorPtr;
typedef std::shared_ptr<GpsSensor> GpsSensorPtr;
typedef std::shared_ptr<SonarSensor> SonarSensorPtr;
typedef std::shared_ptr<LogicalCameraSensor> LogicalCameraSensorPtr;
typedef std::shared_ptr<ForceTorqueSensor> ForceTorqueSensorPtr;
typedef std::shared_ptr<Noise> NoisePtr;
typedef std::vector<SensorPtr> Sensor_V;

enum SensorNoiseType { NO_NOISE, CAMERA_NOISE, GPU_RAY_NOISE, RAY_NOISE };

enum SensorCategory { IMAGE = 0, RAY = 1, OTHER = 2, CATEGORY_COUNT = 3 };

}  // namespace sensors
}  // namespace gazebo

#endif
