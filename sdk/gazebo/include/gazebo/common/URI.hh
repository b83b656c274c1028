// Uniform resource identifiers: scheme://path?query, such as data://world/default/model/box?p=pose.
#ifndef GAZEBO_COMMON_URI_HH_
#define GAZEBO_COMMON_URI_HH_

#include <deque>
#include <map>
#include <string>

namespace gazebo {
namespace common {

// Parts between slashes.
class URIPath {
 public:
  URIPath() {}
  // Empty if the text is no path.
  URIPath(const std::string& text) { Parse(text); }
  virtual ~URIPath() {}

  void PushFront(const std::string& part) { parts_.push_front(part); }
  void PushBack(const std::string& part) { parts_.push_back(part); }
  void Clear() { parts_.clear(); }
  std::string Str(const std::string& delimiter = "/") const;
  // False leaves it as it is.
  bool Parse(const std::string& text);
  bool Valid() const { return Valid(Str()); }
  static bool Valid(const std::string& text);

  const URIPath& operator/=(const std::string& part) {
    PushBack(part);
    return *this;
  }
  const URIPath operator/(const std::string& part) const { return URIPath(*this) /= part; }
  bool operator==(const URIPath& other) const { return parts_ == other.parts_; }

 private:
  std::deque<std::string> parts_;
};

// Values by their keys.
class URIQuery {
 public:
  URIQuery() {}
  // Empty if the text is no query.
  URIQuery(const std::string& text) { Parse(text); }
  virtual ~URIQuery() {}

  // The first value of a key stays.
  void Insert(const std::string& key, const std::string& value) { values_.emplace(key, value); }
  void Clear() { values_.clear(); }
  // With a question mark before it, in the order of the keys; "" without values.
  std::string Str(const std::string& delimiter = "&") const;
  bool Parse(const std::string& text);
  bool Valid() const { return Valid(Str()); }
  static bool Valid(const std::string& text);
  bool operator==(const URIQuery& other) const { return values_ == other.values_; }

 private:
  std::map<std::string, std::string> values_;
};

class URI {
 public:
  URI() {}
  // Empty if the text is no URI.
  URI(const std::string& text) { Parse(text); }

  std::string Scheme() const { return scheme_; }
  void SetScheme(const std::string& scheme) { scheme_ = scheme; }
  URIPath& Path() { return path_; }
  const URIPath& Path() const { return path_; }
  URIQuery& Query() { return query_; }
  const URIQuery& Query() const { return query_; }
  void Clear() { *this = URI(); }
  std::string Str() const;
  bool Parse(const std::string& text);
  bool Valid() const { return Valid(Str()); }
  // Whether it has a scheme, a path, and a query, if any, of keys with values.
  static bool Valid(const std::string& text) { return URI().Parse(text); }
  bool operator==(const URI& other) const {
    return scheme_ == other.scheme_ && path_ == other.path_ && query_ == other.query_;
  }

 private:
  std::string scheme_;
  URIPath path_;
  URIQuery query_;
};

}  // namespace common
}  // namespace gazebo

#endif
