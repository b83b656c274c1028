// Marks of a profiler that Gazebo is not built with by default; without one they do nothing.
#ifndef IGNITION_COMMON_PROFILER_HH_
#define IGNITION_COMMON_PROFILER_HH_

#define IGN_PROFILE_THREAD_NAME(name) ((void)0)
#define IGN_PROFILE_LOG_TEXT(text) ((void)0)
#define IGN_PROFILE_BEGIN(name) ((void)0)
#define IGN_PROFILE_END() ((void)0)
#define IGN_PROFILE(name) ((void)0)

#endif
