#ifndef GAZEBO_COMMON_TIMER_HH_
#define GAZEBO_COMMON_TIMER_HH_

#include <gazebo/common/Time.hh>

namespace gazebo {
namespace common {

// Stopwatch of wall time.
class Timer {
 public:
  Timer() : running(false) {}
  virtual ~Timer() {}
  virtual void Start() {
    start = Time::GetWallTime();
    running = true;
  }
  virtual void Stop() {
    stop = Time::GetWallTime();
    running = false;
  }
  virtual void Reset() { start = stop = Time::GetWallTime(); }
  bool GetRunning() const { return running; }
  Time GetElapsed() const { return running ? Time::GetWallTime() - start : stop - start; }

 private:
  Time start, stop;
  bool running;
};

}  // namespace common
}  // namespace gazebo

#endif
