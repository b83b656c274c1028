#ifndef GAZEBO_SENSORS_SENSORSIFACE_HH_
#define GAZEBO_SENSORS_SENSORSIFACE_HH_

#include <gazebo/sensors/sensors.hh>

#endif
