// Pairs scans with odometry by their stamps, and passes scans on that tf and tf2 can transform to odom.
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/String.h>
#include <tf/message_filter.h>
#include <tf/transform_listener.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

class Scans {
 public:
  Scans()
      : said_(node_.advertise<std_msgs::String>("said", 100, true)),
        scans_(node_, "scan", 10),
        odometry_(node_, "odom", 10),
        sync_(Policy(10), scans_, odometry_),
        by_tf_(scans_, tf_, "odom", 10),
        listener_(buffer_),
        by_tf2_(scans_, buffer_, "odom", 10, nullptr) {
    sync_.registerCallback(boost::bind(&Scans::onPair, this, _1, _2));
    by_tf_.registerCallback(boost::bind(&Scans::onScan, this, _1, "tf"));
    by_tf_.setTolerance(ros::Duration(0.01));
    by_tf2_.registerCallback(boost::bind(&Scans::onScan, this, _1, "tf2"));
    by_tf2_.registerFailureCallback([this](const sensor_msgs::LaserScanConstPtr& scan, tf2_ros::FilterFailureReason why) {
      say(why == tf2_ros::filter_failure_reasons::EmptyFrameID ? "without frame" : "too old", scan->header.stamp);
    });
  }

 private:
  typedef message_filters::sync_policies::ApproximateTime<sensor_msgs::LaserScan, nav_msgs::Odometry> Policy;

  void onPair(const sensor_msgs::LaserScanConstPtr& scan, const nav_msgs::OdometryConstPtr& odometry) {
    say("pair", scan->header.stamp, odometry->header.stamp);
  }
  void onScan(const sensor_msgs::LaserScanConstPtr& scan, const char* what) { say(what, scan->header.stamp); }
  void say(const std::string& what, const ros::Time& stamp, const ros::Time& other = ros::Time()) {
    std_msgs::String message;
    std::stringstream text;
    text << what << " " << stamp.toSec();
    if (!other.isZero()) text << " " << other.toSec();
    message.data = text.str();
    said_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher said_;
  message_filters::Subscriber<sensor_msgs::LaserScan> scans_;
  message_filters::Subscriber<nav_msgs::Odometry> odometry_;
  message_filters::Synchronizer<Policy> sync_;
  tf::TransformListener tf_;
  tf::MessageFilter<sensor_msgs::LaserScan> by_tf_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> by_tf2_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "scans");
  Scans scans;
  ros::spin();
  return 0;
}
