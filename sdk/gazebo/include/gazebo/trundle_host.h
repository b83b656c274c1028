/* Interface between the simulator and the kit's Gazebo library, in C, so that neither links to the other.
 *
 * Lengths [m], angles [rad], times [ns], world axes, quaternions as w x y z. */
#ifndef GAZEBO_TRUNDLE_HOST_H_
#define GAZEBO_TRUNDLE_HOST_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this file, of the plugins' registration and of the classes that plugins see. */
#define TRUNDLE_GAZEBO_ABI 2

enum TrundleGazeboKind { TRUNDLE_MODEL, TRUNDLE_LINK, TRUNDLE_JOINT };

/* What is read, with its number of values. */
enum TrundleGazeboValue {
  TRUNDLE_LINK_POSE,      /* 7: position and rotation of the link's frame */
  TRUNDLE_LINK_TWIST,     /* 6: velocity of the frame's origin, angular velocity */
  TRUNDLE_LINK_IS_FREE,   /* 1: whether the link can be moved by itself */
  TRUNDLE_JOINT_POSITION, /* 1, of an axis */
  TRUNDLE_JOINT_VELOCITY, /* 1, of an axis */
  TRUNDLE_JOINT_EFFORT,   /* 1, of an axis: of motors and forces */
  TRUNDLE_JOINT_AXES,     /* 1: number of axes */
  TRUNDLE_GRAVITY,        /* 3 */
  TRUNDLE_JOINT_WRENCH    /* 6: force and torque of the parent on the child in the last step, at the joint */
};

/* What is written, with its number of values. */
enum TrundleGazeboCommand {
  TRUNDLE_ADD_WRENCH,   /* 6: force at the link's centre of mass and torque, for the coming step */
  TRUNDLE_SET_POSE,     /* 7: of a free link's frame */
  TRUNDLE_SET_TWIST,    /* 6: of a free link's frame */
  TRUNDLE_SET_COLLIDE,  /* 1: whether a link's collisions touch anything; until a reset */
  TRUNDLE_SET_POSITION, /* 1: of a joint's axis */
  TRUNDLE_SET_SPEED,    /* 1: of a joint's axis, as if by an impulse that only the child feels; for one step */
  TRUNDLE_DRIVE,        /* 2: speed and largest effort of a joint's motor, until the next */
  TRUNDLE_ADD_EFFORT,   /* 1: effort on a joint's axis, for the coming step */
  TRUNDLE_SET_PHYSICS   /* 1: whether time moves anything; of the world */
};

/* Contact point of the last step. */
struct TrundleGazeboContact {
  const char *collision1, *collision2; /* `model::link::collision` */
  double position[3];
  double normal[3]; /* into the first collision */
  double force[3];  /* on the first collision */
  double depth;
};

/* Reading of a sensor; what its kind does not have is null. */
struct TrundleGazeboReading {
  /* ray: ranges, then as many intensities; imu: rotation, angular velocity, acceleration; gps: latitude, longitude
     [rad], altitude; sonar: range; force_torque: force, torque; multicamera: number of the camera;
     logical_camera: positions and rotations of the models that `contacts` name. */
  const double* values;
  int64_t count;
  /* Cameras: rows of colors, three bytes each, and depths. */
  const unsigned char* image;
  const float* depths;
  int width, height;
  const struct TrundleGazeboContact* contacts;
  int contact_count;
};

struct TrundleGazeboHost {
  int abi;
  void* self;
  /* Number of a `model`, `model::link` or `model::joint`; -1: there is none. It keeps its number while it exists. */
  int (*find)(void* self, int kind, const char* name);
  /* Read values; return their number, 0 if the object is gone. Any thread. */
  int (*read)(void* self, int value, int number, int axis, double* out, int capacity);
  /* Write values; return whether they are accepted. Any thread; done before the coming step. */
  int (*write)(void* self, int command, int number, int axis, const double* values, int count);
  /* Ask for what is done between two steps: words and numbers as in the simulator's list. Any thread. */
  void (*request)(void* self, const char* const* words, int word_count, const double* numbers, int number_count);
  /* Time of the simulation. */
  int64_t (*time_ns)(void* self);
  int64_t (*step_ns)(void* self);
  /* Contacts of the last step; return their number, of which at most `capacity` are written. During after_step alone.
   */
  int (*contacts)(void* self, struct TrundleGazeboContact* out, int capacity);
  /* Print a warning, as of a plugin that failed. Any thread. */
  void (*warn)(void* self, const char* text);
  /* Name of the plugin whose code runs in this thread, or null; for messages after a crash. */
  void (*enter)(void* self, const char* plugin);
  /* Around what a plugin does before a step, but not in `before_step`: reads and writes reach the simulation. */
  void (*begin_call)(void* self);
  void (*end_call)(void* self);
};

/* What the library does for the simulator; all on the simulation's thread. */
struct TrundleGazeboKit {
  int abi;
  /* Make a world from its elements; see `elements` in the library for their format. */
  void* (*open)(const struct TrundleGazeboHost* host, const char* name, const char* elements, int64_t size);
  void (*close)(void* world);
  void (*add_model)(void* world, const char* name, const char* elements, int64_t size);
  void (*remove_model)(void* world, const char* name);
  /* Load a plugin of a library opened by dlopen; return its number from 1 on, or 0 with a reason.
     parent: name of the model or of the world, or `model::link::sensor`, in place of the link perhaps a joint. */
  int (*load)(void* world, void* library, const char* parent, const char* name, const char* file, const char* elements,
              int64_t size, char* reason, int reason_size);
  /* Before each step, and after the last one's; a negative time: there was none. */
  void (*before_step)(void* world, int64_t time_ns, int64_t real_ns);
  void (*after_step)(void* world, int64_t time_ns, int64_t real_ns);
  /* Whether a plugin has connected to its sensor; the next reading of the sensor, after the step. */
  int (*wants_reading)(void* world, int plugin);
  void (*take_reading)(void* world, int plugin, int64_t time_ns, const struct TrundleGazeboReading* reading);
  /* After a reset: of a plugin, by its number; 0: of the world, before its plugins. */
  void (*reset)(void* world, int plugin);
  /* What came before a crash in this thread, as a clause, such as "its Load threw: …"; "" if nothing is known. */
  const char* (*hint)(void);
};

const struct TrundleGazeboKit* trundle_gazebo_kit(void);

#ifdef __cplusplus
}
#endif

#endif
