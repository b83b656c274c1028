#ifndef GAZEBO_PHYSICS_CONTACTMANAGER_HH_
#define GAZEBO_PHYSICS_CONTACTMANAGER_HH_

#include <map>
#include <set>
#include <string>
#include <vector>

#include <gazebo/physics/Contact.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {
namespace physics {

// Contacts of the last step, and topics for those of some collisions.
class ContactManager {
 public:
  explicit ContactManager(World* world) : world_(world) {}
  ~ContactManager();

  // Contacts that were asked for in an earlier step: the first call has none, as they are collected from then on.
  unsigned int GetContactCount() const;
  Contact* GetContact(unsigned int index) const;
  const std::vector<Contact*>& GetContacts() const;
  // Topic with the contacts of one or several collisions, `model::link::collision`, after each step.
  std::string CreateFilter(const std::string& name, const std::string& collision);
  std::string CreateFilter(const std::string& name, const std::vector<std::string>& collisions);
  std::string CreateFilter(const std::string& name, const std::map<std::string, CollisionPtr>& collisions);
  void RemoveFilter(const std::string& name) { filters_.erase(name); }
  bool HasFilter(const std::string& name) { return filters_.count(name) != 0; }
  // Contacts are published after each step.
  void PublishContacts() {}

  // For the library: read the last step's contacts, if anybody wants them.
  void Update(const common::Time& time);

 private:
  struct Filter {
    std::set<std::string> collisions;
    transport::PublisherPtr publisher;
  };
  ContactManager(const ContactManager&);
  void Collect(const common::Time& time);
  void Publish(const common::Time& time);

  World* world_;
  mutable bool is_wanted_ = false;
  std::vector<Contact*> contacts_;
  std::map<std::string, Filter> filters_;
};

}  // namespace physics
}  // namespace gazebo

#endif
