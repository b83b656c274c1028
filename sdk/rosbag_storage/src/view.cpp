#include "rosbag/view.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "bag_impl.h"

namespace rosbag {
namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool isAny(const ConnectionInfo*) { return true; }

}  // namespace

bool TopicQuery::operator()(const ConnectionInfo* connection) const { return contains(topics_, connection->topic); }
bool TypeQuery::operator()(const ConnectionInfo* connection) const { return contains(types_, connection->datatype); }

std::string MessageInstance::getCallerId() const {
  const auto found = connection_->header->find("callerid");
  return found == connection_->header->end() ? "" : found->second;
}

bool MessageInstance::isLatching() const {
  const auto found = connection_->header->find("latching");
  return found != connection_->header->end() && found->second == "1";
}

const uint8_t* MessageInstance::bytes(uint32_t& length) const {
  return bag_->impl_->readMessage(*connection_, entry_, length);
}

MessageInstance& View::iterator::dereference() const {
  if (!message_) {
    const Found& found = (*messages_)[position_];
    message_ = std::make_shared<MessageInstance>(found.connection, found.entry, found.bag);
  }
  return *message_;
}

View::View(const bool& reduce_overlap) : is_reduced_(reduce_overlap), revision_(0) {}
View::View(const Bag& bag, const ros::Time& start_time, const ros::Time& end_time, const bool& reduce_overlap)
    : View(reduce_overlap) {
  addQuery(bag, start_time, end_time);
}
View::View(const Bag& bag, Choice query, const ros::Time& start_time, const ros::Time& end_time,
           const bool& reduce_overlap)
    : View(reduce_overlap) {
  addQuery(bag, query, start_time, end_time);
}
View::~View() {}

void View::addQuery(const Bag& bag, const ros::Time& start_time, const ros::Time& end_time) {
  addQuery(bag, isAny, start_time, end_time);
}

void View::addQuery(const Bag& bag, Choice query, const ros::Time& start_time, const ros::Time& end_time) {
  if (!bag.isOpen()) throw BagException("the bag is not open");
  queries_.push_back({&bag, query, start_time, end_time});
  messages_.reset();
}

const View::Messages& View::update() {
  uint64_t revision = 0;
  for (const Query& query : queries_) revision += query.bag->impl_->revision;
  if (messages_ && revision == revision_) return messages_;
  std::vector<Found> found;
  std::set<std::tuple<const Bag*, uint64_t, uint32_t> > seen;
  for (const Query& query : queries_) {
    Bag::Impl& bag = *query.bag->impl_;
    for (const auto& [id, entries] : bag.sortedIndex()) {
      const ConnectionInfo& connection = bag.connections.at(id);
      if (!query.choice(&connection)) continue;
      const auto first = std::lower_bound(entries.begin(), entries.end(), IndexEntry{query.start, 0, 0});
      const auto last = std::upper_bound(first, entries.end(), IndexEntry{query.end, 0, 0});
      for (auto entry = first; entry != last; ++entry)
        if (!is_reduced_ || seen.emplace(query.bag, entry->chunk_pos, entry->offset).second)
          found.push_back({query.bag, &connection, *entry});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(a.entry.time, a.entry.chunk_pos, a.entry.offset) <
           std::tie(b.entry.time, b.entry.chunk_pos, b.entry.offset);
  });
  revision_ = revision;
  return messages_ = std::make_shared<const std::vector<Found> >(std::move(found));
}

View::iterator View::begin() { return iterator(update(), 0); }
View::iterator View::end() { return iterator(update(), update()->size()); }
uint32_t View::size() { return static_cast<uint32_t>(update()->size()); }

std::vector<const ConnectionInfo*> View::getConnections() {
  std::vector<const ConnectionInfo*> connections;
  for (const Query& query : queries_)
    for (const auto& [id, connection] : query.bag->impl_->connections)
      if (query.choice(&connection) &&
          std::find(connections.begin(), connections.end(), &connection) == connections.end())
        connections.push_back(&connection);
  return connections;
}

ros::Time View::getBeginTime() { return update()->empty() ? ros::Time() : messages_->front().entry.time; }
ros::Time View::getEndTime() { return update()->empty() ? ros::Time() : messages_->back().entry.time; }

}  // namespace rosbag
