#include "datagrams.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "connection_header.h"
#include "ros/console.h"

namespace ros {
namespace net {
namespace {

constexpr size_t kHead = 8;
constexpr size_t kMaxBlocks = 65535;
constexpr int kDatagramsAtOnce = 256;       // of one connection before the others' turn
constexpr int kReceiveBuffer = 4 << 20;     // [bytes]; the system's limit may be lower
constexpr size_t kFirstCapacity = 1 << 16;  // the buffer of a longer message grows as its bytes arrive
enum Operation : uint8_t { kFirst = 0, kLater = 1, kPing = 2, kError = 3 };

uint32_t number(const uint8_t* bytes, int count) {
  uint32_t value = 0;
  for (int i = 0; i < count; ++i) value |= static_cast<uint32_t>(bytes[i]) << 8 * i;
  return value;
}

}  // namespace

Socket bindDatagrams(const std::string& address, uint16_t& port) {
  sockaddr_storage own = {};
  socklen_t size = 0;
  if (address.find(':') != std::string::npos) {
    auto* const six = reinterpret_cast<sockaddr_in6*>(&own);
    six->sin6_family = AF_INET6;
    six->sin6_addr = in6addr_loopback;
    size = sizeof(*six);
  } else {
    auto* const four = reinterpret_cast<sockaddr_in*>(&own);
    four->sin_family = AF_INET;
    four->sin_addr.s_addr = htonl(address == "0.0.0.0" ? INADDR_ANY : INADDR_LOOPBACK);
    size = sizeof(*four);
  }
  Socket socket(::socket(own.ss_family, SOCK_DGRAM, 0));
  if (!socket.isOpen() || bind(socket.fd(), reinterpret_cast<sockaddr*>(&own), size) != 0)
    throw NetError("cannot receive datagrams at " + address + ": " + std::strerror(errno));
  fcntl(socket.fd(), F_SETFD, FD_CLOEXEC);
  socket.setNonBlocking();
  setsockopt(socket.fd(), SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof(kReceiveBuffer));
  getsockname(socket.fd(), reinterpret_cast<sockaddr*>(&own), &size);
  port = ntohs(own.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&own)->sin6_port
                                         : reinterpret_cast<sockaddr_in*>(&own)->sin_port);
  return socket;
}

void connectDatagrams(Socket& socket, const std::string& host, uint16_t port) {
  sockaddr_storage own = {};
  socklen_t size = sizeof(own);
  getsockname(socket.fd(), reinterpret_cast<sockaddr*>(&own), &size);
  addrinfo hints = {}, *found = nullptr;
  hints.ai_family = own.ss_family;
  hints.ai_socktype = SOCK_DGRAM;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) throw NetError("host '" + host + "' is not found: " + gai_strerror(error));
  const int result = ::connect(socket.fd(), found->ai_addr, found->ai_addrlen);
  freeaddrinfo(found);
  if (result != 0) throw NetError("cannot send to " + host + ":" + std::to_string(port) + ": " + std::strerror(errno));
}

DatagramSender::DatagramSender(Socket socket, uint32_t id, int size)
    : Connection(std::move(socket)), id_(id), room_(static_cast<size_t>(size) - kHead) {}

bool DatagramSender::onReadable() {
  uint8_t ignored = 0;  // subscribers send nothing; the system tells that their port is closed
  return ::recv(fd(), &ignored, 1, MSG_DONTWAIT) >= 0 || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

ptrdiff_t DatagramSender::write(const uint8_t* bytes, size_t size, size_t sent) {
  const size_t blocks = (size + room_ - 1) / room_, block = sent / room_;
  if (blocks > kMaxBlocks) {
    ROS_ERROR_ONCE("A message of %zu bytes is too long for UDPROS with datagrams of %zu bytes, and is dropped", size,
                   room_ + kHead);
    return static_cast<ptrdiff_t>(size - sent);
  }
  if (block == 0 && ++message_ == 0) ++message_;  // roscpp takes 0 for no message
  const size_t shown = block == 0 ? blocks : block;
  uint8_t head[kHead] = {};
  for (int i = 0; i < 4; ++i) head[i] = static_cast<uint8_t>(id_ >> 8 * i);
  head[4] = block == 0 ? kFirst : kLater;
  head[5] = message_;
  head[6] = static_cast<uint8_t>(shown);
  head[7] = static_cast<uint8_t>(shown >> 8);
  iovec parts[2] = {{head, kHead}, {const_cast<uint8_t*>(bytes + sent), std::min(room_, size - sent)}};
  msghdr datagram = {};
  datagram.msg_iov = parts;
  datagram.msg_iovlen = 2;
  const ssize_t count = ::sendmsg(fd(), &datagram, MSG_DONTWAIT);
  if (count < 0 && block == 0) --message_;
  return count < 0 ? count : static_cast<ptrdiff_t>(parts[1].iov_len);
}

bool DatagramReceiver::onReadable() {
  static thread_local uint8_t datagram[65536];
  for (int round = 0; round < kDatagramsAtOnce; ++round) {
    const ssize_t count = ::recv(fd(), datagram, sizeof(datagram), MSG_DONTWAIT);
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return true;
    if (count < 0 && errno != EINTR) return false;
    if (count >= static_cast<ssize_t>(kHead) && !onDatagram(datagram, static_cast<size_t>(count))) return false;
  }
  return true;
}

bool DatagramReceiver::onDatagram(const uint8_t* bytes, size_t size) {
  if (number(bytes, 4) != id_) return true;
  const uint32_t block = number(bytes + 6, 2);
  switch (bytes[4]) {
    case kFirst:
      is_open_ = block > 0 && size >= kHead + 4;
      if (!is_open_) return true;
      message_ = bytes[5];
      blocks_ = block;
      next_block_ = 1;
      size_ = number(bytes + kHead, 4);
      // All datagrams but the last are equally long.
      if (size_ > kMaxMessage || size_ + uint64_t{4} > uint64_t{blocks_} * (size - kHead)) {
        is_open_ = false;
        return true;
      }
      filled_ = 0;
      capacity_ = std::min<size_t>(size_, kFirstCapacity);
      body_.reset(new uint8_t[std::max<size_t>(capacity_, 1)]);
      append(bytes + kHead + 4, size - kHead - 4);
      break;
    case kLater:
      if (!is_open_ || bytes[5] != message_) return true;
      is_open_ = block == next_block_;
      if (!is_open_) return true;
      ++next_block_;
      append(bytes + kHead, size - kHead);
      break;
    case kError: return false;
    default: return true;  // a ping, or an operation of a later version
  }
  if (!is_open_ || next_block_ < blocks_) return true;
  is_open_ = false;
  const boost::shared_array<uint8_t> body = std::move(body_);
  body_.reset();
  return filled_ != size_ || on_message(body, size_);
}

void DatagramReceiver::append(const uint8_t* bytes, size_t size) {
  is_open_ = size <= size_ - filled_;
  if (!is_open_) return;
  if (size > capacity_ - filled_) {
    const size_t wider = std::min<size_t>(size_, std::max(capacity_ * 2, filled_ + size));
    boost::shared_array<uint8_t> larger(new uint8_t[wider]);
    std::memcpy(larger.get(), body_.get(), filled_);
    body_ = larger;
    capacity_ = wider;
  }
  std::memcpy(body_.get() + filled_, bytes, size);
  filled_ += size;
}

}  // namespace net
}  // namespace ros
