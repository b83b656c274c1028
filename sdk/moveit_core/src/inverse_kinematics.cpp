#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "moveit/robot_state/robot_state.h"

namespace moveit {
namespace core {
namespace {

constexpr int kFewestAttempts = 10, kMostAttempts = 2000;
constexpr double kAttemptsPerSecond = 2000.0;
constexpr int kIterations = 60;
constexpr double kPositionTolerance = 1e-5;  // [m]
constexpr double kAngleTolerance = 1e-4;     // [rad]

Eigen::Isometry3d isometry(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (q.squaredNorm() < 1e-12) q = Eigen::Quaterniond::Identity();
  result.linear() = q.normalized().toRotationMatrix();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return result;
}

/** Position [m] and rotation vector [rad] that lead from one pose to another. */
Eigen::Matrix<double, 6, 1> difference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  Eigen::Matrix<double, 6, 1> result;
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  result.head<3>() = to.translation() - from.translation();
  result.tail<3>() = turn.angle() * turn.axis();
  return result;
}

bool isReached(const Eigen::Matrix<double, 6, 1>& error) {
  return error.head<3>().norm() < kPositionTolerance && error.tail<3>().norm() < kAngleTolerance;
}

const LinkModel* tipOf(const JointModelGroup& group, const std::string& name) {
  if (name.empty()) return group.getOnlyOneEndEffectorTip();
  return group.getParentModel().getLinkModel(!name.empty() && name[0] == '/' ? name.substr(1) : name);
}

}  // namespace

bool RobotState::getJacobian(const JointModelGroup* group, const LinkModel* link,
                             const Eigen::Vector3d& reference_point_position, Eigen::MatrixXd& jacobian,
                             bool use_quaternion_representation) const {
  if (use_quaternion_representation || link == nullptr || !group->isChain() || group->getJointModels().empty()) {
    ROS_ERROR_NAMED("robot_state", "The group '%s' is not a chain. Cannot compute Jacobian.", group->getName().c_str());
    return false;
  }
  const JointModel* first = group->getJointModels().front();
  const Eigen::Isometry3d base = first->getParentLinkModel() == nullptr
                                     ? Eigen::Isometry3d::Identity()
                                     : getGlobalLinkTransform(first->getParentLinkModel());
  const Eigen::Matrix3d turn = base.linear().transpose();
  const Eigen::Vector3d point = getGlobalLinkTransform(link) * reference_point_position;
  jacobian.setZero(6, group->getVariableCount());
  for (const JointModel* joint = link->getParentJointModel(); joint != nullptr;
       joint = joint->getParentLinkModel() == nullptr ? nullptr : joint->getParentLinkModel()->getParentJointModel()) {
    const JointModel* driver = joint->getMimic() == nullptr ? joint : joint->getMimic();
    if (joint->getVariableCount() != 1 || !group->hasJointModel(driver->getName())) continue;
    const double factor = joint->getMimic() == nullptr ? 1.0 : joint->getMimicFactor();
    const Eigen::Isometry3d& pose = getGlobalLinkTransform(joint->getChildLinkModel());
    const Eigen::Vector3d axis = factor * (turn * (pose.linear() * joint->getAxis()));
    const int column = group->getVariableGroupIndex(driver->getVariableNames()[0]);
    if (joint->getType() == JointModel::PRISMATIC) {
      jacobian.block<3, 1>(0, column) += axis;
    } else {
      jacobian.block<3, 1>(0, column) += axis.cross(turn * (point - pose.translation()));
      jacobian.block<3, 1>(3, column) += axis;
    }
  }
  return true;
}

Eigen::MatrixXd RobotState::getJacobian(const JointModelGroup* group,
                                        const Eigen::Vector3d& reference_point_position) const {
  Eigen::MatrixXd result;
  if (!getJacobian(group, group->getLinkModels().back(), reference_point_position, result))
    throw Exception("Unable to compute Jacobian");
  return result;
}

/** Levenberg-Marquardt (Sugihara 2011: damping by the squared error), joints held within their limits. */
bool RobotState::approach(const JointModelGroup& group, const LinkModel& tip, const Eigen::Isometry3d& pose) {
  const JointModel* first = group.getJointModels().front();
  const Eigen::Isometry3d base = first->getParentLinkModel() == nullptr
                                     ? Eigen::Isometry3d::Identity()
                                     : getGlobalLinkTransform(first->getParentLinkModel());
  Eigen::MatrixXd jacobian;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix<double, 6, 1> error = difference(getGlobalLinkTransform(&tip), pose);
    if (isReached(error)) return true;
    error.head<3>() = base.linear().transpose() * error.head<3>();
    error.tail<3>() = base.linear().transpose() * error.tail<3>();
    if (!getJacobian(&group, &tip, Eigen::Vector3d::Zero(), jacobian)) return false;
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal().array() += 0.5 * error.squaredNorm() + 1e-6;
    const Eigen::VectorXd step = normal.ldlt().solve(jacobian.transpose() * error);
    const double longest = step.cwiseAbs().maxCoeff();
    const double scale = longest > 1.0 ? 1.0 / longest : 1.0;
    for (const JointModel* joint : group.getActiveJointModels()) {
      const int column = group.getVariableGroupIndex(joint->getVariableNames()[0]);
      double* value = position_.data() + joint->getFirstVariableIndex();
      *value += scale * step[column];
      joint->enforcePositionBounds(value);
    }
    updateMimicJoints();
  }
  return isReached(difference(getGlobalLinkTransform(&tip), pose));
}

