// Exceptions of Gazebo: gzthrow("a text " << of << " parts").
#ifndef GAZEBO_COMMON_EXCEPTION_HH_
#define GAZEBO_COMMON_EXCEPTION_HH_

#include <cstdint>
#include <ostream>
#include <sstream>
#include <string>

#define gzthrow(message)                                                         \
  {                                                                              \
    std::ostringstream trundle_stream;                                           \
    trundle_stream << message;                                                   \
    throw ::gazebo::common::Exception(__FILE__, __LINE__, trundle_stream.str()); \
  }

namespace gazebo {
namespace common {

class Exception {
 public:
  Exception() : line_(0) {}
  Exception(const char* file, int64_t line, std::string text) : file_(file), text_(text), line_(line) {}
  virtual ~Exception() {}
  std::string GetErrorFile() const { return file_; }
  std::string GetErrorStr() const { return text_; }
  void Print() const;
  friend std::ostream& operator<<(std::ostream& out, const Exception& e) { return out << e.text_; }

 private:
  std::string file_, text_;
  int64_t line_;
};

class InternalError : public Exception {
 public:
  InternalError() {}
  InternalError(const char* file, int64_t line, const std::string text) : Exception(file, line, text) {}
};

class AssertionInternalError : public InternalError {
 public:
  AssertionInternalError(const char* file, int64_t line, const std::string expression, const std::string function,
                         const std::string text = "")
      : InternalError(file, line, function + ": " + expression + ": " + text) {}
};

}  // namespace common
}  // namespace gazebo

#endif
