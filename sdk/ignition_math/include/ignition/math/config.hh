// Version of ignition-math of Gazebo 11, whose names the kit has.
#ifndef IGNITION_MATH_CONFIG_HH_
#define IGNITION_MATH_CONFIG_HH_

#define IGNITION_MATH_MAJOR_VERSION 6
#define IGNITION_MATH_MINOR_VERSION 0
#define IGNITION_MATH_VERSION "6.0"
#define IGNITION_MATH_VERSION_FULL "6.0.0"

#endif
