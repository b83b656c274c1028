#pragma once

#include <boost/shared_ptr.hpp>

namespace actionlib {

/** Deleter of a pointer to a member: it keeps the object around it. */
template <class Enclosure>
class EnclosureDeleter {
 public:
  explicit EnclosureDeleter(const boost::shared_ptr<Enclosure>& enclosure) : enclosure_(enclosure) {}
  template <class Member>
  void operator()(Member*) {
    enclosure_.reset();
  }

 private:
  boost::shared_ptr<Enclosure> enclosure_;
};

/** Pointer to a member that keeps the object around it. */
template <class Enclosure, class Member>
boost::shared_ptr<Member> share_member(boost::shared_ptr<Enclosure> enclosure, Member& member) {
  return boost::shared_ptr<Member>(&member, EnclosureDeleter<Enclosure>(enclosure));
}

}  // namespace actionlib
