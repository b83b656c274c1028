#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace ros {
namespace net {

/** A connection failed or ended. */
class NetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/** TCP socket; calls that wait end with an error once the node shuts down. */
class Socket {
 public:
  Socket() = default;
  explicit Socket(int fd) : fd_(fd) {}
  Socket(Socket&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Socket& operator=(Socket&& other) noexcept;
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { close(); }

  static Socket connect(const std::string& host, uint16_t port);
  /** Listen on an address, on a free port. */
  static Socket listen(const std::string& address, uint16_t& port);

  int fd() const { return fd_; }
  bool isOpen() const { return fd_ >= 0; }
  void close();
  void setNonBlocking();
  void setNoDelay();
  void write(const void* bytes, size_t size);
  void read(void* bytes, size_t size);
  /** Read at most `size` bytes; 0 at the end of the stream. */
  size_t readSome(void* bytes, size_t size);
  /** True if the peer has closed the connection, or has sent unexpected bytes. */
  bool isStale() const;

 private:
  void wait(short events);
  int fd_ = -1;
};

/** End all waiting calls, and later ones, after a time [ms]. */
void abortWaiting(int ms);
void allowWaiting();

/** Address to listen on, for the host in this node's URIs: loopback if the host is loopback, else all addresses. */
std::string bindAddress(const std::string& host);

}  // namespace net
}  // namespace ros
