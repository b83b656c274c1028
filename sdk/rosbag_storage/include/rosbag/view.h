#pragma once

#include <boost/function.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <memory>
#include <vector>

#include "rosbag/bag.h"
#include "rosbag/message_instance.h"
#include "rosbag/query.h"

namespace rosbag {

/** Messages of bags that queries choose, in the order of their times. The bags must exist as long. */
class View {
  struct Found {
    const Bag* bag;
    const ConnectionInfo* connection;
    IndexEntry entry;
  };
  typedef std::shared_ptr<const std::vector<Found> > Messages;

 public:
  typedef boost::function<bool(const ConnectionInfo*)> Choice;

  class iterator : public boost::iterator_facade<iterator, MessageInstance, boost::forward_traversal_tag> {
   public:
    iterator() : position_(0) {}

   private:
    friend class boost::iterator_core_access;
    friend class View;
    iterator(const Messages& messages, size_t position) : messages_(messages), position_(position) {}
    bool equal(const iterator& other) const { return position_ == other.position_; }
    void increment() {
      ++position_;
      message_.reset();
    }
    MessageInstance& dereference() const;

    Messages messages_;
    size_t position_;
    mutable std::shared_ptr<MessageInstance> message_;
  };
  typedef iterator const_iterator;

  /** View without messages; see addQuery. `reduce_overlap`: a message that several queries choose is there once. */
  explicit View(const bool& reduce_overlap = false);
  View(const Bag& bag, const ros::Time& start_time = ros::TIME_MIN, const ros::Time& end_time = ros::TIME_MAX,
       const bool& reduce_overlap = false);
  View(const Bag& bag, Choice query, const ros::Time& start_time = ros::TIME_MIN,
       const ros::Time& end_time = ros::TIME_MAX, const bool& reduce_overlap = false);
  ~View();

  iterator begin();
  iterator end();
  uint32_t size();
  void addQuery(const Bag& bag, const ros::Time& start_time = ros::TIME_MIN, const ros::Time& end_time = ros::TIME_MAX);
  void addQuery(const Bag& bag, Choice query, const ros::Time& start_time = ros::TIME_MIN,
                const ros::Time& end_time = ros::TIME_MAX);
  std::vector<const ConnectionInfo*> getConnections();
  /** Times of the first and the last message. */
  ros::Time getBeginTime();
  ros::Time getEndTime();

 private:
  View(const View&);
  View& operator=(const View&);
  struct Query {
    const Bag* bag;
    Choice choice;
    ros::Time start, end;
  };
  /** Messages as they are now; a bag that is written grows. */
  const Messages& update();

  std::vector<Query> queries_;
  bool is_reduced_;
  Messages messages_;
  uint64_t revision_;
};

}  // namespace rosbag
