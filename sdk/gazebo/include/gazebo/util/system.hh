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

#endif
