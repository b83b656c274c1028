#ifndef GAZEBO_SENSORS_CONTACTSENSOR_HH_
#define GAZEBO_SENSORS_CONTACTSENSOR_HH_

#include <map>
#include <string>
#include <vector>

#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/Contact.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// Contacts of the sensor's collisions at the last reading.
class ContactSensor : public Sensor {
 public:
  ContactSensor() : Sensor(OTHER) {}

  msgs::Contacts Contacts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return contacts_;
  }
  // Of one of its collisions, `model::link::collision`, by the other's name.
  std::map<std::string, physics::Contact> Contacts(const std::string& collision) const;
  msgs::Contacts GetContacts() const { return Contacts(); }
  std::map<std::string, physics::Contact> GetContacts(const std::string& collision) const {
    return Contacts(collision);
  }
  unsigned int GetCollisionCount() const { return static_cast<unsigned int>(collisions_.size()); }
  std::string GetCollisionName(unsigned int index) const { return collisions_.at(index); }
  unsigned int GetCollisionContactCount(const std::string& collision) const;

 protected:
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override;

 private:
  std::vector<std::string> collisions_;
  msgs::Contacts contacts_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
