#ifndef GAZEBO_COMMON_UPDATEINFO_HH_
#define GAZEBO_COMMON_UPDATEINFO_HH_

#include <string>

#include <gazebo/common/Time.hh>

namespace gazebo {
namespace common {

// What ConnectWorldUpdateBegin tells: name and times of the world.
class UpdateInfo {
 public:
  std::string worldName;
  Time simTime;
  Time realTime;
};

}  // namespace common
}  // namespace gazebo

#endif
