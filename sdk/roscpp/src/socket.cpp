#include "socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>

namespace ros {
namespace net {
namespace {

std::atomic<int64_t> abort_time{INT64_MAX};  // time of the steady clock at which waits end [ms]
constexpr int kSliceMs = 50;                 // interval at which waits check whether the node shuts down
#ifdef MSG_NOSIGNAL
constexpr int kFlags = MSG_NOSIGNAL;
#else
constexpr int kFlags = 0;
#endif

struct AddressList {
  addrinfo* first = nullptr;
  AddressList(const std::string& host, const std::string& port, int flags) {
    addrinfo hints = {};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = flags;
    const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &first);
    if (error != 0) throw NetError("host '" + host + "' is not found: " + gai_strerror(error));
  }
  ~AddressList() {
    if (first) freeaddrinfo(first);
  }
};

int64_t now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
}

[[noreturn]] void fail(const std::string& what) { throw NetError(what + ": " + std::strerror(errno)); }

}  // namespace

void abortWaiting(int ms) { abort_time = now() + ms; }
void allowWaiting() { abort_time = INT64_MAX; }

Socket& Socket::operator=(Socket&& other) noexcept {
  if (this != &other) {
    close();
    fd_ = other.fd_;
    other.fd_ = -1;
  }
  return *this;
}

void Socket::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

void Socket::setNonBlocking() { fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL, 0) | O_NONBLOCK); }

void Socket::setNoDelay() {
  const int on = 1;
  setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
}

void Socket::wait(short events) {
  pollfd entry = {fd_, events, 0};
  while (now() <= abort_time) {
    const int ready = poll(&entry, 1, kSliceMs);
    if (ready > 0) return;
    if (ready < 0 && errno != EINTR) fail("poll");
  }
  throw NetError("the node shuts down");
}

Socket Socket::connect(const std::string& host, uint16_t port) {
  const AddressList addresses(host, std::to_string(port), 0);
  std::string reason = "no address";
  for (const addrinfo* address = addresses.first; address; address = address->ai_next) {
    Socket socket(::socket(address->ai_family, SOCK_STREAM, 0));
    if (!socket.isOpen()) continue;
    fcntl(socket.fd_, F_SETFD, FD_CLOEXEC);
    socket.setNonBlocking();
    if (::connect(socket.fd_, address->ai_addr, address->ai_addrlen) != 0) {
      if (errno != EINPROGRESS) {
        reason = std::strerror(errno);
        continue;
      }
      socket.wait(POLLOUT);
      int error = 0;
      socklen_t size = sizeof(error);
      getsockopt(socket.fd_, SOL_SOCKET, SO_ERROR, &error, &size);
      if (error != 0) {
        reason = std::strerror(error);
        continue;
      }
    }
    socket.setNoDelay();
    return socket;
  }
  throw NetError("cannot connect to " + host + ":" + std::to_string(port) + ": " + reason);
}

Socket Socket::listen(const std::string& address, uint16_t& port) {
  const AddressList addresses(address, std::to_string(port), AI_PASSIVE);
  Socket socket(::socket(addresses.first->ai_family, SOCK_STREAM, 0));
  if (!socket.isOpen()) fail("socket");
  fcntl(socket.fd_, F_SETFD, FD_CLOEXEC);
  const int on = 1;
  setsockopt(socket.fd_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (bind(socket.fd_, addresses.first->ai_addr, addresses.first->ai_addrlen) != 0) fail("bind to " + address);
  if (::listen(socket.fd_, 100) != 0) fail("listen");
  sockaddr_storage own = {};
  socklen_t size = sizeof(own);
  getsockname(socket.fd_, reinterpret_cast<sockaddr*>(&own), &size);
  port = ntohs(own.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&own)->sin6_port
                                         : reinterpret_cast<sockaddr_in*>(&own)->sin_port);
  socket.setNonBlocking();
  return socket;
}

void Socket::write(const void* bytes, size_t size) {
  const char* position = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t sent = ::send(fd_, position, size, kFlags);
    if (sent > 0) {
      position += sent;
      size -= static_cast<size_t>(sent);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait(POLLOUT);
    } else if (errno != EINTR) {
      fail("send");
    }
  }
}

size_t Socket::readSome(void* bytes, size_t size) {
  while (true) {
    const ssize_t received = ::recv(fd_, bytes, size, 0);
    if (received >= 0) return static_cast<size_t>(received);
    if (errno == EAGAIN || errno == EWOULDBLOCK) wait(POLLIN);
    else if (errno != EINTR) fail("recv");
  }
}

void Socket::read(void* bytes, size_t size) {
  char* position = static_cast<char*>(bytes);
  while (size > 0) {
    const size_t received = readSome(position, size);
    if (received == 0) throw NetError("the peer closed the connection");
    position += received;
    size -= received;
  }
}

bool Socket::isStale() const {
  pollfd entry = {fd_, POLLIN, 0};
  return poll(&entry, 1, 0) != 0;
}

std::string bindAddress(const std::string& host) {
  try {
    const AddressList addresses(host, "0", 0);
    for (const addrinfo* address = addresses.first; address; address = address->ai_next) {
      if (address->ai_family == AF_INET6 &&
          IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<sockaddr_in6*>(address->ai_addr)->sin6_addr) &&
          host.find(':') != std::string::npos)
        return "::1";
      if (address->ai_family == AF_INET &&
          ntohl(reinterpret_cast<sockaddr_in*>(address->ai_addr)->sin_addr.s_addr) >> 24 == 127)
        return "127.0.0.1";
    }
  } catch (const NetError&) {  // only other machines know the name
  }
  return "0.0.0.0";
}

}  // namespace net
}  // namespace ros
