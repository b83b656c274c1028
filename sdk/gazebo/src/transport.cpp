#include <algorithm>
#include <map>
#include <mutex>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {
namespace transport {

struct Topic {
  struct Entry {
    int id;
    std::type_index type;
    Subscriber::Function function;
    event::internal::Owner owner;
  };
  mutable std::mutex mutex;
  std::vector<Entry> entries;
  int last_id = 0;
};

std::shared_ptr<Topic> OpenTopic(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<Topic>> topics;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<Topic> topic = topics[name].lock();
  if (!topic) topics[name] = topic = std::make_shared<Topic>();
  return topic;
}

bool HasSubscribers(const Topic& topic) {
  const std::lock_guard<std::mutex> lock(topic.mutex);
  return !topic.entries.empty();
}

void Deliver(Topic& topic, std::type_index type, const boost::shared_ptr<const void>& message) {
  std::vector<Topic::Entry> entries;
  {
    const std::lock_guard<std::mutex> lock(topic.mutex);
    entries = topic.entries;
  }
  for (const Topic::Entry& entry : entries) {
    if (entry.type != type) continue;
    const event::internal::Running running(entry.owner);
    try {
      entry.function(message);
    } catch (...) {
      event::internal::ReportException(entry.owner);
    }
  }
}

Subscriber::Subscriber(const std::string& name, std::type_index type, const Function& function)
    : name_(name), topic_(OpenTopic(name)) {
  const std::lock_guard<std::mutex> lock(topic_->mutex);
  id_ = ++topic_->last_id;
  topic_->entries.push_back({id_, type, function, event::internal::CurrentOwner()});
}

void Subscriber::Unsubscribe() {
  const std::lock_guard<std::mutex> lock(topic_->mutex);
  auto& entries = topic_->entries;
  entries.erase(std::remove_if(entries.begin(), entries.end(), [this](const Topic::Entry& e) { return e.id == id_; }),
                entries.end());
}

void Node::Init(const std::string& space) {
  space_ = space;
  if (space_.empty() || space_ == "default")
    space_ = physics::has_world() ? physics::get_world()->Name() : std::string("default");
}

std::string Node::DecodeTopicName(const std::string& topic) const {
  if (topic.compare(0, 2, "~/") == 0) return "/gazebo/" + space_ + topic.substr(1);
  return !topic.empty() && topic[0] == '/' ? topic : "/" + topic;
}

std::string Node::EncodeTopicName(const std::string& topic) const {
  const std::string prefix = "/gazebo/" + space_;
  return topic.compare(0, prefix.size(), prefix) == 0 ? "~" + topic.substr(prefix.size()) : topic;
}

}  // namespace transport
}  // namespace gazebo
