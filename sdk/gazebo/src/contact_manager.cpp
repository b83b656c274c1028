#include <algorithm>

#include <gazebo/physics/ContactManager.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

Contact& Contact::operator=(const msgs::Contact& message) {
  world = has_world(message.world()) ? get_world(message.world()) : WorldPtr();
  const auto find = [this](const std::string& name) {
    return world ? dynamic_cast<Collision*>(world->BaseByName(name).get()) : nullptr;
  };
  collision1 = find(message.collision1());
  collision2 = find(message.collision2());
  time = msgs::Convert(message.time());
  count = std::min({message.position_size(), message.normal_size(), message.depth_size(), message.wrench_size(),
                    MAX_CONTACT_JOINTS});
  for (int i = 0; i < count; ++i) {
    positions[i] = msgs::ConvertIgn(message.position(i));
    normals[i] = msgs::ConvertIgn(message.normal(i));
    depths[i] = message.depth(i);
    wrench[i].body1Force = msgs::ConvertIgn(message.wrench(i).body_1_wrench().force());
    wrench[i].body1Torque = msgs::ConvertIgn(message.wrench(i).body_1_wrench().torque());
    wrench[i].body2Force = msgs::ConvertIgn(message.wrench(i).body_2_wrench().force());
    wrench[i].body2Torque = msgs::ConvertIgn(message.wrench(i).body_2_wrench().torque());
  }
  return *this;
}

ContactManager::~ContactManager() {
  for (Contact* contact : contacts_) delete contact;
}

unsigned int ContactManager::GetContactCount() const {
  is_wanted_ = true;
  return static_cast<unsigned int>(contacts_.size());
}

const std::vector<Contact*>& ContactManager::GetContacts() const {
  is_wanted_ = true;
  return contacts_;
}

Contact* ContactManager::GetContact(unsigned int index) const {
  return index < GetContactCount() ? contacts_[index] : nullptr;
}

std::string ContactManager::CreateFilter(const std::string& name, const std::string& collision) {
  return CreateFilter(name, std::vector<std::string>(1, collision));
}

std::string ContactManager::CreateFilter(const std::string& name,
                                         const std::map<std::string, CollisionPtr>& collisions) {
  std::vector<std::string> names;
  for (const auto& collision : collisions) names.push_back(collision.first);
  return CreateFilter(name, names);
}

std::string ContactManager::CreateFilter(const std::string& name, const std::vector<std::string>& collisions) {
  std::string word = name;
  for (std::size_t at; (at = word.find("::")) != std::string::npos;) word.replace(at, 2, "/");
  transport::Node node;
  node.Init(world_->Name());
  const std::string topic = "~/" + word + "/contacts";
  Filter& filter = filters_[name];
  filter.collisions.insert(collisions.begin(), collisions.end());
  filter.publisher = node.Advertise<msgs::Contacts>(topic);
  return topic;
}

void ContactManager::Update(const common::Time& time) {
  const bool has_subscribers = std::any_of(
      filters_.begin(), filters_.end(), [](const auto& filter) { return filter.second.publisher->HasConnections(); });
  if (!is_wanted_ && !has_subscribers) return;
  Collect(time);
  if (has_subscribers) Publish(time);
}

// One contact per pair of collisions, with all of its points.
void ContactManager::Collect(const common::Time& time) {
  for (Contact* contact : contacts_) delete contact;
  contacts_.clear();
  const TrundleGazeboHost* host = world_->Host();
  std::vector<TrundleGazeboContact> points(static_cast<std::size_t>(host->contacts(host->self, nullptr, 0)));
  host->contacts(host->self, points.data(), static_cast<int>(points.size()));
  std::map<std::pair<std::string, std::string>, Contact*> pairs;
  for (const TrundleGazeboContact& point : points) {
    Contact*& contact = pairs[{point.collision1, point.collision2}];
    if (!contact) {
      contact = new Contact;
      contact->world = world_->shared_from_this();
      contact->time = time;
      contact->collision1 = dynamic_cast<Collision*>(world_->BaseByName(point.collision1).get());
      contact->collision2 = dynamic_cast<Collision*>(world_->BaseByName(point.collision2).get());
      if (contact->collision1 && contact->collision2) contacts_.push_back(contact);
    }
    if (contact->count >= MAX_CONTACT_JOINTS) continue;
    const int i = contact->count++;
    const ignition::math::Vector3d force(point.force[0], point.force[1], point.force[2]);
    contact->positions[i].Set(point.position[0], point.position[1], point.position[2]);
    contact->normals[i].Set(point.normal[0], point.normal[1], point.normal[2]);
    contact->depths[i] = point.depth;
    contact->wrench[i].body1Force = force;
    contact->wrench[i].body2Force = -force;
  }
  for (const auto& pair : pairs)
    if (std::find(contacts_.begin(), contacts_.end(), pair.second) == contacts_.end()) delete pair.second;
}

void ContactManager::Publish(const common::Time& time) {
  for (auto& filter : filters_) {
    if (!filter.second.publisher->HasConnections()) continue;
    msgs::Contacts message;
    msgs::Set(message.mutable_time(), time);
    for (const Contact* contact : contacts_) {
      const std::string one = contact->collision1->GetScopedName(), other = contact->collision2->GetScopedName();
      if (!filter.second.collisions.count(one) && !filter.second.collisions.count(other)) continue;
      msgs::Contact* written = message.add_contact();
      written->set_collision1(one);
      written->set_collision2(other);
      written->set_world(world_->Name());
      msgs::Set(written->mutable_time(), time);
      for (int i = 0; i < contact->count; ++i) {
        msgs::Set(written->add_position(), contact->positions[i]);
        msgs::Set(written->add_normal(), contact->normals[i]);
        written->add_depth(contact->depths[i]);
        msgs::JointWrench* wrench = written->add_wrench();
        wrench->set_body_1_name(one);
        wrench->set_body_2_name(other);
        msgs::Set(wrench->mutable_body_1_wrench()->mutable_force(), contact->wrench[i].body1Force);
        msgs::Set(wrench->mutable_body_2_wrench()->mutable_force(), contact->wrench[i].body2Force);
      }
    }
    filter.second.publisher->Publish(message);
  }
}

}  // namespace physics
}  // namespace gazebo
