#include "loop.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "connection_header.h"

namespace ros {
namespace net {
namespace {

constexpr size_t kFirstCapacity = 1 << 20;  // the buffer of a longer packet grows as its bytes arrive
constexpr int kReadsAtOnce = 16;            // reads of one connection before the others' turn
constexpr size_t kMaxConnections = 900;     // below the usual limit of open files
#ifdef MSG_NOSIGNAL
constexpr int kFlags = MSG_NOSIGNAL | MSG_DONTWAIT;
#else
constexpr int kFlags = MSG_DONTWAIT;
#endif

class Listener : public Connection {
 public:
  Listener(Socket socket, std::function<void(Socket)> accepted)
      : Connection(std::move(socket)), accepted_(std::move(accepted)) {}

 protected:
  bool onReadable() override {
    Socket socket(::accept(fd(), nullptr, nullptr));
    if (!socket.isOpen()) return true;
    fcntl(socket.fd(), F_SETFD, FD_CLOEXEC);
    socket.setNonBlocking();
    socket.setNoDelay();
    accepted_(std::move(socket));
    return true;
  }

 private:
  std::function<void(Socket)> accepted_;
};

}  // namespace

Connection::Connection(Socket socket) : socket_(std::move(socket)) {}
Connection::~Connection() = default;

bool Connection::isClosed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_closed_;
}

void Connection::close(bool after_sending) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (after_sending && !packets_.empty()) closes_after_sending_ = true;
    else is_closed_ = true;
  }
  Loop::instance().wake();
}

void Connection::send(const std::vector<uint8_t>& bytes) {
  boost::shared_array<uint8_t> copy(new uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), copy.get());
  send(copy, bytes.size());
}

void Connection::send(const boost::shared_array<uint8_t>& bytes, size_t size, size_t limit) {
  bool wakes = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_closed_) return;
    const bool was_empty = packets_.empty();
    if (limit > 0 && packets_.size() >= limit) {
      // The first packet stays: a part of it may have been sent.
      const size_t first = sent_ > 0 ? 1 : 0;
      if (packets_.size() > first) packets_.erase(packets_.begin() + static_cast<ptrdiff_t>(first));
    }
    packets_.push_back({bytes, size});
    if (was_empty) {
      if (!flush()) is_closed_ = true;
      wakes = is_closed_ || !packets_.empty();
    }
  }
  if (wakes) Loop::instance().wake();
}

ptrdiff_t Connection::write(const uint8_t* bytes, size_t size, size_t sent) {
  return ::send(socket_.fd(), bytes + sent, size - sent, kFlags);
}

bool Connection::flush() {
  while (!packets_.empty()) {
    const Packet& packet = packets_.front();
    const ptrdiff_t count = write(packet.bytes.get(), packet.size, sent_);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    sent_ += static_cast<size_t>(count);
    if (sent_ < packet.size) continue;
    packets_.pop_front();
    sent_ = 0;
  }
  return true;
}

bool Connection::wantsToWrite() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !packets_.empty();
}

bool Connection::onWritable() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return flush() && !(closes_after_sending_ && packets_.empty());
}

ptrdiff_t Connection::receive(void* bytes, size_t size) {
  while (true) {
    const ssize_t count = ::recv(socket_.fd(), bytes, size, MSG_DONTWAIT);
    if (count > 0) return count;
    if (count == 0) return -1;
    if (errno == EINTR) continue;
    return errno == EAGAIN || errno == EWOULDBLOCK ? 0 : -1;
  }
}

