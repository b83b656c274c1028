// Broadcasts frames, looks them up by tf and tf2, and prints a line for each check that fails.
#include <ros/ros.h>
#include <tf/message_filter.h>
#include <tf/transform_broadcaster.h>
#include <tf/transform_listener.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2/utils.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <tf2_ros/buffer_client.h>
#include <tf2_ros/buffer_server.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

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

bool near(double a, double b) { return std::fabs(a - b) < 1e-9; }

void checkMath() {
  for (double yaw : {-3.0, -0.5, 0.0, 1.2, 3.1})
    for (double pitch : {-1.5, 0.0, 0.7})
      for (double roll : {-2.9, 0.0, 0.4, 2.0}) {
        tf2::Quaternion q;
        q.setRPY(roll, pitch, yaw);
        double r, p, y;
        tf2::Matrix3x3(q).getRPY(r, p, y);
        CHECK(near(r, roll) && near(p, pitch) && near(y, yaw));
        tf2::Quaternion back;
        tf2::Matrix3x3(q).getRotation(back);
        CHECK(near(std::fabs(back.dot(q)), 1.0) && near(q.length(), 1.0));
        const tf2::Transform t(q, tf2::Vector3(1, 2, 3));
        const tf2::Vector3 v(0.3, -4, 5);
        CHECK((t.inverse() * (t * v)).distance(v) < 1e-9);
        CHECK(tf2::quatRotate(q, v).distance(t.getBasis() * v) < 1e-9);
        CHECK((tf2::Matrix3x3(q) * tf2::Matrix3x3(q).inverse() * v).distance(v) < 1e-9);
      }
  // Of the two quaternions of a rotation, tf gives the one with w > 0 up to 120°, then that with the largest of x, y, z.
  tf2::Quaternion sign;
  tf2::Matrix3x3(tf2::Quaternion(tf2::Vector3(0, 0, 1), -100 * M_PI / 180)).getRotation(sign);
  CHECK(near(sign.w(), cos(50 * M_PI / 180)) && sign.z() < 0);
  tf2::Matrix3x3(tf2::Quaternion(tf2::Vector3(0, 0, 1), -150 * M_PI / 180)).getRotation(sign);
  CHECK(near(sign.z(), sin(75 * M_PI / 180)) && sign.w() < 0);
  const tf2::Quaternion none, half(tf2::Vector3(0, 0, 1), 1.0);
  CHECK(near(tf2::getYaw(none.slerp(half, 0.25)), 0.25) && near(half.getAngle(), 1.0) && near(half.getAxis().z(), 1.0));
  CHECK(near(tf::getYaw(tf::createQuaternionMsgFromYaw(-2.0)), -2.0));
}

geometry_msgs::TransformStamped turn(double degrees, int second, const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped turned;
  turned.header.stamp = ros::Time(second);
  turned.header.frame_id = parent;
  turned.child_frame_id = child;
  turned.transform.rotation.z = sin(degrees * M_PI / 360);
  turned.transform.rotation.w = cos(degrees * M_PI / 360);
  return turned;
}

void checkRequests() {
  tf2::BufferCore frames;
  std::vector<tf2::TransformableResult> results;
  const auto number = frames.addTransformableCallback(
      [&](tf2::TransformableRequestHandle, const std::string&, const std::string&, ros::Time,
          tf2::TransformableResult result) { results.push_back(result); });
  CHECK(frames.addTransformableRequest(number, "a", "b", ros::Time(3)) > 0);
  const auto cancelled = frames.addTransformableRequest(number, "a", "b", ros::Time(3));
  CHECK(frames.addTransformableRequest(number, "a", "c", ros::Time(1)) > 0);
  frames.cancelTransformableRequest(cancelled);
  for (int second : {2, 3}) frames.setTransform(turn(-135, second, "a", "b"), "test");
  CHECK((results == std::vector<tf2::TransformableResult>{tf2::TransformAvailable}));
  CHECK(frames.addTransformableRequest(number, "a", "b", ros::Time(2)) == 0);
  frames.setTransform(turn(-90, 20, "a", "b"), "test");
  frames.setTransform(turn(-90, 20, "b", "c"), "test");
  CHECK(results.size() == 2 && results.back() == tf2::TransformFailure);
  CHECK(~frames.addTransformableRequest(number, "a", "b", ros::Time(2)) == 0);
  // The product of the quaternions, not one of the matrix.
  const auto rotation = frames.lookupTransform("a", "c", ros::Time(20)).transform.rotation;
  CHECK(near(rotation.z, -1) && near(rotation.w, 0));
}

