// Checks of interfaces, limits and transmissions; prints each that fails, and returns their number.
#include <cmath>
#include <cstdio>

#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/robot_hw.h>
#include <joint_limits_interface/joint_limits_interface.h>
#include <joint_limits_interface/joint_limits_urdf.h>
#include <transmission_interface/differential_transmission.h>
#include <transmission_interface/four_bar_linkage_transmission.h>
#include <transmission_interface/simple_transmission.h>
#include <transmission_interface/transmission_interface.h>
#include <transmission_interface/transmission_parser.h>

using namespace hardware_interface;
using namespace joint_limits_interface;
using namespace transmission_interface;

int failed = 0;
void check(bool is_true, const char* what) {
  if (is_true) return;
  std::printf("failed: %s\n", what);
  ++failed;
}
bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

struct Joint {
  double position = 0.0, velocity = 0.0, effort = 0.0, command = 0.0;
  JointHandle handle(const char* name) {
    return JointHandle(JointStateHandle(name, &position, &velocity, &effort), &command);
  }
};

void check_interfaces() {
  Joint a, b;
  VelocityJointInterface left, right;
  left.registerHandle(a.handle("a"));
  right.registerHandle(b.handle("b"));
  RobotHW robot, part;
  robot.registerInterface(&left);
  check(robot.get<VelocityJointInterface>() == &left, "an interface is found by its type");
  check(robot.get<EffortJointInterface>() == nullptr, "null for a type that is not registered");
  part.registerInterface(&right);
  robot.registerInterfaceManager(&part);
  VelocityJointInterface* const both = robot.get<VelocityJointInterface>();
  check(both->getNames().size() == 2 && robot.get<VelocityJointInterface>() == both, "managers are combined, once");
  both->getHandle("b").setCommand(3.0);
  check(near(b.command, 3.0) && both->getClaims().count("b") == 1, "a handle writes, and claims");
  bool has_thrown = false;
  try {
    left.getHandle("c");
  } catch (const HardwareInterfaceException&) {
    has_thrown = true;
  }
  check(has_thrown, "a missing handle is an exception");
  ControllerInfo one, two;
  one.name = "one", two.name = "two";
  one.claimed_resources = {InterfaceResources("V", {"a"})};
  two.claimed_resources = {InterfaceResources("E", {"a", "b"})};
  check(robot.checkForConflict({one, two}) && !robot.checkForConflict({two}), "two users of a joint are a conflict");
}

void check_limits() {
  const ros::Duration tick(0.1);
  Joint joint;
  JointLimits limits;
  limits.has_position_limits = limits.has_velocity_limits = limits.has_effort_limits = true;
  limits.has_acceleration_limits = true;
  limits.min_position = -1.0, limits.max_position = 1.0;
  limits.max_velocity = 2.0, limits.max_acceleration = 5.0, limits.max_effort = 4.0;
  PositionJointSaturationHandle position(joint.handle("j"), limits);
  joint.command = 9.0;
  position.enforceLimits(tick);
  check(near(joint.command, 0.2), "a position moves by at most the speed");
  VelocityJointSaturationHandle velocity(joint.handle("j"), limits);
  joint.command = 9.0;
  velocity.enforceLimits(tick);
  check(near(joint.command, 0.5), "a velocity changes by at most the acceleration");
  EffortJointSaturationHandle effort(joint.handle("j"), limits);
  joint.position = 1.5, joint.command = 9.0;
  effort.enforceLimits(tick);
  check(near(joint.command, 0.0), "no effort beyond a limit");
  SoftJointLimits soft;
  soft.min_position = -0.9, soft.max_position = 0.9, soft.k_position = 10.0, soft.k_velocity = 1.0;
  VelocityJointSoftLimitsHandle slowed(joint.handle("j"), limits, soft);
  joint.position = 0.85, joint.velocity = 0.5, joint.command = 2.0;
  slowed.enforceLimits(tick);
  check(near(joint.command, 0.5), "near a soft limit the speed is k_position times the distance");
}

void check_transmissions() {
  double a[2] = {4.0, 2.0}, j[2] = {}, back[2] = {};
  SimpleTransmission simple(2.0, 0.5);
  ActuatorData actuator;
  JointData joint;
  actuator.position = {&a[0]};
  joint.position = {&j[0]};
  simple.actuatorToJointPosition(actuator, joint);
  check(near(j[0], 2.5), "a simple transmission divides, and adds the offset");
  const std::vector<double> reductions = {2.0, 4.0}, outer = {3.0, 5.0}, offsets = {0.1, 0.2};
  DifferentialTransmission differential(reductions, outer, offsets);
  FourBarLinkageTransmission linkage(reductions, outer, offsets);
  for (Transmission* const both : std::initializer_list<Transmission*>{&differential, &linkage}) {
    ActuatorData there, again;
    JointData middle;
    there.position = there.effort = {&a[0], &a[1]};
    again.position = again.effort = {&back[0], &back[1]};
    middle.position = middle.effort = {&j[0], &j[1]};
    both->actuatorToJointPosition(there, middle);
    both->jointToActuatorPosition(middle, again);
    check(near(back[0], a[0]) && near(back[1], a[1]), "positions there and back");
    both->actuatorToJointEffort(there, middle);
    both->jointToActuatorEffort(middle, again);
    check(near(back[0], a[0]) && near(back[1], a[1]), "efforts there and back");
  }
  std::vector<TransmissionInfo> infos;
  const char* const urdf =
      "<robot name='r'><transmission name='t'><type>transmission_interface/SimpleTransmission</type>"
      "<joint name='hinge'><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>"
      "<actuator name='m'><mechanicalReduction>50</mechanicalReduction></actuator></transmission>"
      "<transmission name='broken'/></robot>";
  check(TransmissionParser::parse(urdf, infos) && infos.size() == 1, "a valid transmission is read, another is not");
  check(infos[0].joints_[0].hardware_interfaces_[0] == "hardware_interface/EffortJointInterface" &&
            infos[0].actuators_[0].xml_element_.find("<mechanicalReduction>50") != std::string::npos,
        "interfaces, and elements as XML");
}

int main() {
  check_interfaces();
  check_limits();
  check_transmissions();
  std::printf("%d checks failed\n", failed);
  return failed;
}