bool RobotState::setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, const std::string& tip,
                           double timeout, const GroupStateValidityCallbackFn& constraint) {
  const LinkModel* link = group == nullptr ? nullptr : tipOf(*group, tip);
  if (link == nullptr) return false;
  if (!group->isSingleDOFJoints() || !group->isChain()) {
    ROS_ERROR_NAMED("robot_state", "No kinematics solver instantiated for group '%s': it is no chain",
                    group->getName().c_str());
    return false;
  }
  const RobotState start = *this;
  std::mt19937 random(1);  // the same call gives the same answer
  const int attempts =
      std::clamp(static_cast<int>(std::min(timeout * kAttemptsPerSecond, 1e6)), kFewestAttempts, kMostAttempts);
  std::vector<double> values;
  for (int i = 0; i < attempts; ++i) {
    if (i > 0) setToRandomPositions(group, random);
    if (!approach(*group, *link, pose)) continue;
    copyJointGroupPositions(group, values);
    if (constraint && !constraint(this, group, values.data())) continue;
    setJointGroupPositions(group, values);
    return true;
  }
  *this = start;
  return false;
}

bool RobotState::setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, double timeout,
                           const GroupStateValidityCallbackFn& constraint) {
  return setFromIK(group, pose, "", timeout, constraint);
}
bool RobotState::setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, double timeout,
                           const GroupStateValidityCallbackFn& constraint) {
  return setFromIK(group, isometry(pose), "", timeout, constraint);
}
bool RobotState::setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, const std::string& tip,
                           double timeout, const GroupStateValidityCallbackFn& constraint) {
  return setFromIK(group, isometry(pose), tip, timeout, constraint);
}

double RobotState::computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& trajectory,
                                        const LinkModel* link, const Eigen::Isometry3d& target,
                                        bool global_reference_frame, const MaxEEFStep& max_step,
                                        const JumpThreshold& jump_threshold,
                                        const GroupStateValidityCallbackFn& valid) {
  const Eigen::Isometry3d start = getGlobalLinkTransform(link);
  const Eigen::Isometry3d goal = global_reference_frame ? target : start * target;
  const Eigen::Quaterniond from(start.linear()), to(goal.linear());
  double steps = 1.0;
  if (max_step.translation > 0.0)
    steps = std::max(steps, std::ceil((goal.translation() - start.translation()).norm() / max_step.translation));
  if (max_step.rotation > 0.0) steps = std::max(steps, std::ceil(from.angularDistance(to) / max_step.rotation));
  if (!(steps < 1e6)) throw Exception("a Cartesian path of " + std::to_string(steps) + " steps is too long");
  const int count = std::max(static_cast<int>(steps), jump_threshold.factor > 0.0 ? 10 : 1);

  trajectory.clear();
  trajectory.push_back(std::make_shared<RobotState>(*this));
  int done = 0;
  for (int i = 1; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = from.slerp(t, to).toRotationMatrix();
    pose.translation() = (1.0 - t) * start.translation() + t * goal.translation();
    const RobotState before = *this;
    std::vector<double> values;
    const bool is_solved = approach(*group, *link, pose);
    copyJointGroupPositions(group, values);
    if (!is_solved || (valid && !valid(this, group, values.data()))) {
      *this = before;
      break;
    }
    trajectory.push_back(std::make_shared<RobotState>(*this));
    done = i;
  }
  // Cut at the first step that is far longer than the mean, or longer than a limit.
  double sum = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) sum += trajectory[i - 1]->distance(*trajectory[i], group);
  const double mean = trajectory.size() > 1 ? sum / static_cast<double>(trajectory.size() - 1) : 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    bool is_jump = jump_threshold.factor > 0.0 &&
                   trajectory[i - 1]->distance(*trajectory[i], group) > jump_threshold.factor * mean;
    for (const JointModel* joint : group->getActiveJointModels()) {
      const double limit =
          joint->getType() == JointModel::PRISMATIC ? jump_threshold.prismatic : jump_threshold.revolute;
      const double way =
          joint->distance(trajectory[i - 1]->getJointPositions(joint), trajectory[i]->getJointPositions(joint));
      is_jump = is_jump || (limit > 0.0 && way > limit);
    }
    if (!is_jump) continue;
    trajectory.resize(i);
    *this = *trajectory.back();
    done = static_cast<int>(i) - 1;
    break;
  }
  return static_cast<double>(done) / count;
}

double RobotState::computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& trajectory,
                                        const LinkModel* link, const std::vector<Eigen::Isometry3d>& waypoints,
                                        bool global_reference_frame, const MaxEEFStep& max_step,
                                        const JumpThreshold& jump_threshold,
                                        const GroupStateValidityCallbackFn& valid) {
  double fraction = 0.0;
  trajectory.clear();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    std::vector<RobotStatePtr> part;
    const double done =
        computeCartesianPath(group, part, link, waypoints[i], global_reference_frame, max_step, jump_threshold, valid);
    trajectory.insert(trajectory.end(), part.begin() + (trajectory.empty() ? 0 : 1), part.end());
    fraction = (static_cast<double>(i) + done) / static_cast<double>(waypoints.size());
    if (done < 1.0) break;
  }
  return fraction;
}

}  // namespace core
}  // namespace moveit