void checkBuffer() {
  tf::Transformer frames;
  for (int i = 0; i <= 4; ++i)
    frames.setTransform(tf::StampedTransform(tf::Transform(tf::createQuaternionFromYaw(0.1 * i), tf::Vector3(i, 0, 0)),
                                             ros::Time(100 + i), "odom", "base"));
  frames.setTransform(tf::StampedTransform(tf::Transform(tf::Quaternion(0, 0, 0, 1), tf::Vector3(0, 0, 2)),
                                           ros::Time(103), "base", "laser"));
  tf::StampedTransform t;
  frames.lookupTransform("odom", "base", ros::Time(102.5), t);
  CHECK(near(t.getOrigin().x(), 2.5) && near(tf::getYaw(t.getRotation()), 0.25));
  frames.lookupTransform("/odom", "laser", ros::Time(0), t);
  CHECK(t.stamp_ == ros::Time(103) && near(t.getOrigin().x(), 3.0) && near(t.getOrigin().z(), 2.0));
  frames.lookupTransform("base", ros::Time(104), "base", ros::Time(100), "odom", t);
  CHECK(t.getOrigin().distance(tf::Transform(tf::createQuaternionFromYaw(-0.4)) * tf::Vector3(-4, 0, 0)) < 1e-9);
  std::vector<std::string> names;
  frames.getFrameStrings(names);
  CHECK((names == std::vector<std::string>{"base", "odom", "laser"}));
  // In the thread that sets transforms, waiting for one would be in vain.
  std::string why;
  CHECK(!frames.waitForTransform("odom", "base", ros::Time(200), ros::Duration(60), ros::Duration(0.01), &why));
  CHECK(why == tf2_ros::threading_error);
  CHECK(!frames.canTransform("odom", "base", ros::Time(200), &why) && why.find("into the future") != std::string::npos);
  CHECK(!frames.canTransform("odom", "nowhere", ros::Time(0)));
  frames.setTransform(tf::StampedTransform(tf::Transform::getIdentity(), ros::Time(100), "moon", "crater"));
  int thrown = 0;
  try {
    frames.lookupTransform("odom", "crater", ros::Time(0), t);
  } catch (const tf::ConnectivityException&) {
    ++thrown;
  }
  try {
    frames.lookupTransform("odom", "base", ros::Time(50), t);
  } catch (const tf::ExtrapolationException&) {
    ++thrown;
  }
  try {
    frames.lookupTransform("odom", "nowhere", ros::Time(50), t);
  } catch (tf::TransformException& error) {
    ++thrown;
  }
  // What is older than ten seconds is forgotten, though nothing came in between.
  frames.setTransform(tf::StampedTransform(tf::Transform::getIdentity(), ros::Time(200), "odom", "base"));
  CHECK(!frames.canTransform("odom", "base", ros::Time(150)) && frames.canTransform("odom", "base", ros::Time(200)));
  CHECK(thrown == 3);
  CHECK(!frames.setTransform(tf::StampedTransform(tf::Transform::getIdentity(), ros::Time(1), "a", "a")));
}

