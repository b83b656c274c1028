// Filters fed by hand; prints a line for each check that fails.
#include <message_filters/cache.h>
#include <message_filters/chain.h>
#include <message_filters/pass_through.h>
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/sync_policies/exact_time.h>
#include <message_filters/synchronizer.h>
#include <message_filters/time_sequencer.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/String.h>

#include <functional>
#include <iostream>
#include <sstream>

namespace {

using message_filters::Cache;
using message_filters::PassThrough;
using sensor_msgs::Imu;
using sensor_msgs::Range;

int made = 0, failed = 0;
#define CHECK(cond)                                                    \
  do {                                                                 \
    ++made;                                                            \
    if (!(cond)) {                                                     \
      ++failed;                                                        \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                  \
  } while (false)

std::ostringstream seen;
std::string take() {
  const std::string text = seen.str();
  seen.str("");
  return text;
}
template <class M>
boost::shared_ptr<M> at(double stamp) {
  boost::shared_ptr<M> message(new M);
  message->header.stamp = ros::Time(stamp);
  return message;
}
template <class M>
double of(const M& message) {
  return message ? message->header.stamp.toSec() : -1.0;
}

void onPair(const sensor_msgs::ImuConstPtr& a, const sensor_msgs::RangeConstPtr& b) {
  seen << of(a) << "+" << of(b) << " ";
}
void onDrop(const sensor_msgs::ImuConstPtr& a, const sensor_msgs::RangeConstPtr& b) {
  seen << "drop " << of(a) << "+" << of(b) << " ";
}
struct Listener {
  void onPair(const sensor_msgs::ImuConstPtr& a, const sensor_msgs::RangeConstPtr& b) {
    seen << name << of(a) << "+" << of(b) << " ";
  }
  void onOne(const sensor_msgs::ImuConstPtr& a) { seen << of(a) << " "; }
  std::string name;
};
void onThree(const sensor_msgs::ImuConstPtr& a, const sensor_msgs::RangeConstPtr& b, const Imu& c, int tag) {
  seen << of(a) << "+" << of(b) << "+" << c.header.stamp.toSec() << "#" << tag << " ";
}

void checkExact() {
  PassThrough<Imu> imus;
  PassThrough<Range> ranges;
  message_filters::TimeSynchronizer<Imu, Range> exact(imus, ranges, 2);
  message_filters::Connection connection = exact.registerCallback(&onPair);
  exact.registerDropCallback(&onDrop);
  Listener listener;
  listener.name = "m";
  exact.registerCallback(&Listener::onPair, &listener);
  imus.add(at<Imu>(1));
  imus.add(at<Imu>(2));
  ranges.add(at<Range>(2));
  CHECK(take() == "drop 1+-1 2+2 m2+2 ");
  connection.disconnect();
  ranges.add(at<Range>(3));
  ranges.add(at<Range>(4));
  ranges.add(at<Range>(5));
  imus.add(at<Imu>(4));
  CHECK(take() == "drop -1+3 m4+4 ");

  typedef message_filters::sync_policies::ExactTime<Imu, Range, Imu> Three;
  message_filters::Synchronizer<Three> three(Three(10));
  three.registerCallback(boost::bind(&onThree, _1, _2, boost::bind(&boost::shared_ptr<Imu const>::operator*, _3), 7));
  three.add<0>(at<Imu>(1));
  three.add<1>(at<Range>(1));
  CHECK(take().empty());
  three.add<2>(at<Imu>(1));
  CHECK(take() == "1+1+1#7 ");
}

typedef message_filters::sync_policies::ApproximateTime<Imu, Range> Near;

/** Sets of two inputs, whose messages are added in the order of their stamps. */
std::string setsOf(Near policy, std::vector<double> imus, std::vector<double> ranges, double interval = 0.0) {
  if (interval > 0.0) policy.setMaxIntervalDuration(ros::Duration(interval));
  message_filters::Synchronizer<Near> near(policy);
  near.registerCallback(boost::bind(&onPair, _1, _2));
  size_t i = 0, k = 0;
  while (i < imus.size() || k < ranges.size())
    if (k == ranges.size() || (i < imus.size() && imus[i] <= ranges[k]))
      near.add<0>(at<Imu>(imus[i++]));
    else
      near.add<1>(at<Range>(ranges[k++]));
  return take();
}

void checkApproximate() {
  // The pivot is 1.1; 0.9 is nearer than 0, and 2 tells that nothing nearer comes.
  CHECK(setsOf(Near(10), {0.0, 0.9, 2.0}, {1.1, 2.1}) == "0.9+1.1 ");
  CHECK(setsOf(Near(10), {0.0, 1.0, 2.0, 3.0}, {0.1, 1.1, 2.1, 3.1}) == "0+0.1 1+1.1 2+2.1 ");
  // With a lower bound the sets are known without the next message.
  Near bounded(10);
  bounded.setInterMessageLowerBound(ros::Duration(0.5));
  CHECK(setsOf(bounded, {0.0, 1.0}, {0.1, 1.1}) == "0+0.1 1+1.1 ");
  CHECK(setsOf(Near(10), {1.0, 3.0, 5.0}, {1.5, 3.1, 5.1}, 0.2) == "3+3.1 ");
  CHECK(setsOf(Near(2), {0.0, 1.0, 2.0, 3.0}, {}).empty());
  CHECK(setsOf(Near(2), {1.0, 2.0, 3.0, 9.0}, {4.0, 4.1}) == "3+4 ");
  // 4.1 is no pivot, as 4, which was dropped, may have been nearer to what comes.
  CHECK(setsOf(Near(2), {1.0, 2.0, 3.0}, {4.0, 4.1, 9.0}).empty());
  CHECK(setsOf(Near(10), {0.0, 4e9}, {0.0, 4e9 + 1}) == "0+0 ");

  typedef message_filters::sync_policies::ApproximateTime<Imu, Range, Imu, Range, Imu, Range, Imu, Range, Imu> Nine;
  message_filters::Synchronizer<Nine> nine(Nine(10));
  int count = 0;
  nine.registerCallback(boost::function<void(const sensor_msgs::ImuConstPtr&)>(
      [&count](const sensor_msgs::ImuConstPtr&) { ++count; }));
  for (int i = 0; i < 3; ++i) {
    nine.add<0>(at<Imu>(i));
    nine.add<1>(at<Range>(i + 0.01));
    nine.add<2>(at<Imu>(i + 0.02));
    nine.add<3>(at<Range>(i + 0.03));
    nine.add<4>(at<Imu>(i + 0.04));
    nine.add<5>(at<Range>(i + 0.05));
    nine.add<6>(at<Imu>(i + 0.06));
    nine.add<7>(at<Range>(i + 0.07));
    nine.add<8>(at<Imu>(i + 0.08));
  }
  CHECK(count == 2);
}

void checkByHand() {
  message_filters::NullFilter<Imu> imus;
  message_filters::NullFilter<Range> ranges;
  message_filters::TimeSynchronizer<Imu, Range> exact(imus, ranges, 2);
  exact.registerCallback(&onPair);
  exact.add0(at<Imu>(1.0));
  exact.add1(at<Range>(1.0));
  CHECK(take() == "1+1 ");
  message_filters::Synchronizer<message_filters::sync_policies::ExactTime<Imu, Range> > sized(2);
  sized.registerCallback(&onPair);
  sized.add<0>(at<Imu>(2.0));
  sized.add<1>(at<Range>(2.0));
  CHECK(take() == "2+2 ");
  PassThrough<Imu> single;
  single.registerCallback<const Imu&>([](const Imu& imu) { seen << imu.header.stamp.toSec() << " "; });
  single.add(at<Imu>(3.0));
  CHECK(take() == "3 ");
}

void checkOthers() {
  PassThrough<Imu> source;
  Cache<Imu> cache(source, 4);
  for (double stamp : {1.0, 2.0, 4.0, 3.0, 5.0}) source.add(at<Imu>(stamp));
  CHECK(cache.getOldestTime() == ros::Time(2) && cache.getLatestTime() == ros::Time(5));
  const auto inside = cache.getInterval(ros::Time(2.5), ros::Time(4));
  CHECK(inside.size() == 2 && of(inside[0]) == 3 && of(inside[1]) == 4);
  const auto around = cache.getSurroundingInterval(ros::Time(2.5), ros::Time(3.5));
  CHECK(around.size() == 3 && of(around[0]) == 2 && of(around[2]) == 4);
  CHECK(of(cache.getElemBeforeTime(ros::Time(4))) == 3 && of(cache.getElemAfterTime(ros::Time(4))) == 5);
  CHECK(!cache.getElemBeforeTime(ros::Time(2)) && !cache.getElemAfterTime(ros::Time(5)));
  CHECK(cache.getInterval(ros::Time(9), ros::Time(1)).empty());

  Listener listener;
  message_filters::Chain<Imu> chain(source);
  boost::shared_ptr<PassThrough<Imu> > first(new PassThrough<Imu>), second(new PassThrough<Imu>);
  CHECK(chain.addFilter(first) == 0);
  CHECK(chain.addFilter(second) == 1);
  chain.registerCallback(&Listener::onOne, &listener);
  source.add(at<Imu>(6));
  second->add(at<Imu>(7));
  CHECK(take() == "6 7 ");
  CHECK(chain.getFilter<PassThrough<Imu> >(1) == second && !chain.getFilter<Cache<Imu> >(1));
  struct Derived : PassThrough<Imu> {};
  chain.addFilter(boost::make_shared<Derived>());
  CHECK(chain.getFilter<PassThrough<Imu> >(2) == chain.getFilter<Derived>(2) && chain.getFilter<Derived>(2));
  CHECK(!chain.getFilter<Derived>(1) && !chain.getFilter<Derived>(3));

  message_filters::TimeSequencer<Imu> sequencer(ros::Duration(0.05), ros::Duration(0.01), 10);
  sequencer.registerCallback(&Listener::onOne, &listener);
  for (double stamp : {3.0, 1.0, 2.0}) sequencer.add(at<Imu>(stamp));
  for (int i = 0; i < 1000 && seen.str().size() < 6; ++i) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  CHECK(take() == "1 2 3 ");
  sequencer.add(at<Imu>(2.5));
  sequencer.add(at<Imu>(ros::Time::now().toSec() + 1000));
  ros::WallDuration(0.1).sleep();
  ros::spinOnce();
  CHECK(take().empty());
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "sets");
  ros::NodeHandle node;
  checkExact();
  checkByHand();
  checkApproximate();
  checkOthers();
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
