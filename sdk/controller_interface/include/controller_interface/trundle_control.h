/* Interface between the simulator and controllers of ros_control, in C, so that neither links to the other.
 *
 * All functions are called on the simulation's thread. */
#ifndef CONTROLLER_INTERFACE_TRUNDLE_CONTROL_H_
#define CONTROLLER_INTERFACE_TRUNDLE_CONTROL_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this file, and of the classes that controllers see. */
#define TRUNDLE_CONTROL_ABI 1

enum TrundleControlInterface { TRUNDLE_EFFORT, TRUNDLE_VELOCITY, TRUNDLE_POSITION };

/* Joint behind a transmission, with the addresses of its state and command. */
struct TrundleControlJoint {
  const char* name;
  int interface;
  double *position, *velocity, *effort, *command;
};

struct TrundleControlKit {
  int abi;
  /* Make a robot of joints whose numbers stay where they are. */
  void* (*open_robot)(const struct TrundleControlJoint* joints, int count);
  /* Robot of a library's gazebo_ros_control::RobotHWSim; null if none was made for this model. */
  void* (*find_robot)(const char* model);
  /* Joint of a RobotHWSim by its number, with the addresses of its own numbers; 0: there is none. */
  int (*joint)(void* robot, int number, struct TrundleControlJoint* out);
  void (*read)(void* robot, int64_t time_ns, int64_t period_ns);
  void (*write)(void* robot, int64_t time_ns, int64_t period_ns);
  /* Begin or end an emergency stop. */
  void (*stop_robot)(void* robot, int is_active);
  void (*close_robot)(void* robot);
  /* Make a controller of an opened library's class, and initialize it; null with a reason.
     root: namespace of the robot; name: of the controller in it. */
  void* (*load)(void* robot, const char* class_name, const char* root, const char* name, char* reason, int size);
  /* Write claimed resources as pairs of interface and resource, each with a 0 after it; return their length. */
  int (*claims)(void* controller, char* out, int size);
  /* Return 0 with a reason if the controller threw an exception, or refused. */
  int (*start)(void* controller, int64_t time_ns, char* reason, int size);
  int (*update)(void* controller, int64_t time_ns, int64_t period_ns, char* reason, int size);
  int (*stop)(void* controller, int64_t time_ns, char* reason, int size);
  void (*close)(void* controller);
};

const struct TrundleControlKit* trundle_control_kit(void);

#ifdef __cplusplus
}
#endif

#endif