void checkTwist() {
  // A frame drives along x at 2 m/s and turns at 0.5 rad/s, one metre above the frame that sees it.
  tf::Transformer frames;
  for (int i = 0; i <= 10; ++i)
    frames.setTransform(
        tf::StampedTransform(tf::Transform(tf::createQuaternionFromYaw(0.05 * i), tf::Vector3(0.2 * i, 0, 1)),
                             ros::Time(100 + 0.1 * i), "odom", "base"));
  geometry_msgs::Twist twist;
  frames.lookupTwist("base", "odom", ros::Time(100.1), ros::Duration(0.2), twist);
  CHECK(near(twist.angular.x, 0) && near(twist.angular.y, 0) && near(twist.angular.z, 0.5));
  // The reference point is the observer's origin; tf rotates the velocity by the tracking frame's yaw, 0.05.
  CHECK(near(twist.linear.x, 2 * cos(0.05)) && near(twist.linear.y, 2 * sin(0.05) - 0.2 * 0.5));
  // Near the latest time the interval ends there; time 0 is that time.
  frames.lookupTwist("base", "odom", ros::Time(0), ros::Duration(0.2), twist);
  CHECK(near(twist.angular.z, 0.5) && near(twist.linear.x, 2 * cos(0.5)));
  frames.lookupTwist("odom", "base", "odom", tf::Point(0, 0, 0), "odom", ros::Time(100.5), ros::Duration(0.2), twist);
  CHECK(near(twist.angular.z, -0.5));
  try {
    frames.lookupTwist("base", "odom", ros::Time(101.5), ros::Duration(0.2), twist);
    CHECK(false);
  } catch (const tf::ExtrapolationException&) {
  }
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "frames");
  ros::NodeHandle n;
  checkMath();
  checkBuffer();
  checkRequests();
  checkTwist();

  tf::TransformListener listener;
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener2(buffer);
  tf2_ros::StaticTransformBroadcaster fixed;
  geometry_msgs::TransformStamped mount;
  mount.header.frame_id = "base";
  mount.child_frame_id = "camera";
  mount.transform.translation.z = 0.5;
  mount.transform.rotation = tf::createQuaternionMsgFromYaw(M_PI / 2);
  fixed.sendTransform(mount);
  tf::TransformBroadcaster broadcaster;
  ros::Timer timer = n.createTimer(ros::Duration(0.02), [&](const ros::TimerEvent&) {
    tf::Transform pose;
    pose.setOrigin(tf::Vector3(1.0, 2.0, 0.0));
    pose.setRotation(tf::createQuaternionFromYaw(0.0));
    broadcaster.sendTransform(tf::StampedTransform(pose, ros::Time::now(), "map", "base"));
  });
  ros::AsyncSpinner spinner(1);
  spinner.start();
  CHECK(listener.waitForTransform("map", "camera", ros::Time(0), ros::Duration(20.0)));
  geometry_msgs::PoseStamped ahead, in_map;
  ahead.header.frame_id = "camera";
  ahead.pose.position.x = 1.0;
  ahead.pose.orientation.w = 1.0;
  listener.transformPose("map", ahead, in_map);
  CHECK(near(in_map.pose.position.x, 1.0) && near(in_map.pose.position.y, 3.0) && near(in_map.pose.position.z, 0.5));
  CHECK(in_map.header.frame_id == "map" && near(tf::getYaw(in_map.pose.orientation), M_PI / 2));
  listener.transformPose("map", ros::Time(0), ahead, "map", in_map);
  CHECK(in_map.header.frame_id == "map" && near(in_map.pose.position.y, 3.0));
  sensor_msgs::PointCloud cloud;
  cloud.header.frame_id = "camera";
  cloud.points.resize(2);
  cloud.points[1].x = 1.0f;
  cloud.channels.resize(1);
  listener.transformPointCloud("map", cloud, cloud);
  CHECK(cloud.header.frame_id == "map" && cloud.channels.size() == 1 && cloud.points.size() == 2);
  CHECK(near(cloud.points[0].y, 2.0) && near(cloud.points[1].x, 1.0) && near(cloud.points[1].y, 3.0));
  listener.transformPointCloud("camera", ros::Time(0), cloud, "map", cloud);
  CHECK(cloud.header.frame_id == "camera" && near(cloud.points[1].x, 1.0) && near(cloud.points[1].z, 0.0));
  const geometry_msgs::TransformStamped found =
      buffer.lookupTransform("map", "camera", ros::Time(0), ros::Duration(20.0));
  tf2::Transform transform;
  tf2::convert(found.transform, transform);
  CHECK(near(transform.getOrigin().y(), 2.0) && found.child_frame_id == "camera");
  const geometry_msgs::PoseStamped again = buffer.transform(ahead, "map", ros::Duration(1.0));
  CHECK(near(again.pose.position.y, 3.0));
  const geometry_msgs::PoseStamped before =
      buffer.transform(ahead, "camera", ros::Time(0), "map", ros::Duration(1.0));
  CHECK(near(before.pose.position.x, 1.0) && before.header.frame_id == "camera");
  // A filter of tf passes on at once what is ready when it comes.
  tf::MessageFilter<geometry_msgs::PoseStamped> filter(listener, "map", 5);
  int passed = 0;
  filter.registerCallback(
      boost::function<void(const geometry_msgs::PoseStampedConstPtr&)>([&](const geometry_msgs::PoseStampedConstPtr&) {
        ++passed;
      }));
  filter.add(boost::make_shared<geometry_msgs::PoseStamped>(ahead));
  CHECK(passed == 1);
  // Another node asks for transforms by an action; what is wrong comes back as the exception.
  tf2_ros::BufferServer server(buffer, "lookups");
  tf2_ros::BufferClient client("lookups");
  CHECK(client.waitForServer(ros::Duration(20.0)));
  CHECK(near(client.lookupTransform("map", "camera", ros::Time(0)).transform.translation.y, 2.0));
  CHECK(near(client.lookupTransform("map", ros::Time(0), "camera", ros::Time(0), "base").transform.translation.z, 0.5));
  CHECK(client.canTransform("map", "base", ros::Time::now() + ros::Duration(0.1), ros::Duration(20.0)));
  std::string reason;
  CHECK(!client.canTransform("map", "nowhere", ros::Time(0), ros::Duration(0.1), &reason));
  CHECK(reason.find("nowhere") != std::string::npos);
  int codes = 0;
  try {
    client.lookupTransform("map", "nowhere", ros::Time(0));
  } catch (const tf2::LookupException&) {
    ++codes;
  }
  try {
    client.lookupTransform("", "camera", ros::Time(0));
  } catch (const tf2::InvalidArgumentException&) {
    ++codes;
  }
  try {
    client.lookupTransform("map", "base", ros::Time(1.0));
  } catch (const tf2::ExtrapolationException&) {
    ++codes;
  }
  CHECK(codes == 3);
  // A transform of the future is waited for.
  CHECK(listener.waitForTransform("map", "base", ros::Time::now() + ros::Duration(0.1), ros::Duration(20.0)));
  tf::StampedTransform foreign;
  if (argc == 2) {
    CHECK(listener.waitForTransform("map", argv[1], ros::Time(0), ros::Duration(60.0)));
    listener.lookupTransform("map", argv[1], ros::Time(0), foreign);
    CHECK(near(foreign.getOrigin().z(), 7.0));
  }
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  ros::Duration(n.param("linger", 0.0)).sleep();
  return failed == 0 ? 0 : 1;
}
