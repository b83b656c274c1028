#pragma once

#include <moveit_msgs/MoveItErrorCodes.h>

#include <string>

namespace moveit {
namespace core {

/** Error code that is true where it says success; implicitly, as programs of Indigo have `bool ok = group.plan(p)`. */
class MoveItErrorCode : public moveit_msgs::MoveItErrorCodes {
 public:
  MoveItErrorCode(int code = 0) { val = code; }
  MoveItErrorCode(const moveit_msgs::MoveItErrorCodes& code) { val = code.val; }
  operator bool() const { return val == SUCCESS; }
  bool operator==(int code) const { return val == code; }
  bool operator!=(int code) const { return val != code; }
};

/** Name of an error code, such as PLANNING_FAILED. */
std::string error_code_to_string(const MoveItErrorCode& error_code);

}  // namespace core
}  // namespace moveit
