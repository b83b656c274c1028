// Conversions from and to Eigen; prints a line for each check that fails.
#include <eigen_conversions/eigen_msg.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <tf_conversions/tf_eigen.h>

#include <iostream>

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

}  // namespace

int main() {
  ros::Time::init();
  geometry_msgs::Pose pose, back;
  pose.position.x = 1;
  pose.position.z = -2;
  pose.orientation.z = pose.orientation.w = std::sqrt(0.5);
  Eigen::Isometry3d isometry;
  Eigen::Affine3d affine;
  tf::poseMsgToEigen(pose, isometry);
  tf2::fromMsg(pose, affine);
  CHECK(isometry.matrix().isApprox(affine.matrix()) && (isometry * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 1, -2)));
  tf::poseEigenToMsg(affine, back);
  CHECK(back.position == pose.position && std::fabs(back.orientation.z - pose.orientation.z) < 1e-12);
  CHECK(std::fabs(tf2::toMsg(isometry).orientation.w - pose.orientation.w) < 1e-12);
  tf::Transform transform;
  tf::transformEigenToTF(isometry, transform);
  CHECK((transform * tf::Vector3(1, 0, 0)).distance(tf::Vector3(1, 1, -2)) < 1e-12);
  Eigen::Isometry3d again;
  tf::transformTFToEigen(transform, again);
  CHECK(again.isApprox(isometry));

  const tf2::Stamped<Eigen::Vector3d> here(Eigen::Vector3d(1, 2, 3), ros::Time(5), "odom");
  tf2::Stamped<Eigen::Vector3d> there;
  geometry_msgs::PointStamped sent;
  geometry_msgs::Point bare;
  tf2::convert(here, sent);
  tf2::convert(Eigen::Vector3d(0, 0, 4), bare);
  tf2::convert(sent, there);
  CHECK(there == here && there.frame_id_ == "odom" && there.stamp_ == ros::Time(5) && bare.z == 4);
  geometry_msgs::TransformStamped quarter = tf2::eigenToTransform(isometry);
  quarter.header.frame_id = "map";
  tf2::doTransform(here, there, quarter);
  CHECK(there.isApprox(Eigen::Vector3d(-1, 1, 1)) && there.frame_id_ == "map");
  tf2::Stamped<Eigen::Isometry3d> moved;
  tf2::doTransform(tf2::Stamped<Eigen::Isometry3d>(isometry, ros::Time(5), "odom"), moved, quarter);
  CHECK(tf2::toMsg(moved).header.frame_id == "map" && moved.isApprox(isometry * isometry));

  tf2_ros::Buffer buffer;
  geometry_msgs::TransformStamped base = tf2::eigenToTransform(isometry);
  base.header.frame_id = "odom";
  base.header.stamp = ros::Time(5);
  base.child_frame_id = "base";
  buffer.setTransform(base, "test");
  Eigen::Vector3d point;
  tf2::doTransform(Eigen::Vector3d(1, 0, 0), point, buffer.lookupTransform("odom", "base", ros::Time(0)));
  CHECK(point.isApprox(Eigen::Vector3d(1, 1, -2)));
  CHECK(tf2::transformToEigen(base).isApprox(isometry));

  Eigen::Matrix<double, 6, 1> screw;
  screw << 1, 2, 3, 4, 5, 6;
  geometry_msgs::Twist twist;
  geometry_msgs::Wrench wrench;
  tf::twistEigenToMsg(screw, twist);
  tf::wrenchEigenToMsg(screw, wrench);
  CHECK(twist.linear.z == 3 && twist.angular.x == 4 && wrench.force.y == 2 && wrench.torque.z == 6);
  Eigen::Matrix<double, 6, 1> same;
  tf::twistMsgToEigen(twist, same);
  CHECK(same == screw);
  std_msgs::Float64MultiArray numbers;
  tf::matrixEigenToMsg(Eigen::Matrix2d((Eigen::Matrix2d() << 1, 2, 3, 4).finished()), numbers);
  CHECK(numbers.data == std::vector<double>({1, 2, 3, 4}) && numbers.layout.dim[0].stride == 4);
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
