// Visibility of classes in libraries.
#ifndef GAZEBO_UTIL_SYSTEM_HH_
#define GAZEBO_UTIL_SYSTEM_HH_

#ifdef __GNUC__
#define GAZEBO_VISIBLE __attribute__((visibility("default")))
#define GAZEBO_HIDDEN __attribute__((visibility("hidden")))
#else
#define GAZEBO_VISIBLE
#define GAZEBO_HIDDEN
#endif
#define GZ_COMMON_VISIBLE GAZEBO_VISIBLE
#define GZ_MSGS_VISIBLE GAZEBO_VISIBLE
#define GZ_PHYSICS_VISIBLE GAZEBO_VISIBLE
#define GZ_PLUGIN_VISIBLE GAZEBO_VISIBLE
#define GZ_RENDERING_VISIBLE GAZEBO_VISIBLE
#define GZ_SENSORS_VISIBLE GAZEBO_VISIBLE
#define GZ_TRANSPORT_VISIBLE GAZEBO_VISIBLE
#define GZ_UTIL_VISIBLE GAZEBO_VISIBLE

#endif
