#ifndef SDF_TYPES_HH_
#define SDF_TYPES_HH_

#include <cstdint>
#include <istream>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#define SDF_VERSION "1.7"

namespace sdf {

class Element;
class Param;
typedef std::shared_ptr<Element> ElementPtr;
typedef std::shared_ptr<const Element> ElementConstPtr;
typedef std::weak_ptr<Element> ElementWeakPtr;
typedef std::vector<ElementPtr> ElementPtr_V;
typedef std::shared_ptr<Param> ParamPtr;
typedef std::vector<ParamPtr> Param_V;

// Time of a text: seconds, or seconds and nanoseconds.
class Time {
 public:
  Time() : sec(0), nsec(0) {}
  Time(int32_t seconds, int32_t nanoseconds) : sec(seconds), nsec(nanoseconds) {}
  friend std::ostream& operator<<(std::ostream& out, const Time& time) { return out << time.sec << " " << time.nsec; }
  friend std::istream& operator>>(std::istream& in, Time& time) {
    double seconds = 0.0;
    if (!(in >> seconds)) return in;
    time.sec = static_cast<int32_t>(seconds);
    time.nsec = static_cast<int32_t>((seconds - time.sec) * 1e9 + 0.5);
    int32_t rest = 0;
    if (in >> rest) time.nsec = rest;
    else in.clear(in.rdstate() & ~std::ios::failbit);
    return in;
  }
  int32_t sec, nsec;
};

}  // namespace sdf

#endif
