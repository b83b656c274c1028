// Conversions from and to KDL; prints a line for each check that fails.
#include <kdl_conversions/kdl_msg.h>
#include <kdl_parser/kdl_parser.hpp>
#include <tf2/utils.h>
#include <tf2_kdl/tf2_kdl.h>
#include <tf_conversions/tf_kdl.h>

#include <cmath>
#include <iostream>
#include <kdl/chainfksolverpos_recursive.hpp>

namespace {

int made = 0, failed = 0;
#define CHECK(cond)                                                    \
  do {                                                                 \
    ++made;                                                            \
    if (!(cond)) {                                                     \
      ++failed;                                                        \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                  \
  } while (false)

const char kArm[] = R"(<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 0.5"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.2" izz="0.3" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"/><link name="tip"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 1"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="lower"/><origin xyz="0 0 1"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="end" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="0.5 0 0"/></joint></robot>)";

bool isNear(double a, double b) { return std::fabs(a - b) < 1e-9; }

}  // namespace

int main() {
  KDL::Tree tree;
  CHECK(kdl_parser::treeFromString(kArm, tree) && tree.getNrOfJoints() == 2 && tree.getNrOfSegments() == 3);
  CHECK(!kdl_parser::treeFromString("<robot/>", tree) || tree.getNrOfSegments() == 0);
  CHECK(kdl_parser::treeFromString(kArm, tree));
  KDL::Chain chain;
  CHECK(tree.getChain("base", "tip", chain));
  KDL::JntArray joints(2);
  joints(0) = M_PI / 2;
  joints(1) = 0.25;
  KDL::Frame tip;
  CHECK(KDL::ChainFkSolverPos_recursive(chain).JntToCart(joints, tip) == 0);
  CHECK(isNear(tip.p.x(), 1.25) && isNear(tip.p.y(), 0) && isNear(tip.p.z(), 0.5));
  const KDL::RigidBodyInertia inertia = chain.getSegment(0).getInertia();
  CHECK(isNear(inertia.getMass(), 2) && isNear(inertia.getCOG().z(), 0.5));
  CHECK(isNear(inertia.getRotationalInertia().data[0], 0.1 + 2 * 0.25));  // about the link's origin

  geometry_msgs::TransformStamped turned;
  turned.header.frame_id = "map";
  turned.transform.translation.x = 1;
  turned.transform.rotation.z = turned.transform.rotation.w = std::sqrt(0.5);
  tf2::Stamped<KDL::Vector> point(KDL::Vector(1, 0, 0), ros::Time(3), "base"), moved;
  tf2::doTransform(point, moved, turned);
  CHECK(isNear(moved.x(), 1) && isNear(moved.y(), 1) && moved.frame_id_ == "map");
  CHECK(tf2::toMsg(point).header.frame_id == "base" && isNear(tf2::toMsg(point).point.x, 1));
  geometry_msgs::Pose pose;
  tf::poseKDLToMsg(tip, pose);
  KDL::Frame back;
  tf::poseMsgToKDL(pose, back);
  CHECK(KDL::Equal(back, tip, 1e-9));
  tf::Transform transform;
  tf::transformKDLToTF(tip, transform);
  CHECK(isNear(transform.getOrigin().x(), tip.p.x()));
  CHECK(isNear(tf2::getYaw(turned.transform.rotation), M_PI / 2));
  CHECK(tf2::getYaw(geometry_msgs::Quaternion()) == 0.0);  // of zeros, as an unset message has
  geometry_msgs::PoseWithCovarianceStamped sure, other;
  sure.pose.pose.orientation.w = 1;
  sure.pose.covariance[0] = 4;  // x² becomes y² by a quarter turn
  tf2::doTransform(sure, other, turned);
  CHECK(isNear(other.pose.covariance[7], 4) && isNear(other.pose.covariance[0], 0));
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
