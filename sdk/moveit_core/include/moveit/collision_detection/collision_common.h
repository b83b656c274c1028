#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace collision_detection {

namespace BodyTypes {
enum Type { ROBOT_LINK, WORLD_OBJECT, ROBOT_ATTACHED };
}  // namespace BodyTypes
typedef BodyTypes::Type BodyType;

/** Point [m] at which two bodies touch, in the planning frame, and how deep [m]. */
struct Contact {
  Eigen::Vector3d pos = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  double depth = 0.0;
  std::string body_name_1, body_name_2;
  BodyType body_type_1 = BodyTypes::ROBOT_LINK, body_type_2 = BodyTypes::ROBOT_LINK;
};

struct CollisionRequest {
  /** Empty for the whole robot. */
  std::string group_name;
  bool contacts = false, verbose = false;
  std::size_t max_contacts = 1, max_contacts_per_pair = 1;
};

struct CollisionResult {
  typedef std::map<std::pair<std::string, std::string>, std::vector<Contact>> ContactMap;

  bool collision = false;
  std::size_t contact_count = 0;
  ContactMap contacts;

  void clear() { *this = CollisionResult(); }
};

}  // namespace collision_detection
