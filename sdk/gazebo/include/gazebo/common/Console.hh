// Messages to the terminal: gzmsg, gzdbg, gzwarn and gzerr are streams.
#ifndef GAZEBO_COMMON_CONSOLE_HH_
#define GAZEBO_COMMON_CONSOLE_HH_

#include <iostream>
#include <sstream>
#include <string>

#define gzdbg (::gazebo::common::Console::Stream("Dbg", __FILE__, __LINE__))
#define gzmsg (::gazebo::common::Console::Stream("Msg", 0, 0))
#define gzwarn (::gazebo::common::Console::Stream("Wrn", __FILE__, __LINE__))
#define gzerr (::gazebo::common::Console::Stream("Err", __FILE__, __LINE__))
#define gzlog (::gazebo::common::Console::Stream("", 0, 0))
#define gzclr_start(color) ""
#define gzclr_end ""

namespace gazebo {
namespace common {

class Console {
 public:
  static void SetQuiet(bool quiet);
  static bool GetQuiet();
  // Write the head of a message and return the stream for its text; gzlog and quiet ones write nowhere.
  static std::ostream& Stream(const char* kind, const char* file, unsigned int line);
};

}  // namespace common
}  // namespace gazebo

#endif