bool FrameConnection::onReadable() {
  for (int round = 0; round < kReadsAtOnce; ++round) {
    if (have_ < 4) {
      const ptrdiff_t count = receive(length_ + have_, 4 - have_);
      if (count <= 0) return count == 0;
      have_ += static_cast<size_t>(count);
      if (have_ < 4) continue;
      size_ = length_[0] | static_cast<uint32_t>(length_[1]) << 8 | static_cast<uint32_t>(length_[2]) << 16 |
              static_cast<uint32_t>(length_[3]) << 24;
      if (size_ > max_frame) return false;
      capacity_ = std::min<size_t>(size_, kFirstCapacity);
      body_.reset(new uint8_t[std::max<size_t>(capacity_, 1)]);
    }
    size_t filled = have_ - 4;
    if (filled == capacity_ && filled < size_) {
      const size_t wider = std::min<size_t>(size_, capacity_ * 2);
      boost::shared_array<uint8_t> larger(new uint8_t[wider]);
      std::memcpy(larger.get(), body_.get(), filled);
      body_ = larger;
      capacity_ = wider;
    }
    if (filled < size_) {
      const ptrdiff_t count = receive(body_.get() + filled, capacity_ - filled);
      if (count <= 0) return count == 0;
      have_ += static_cast<size_t>(count);
      filled += static_cast<size_t>(count);
    }
    if (filled < size_) continue;
    have_ = 0;
    const boost::shared_array<uint8_t> body = std::move(body_);
    body_.reset();
    const auto handler = on_frame;  // a handler may replace itself
    if (!handler || !handler(body, size_)) return false;
  }
  return true;
}

Loop& Loop::instance() {
  static Loop* const loop = new Loop;
  return *loop;
}

void Loop::start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_running_) return;
  if (wake_[0] < 0) {
    if (pipe(wake_) != 0) throw NetError(std::string("pipe: ") + std::strerror(errno));
    for (const int end : wake_) {
      fcntl(end, F_SETFL, O_NONBLOCK);
      fcntl(end, F_SETFD, FD_CLOEXEC);
    }
  }
  is_running_ = true;
  thread_ = std::thread([this] { run(); });
}

void Loop::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_running_) return;
    is_running_ = false;
  }
  wake();
  thread_.join();
}

bool Loop::add(const std::shared_ptr<Connection>& connection) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (connections_.size() >= kMaxConnections) return false;  // the last owner closes the socket
    connections_.push_back(connection);
  }
  wake();
  return true;
}

void Loop::accept(Socket listening, std::function<void(Socket)> accepted) {
  add(std::make_shared<Listener>(std::move(listening), std::move(accepted)));
}

void Loop::wake() {
  const char byte = 0;
  if (wake_[1] >= 0) (void)!::write(wake_[1], &byte, 1);  // if the pipe is full, the loop wakes anyway
}

void Loop::run() {
  std::vector<std::shared_ptr<Connection>> watched;
  std::vector<pollfd> entries;
  while (true) {
    watched.clear();
    entries.assign(1, {wake_[0], POLLIN, 0});
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_running_) break;
      watched = connections_;
    }
    for (const auto& connection : watched) {
      const short events = static_cast<short>(POLLIN | (connection->wantsToWrite() ? POLLOUT : 0));
      entries.push_back({connection->fd(), events, 0});
    }
    if (poll(entries.data(), entries.size(), -1) < 0 && errno != EINTR) break;
    char drained[64];
    while (::read(wake_[0], drained, sizeof(drained)) > 0) {}
    for (size_t i = 0; i < watched.size(); ++i) {
      Connection& connection = *watched[i];
      const short events = entries[i + 1].revents;
      bool goes_on = !connection.isClosed();
      if (goes_on && events & POLLOUT) goes_on = connection.onWritable();
      if (goes_on && events & (POLLIN | POLLHUP | POLLERR)) goes_on = connection.onReadable();
      if (goes_on && !connection.isClosed()) continue;
      connection.close();
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        connections_.erase(std::find(connections_.begin(), connections_.end(), watched[i]));
      }
      if (const auto closed = std::move(connection.on_closed)) closed();
      connection.on_closed = nullptr;
    }
  }
  std::vector<std::shared_ptr<Connection>> rest;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    rest.swap(connections_);
  }
  for (const auto& connection : rest) {
    connection->close();
    if (const auto closed = std::move(connection->on_closed)) closed();
  }
}

}  // namespace net
}  // namespace ros
