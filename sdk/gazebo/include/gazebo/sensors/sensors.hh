#ifndef GAZEBO_SENSORS_SENSORS_HH_
#define GAZEBO_SENSORS_SENSORS_HH_

#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/CameraSensor.hh>
#include <gazebo/sensors/ContactSensor.hh>
#include <gazebo/sensors/DepthCameraSensor.hh>
#include <gazebo/sensors/ForceTorqueSensor.hh>
#include <gazebo/sensors/GpsSensor.hh>
#include <gazebo/sensors/GpuRaySensor.hh>
#include <gazebo/sensors/ImuSensor.hh>
#include <gazebo/sensors/LogicalCameraSensor.hh>
#include <gazebo/sensors/MultiCameraSensor.hh>
#include <gazebo/sensors/Noise.hh>
#include <gazebo/sensors/RaySensor.hh>
#include <gazebo/sensors/Sensor.hh>
#include <gazebo/sensors/SensorManager.hh>
#include <gazebo/sensors/SonarSensor.hh>

#endif
