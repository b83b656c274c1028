#pragma once

#include <boost/shared_array.hpp>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "socket.h"

namespace ros {
namespace net {

/** A socket that the loop's thread watches. */
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  explicit Connection(Socket socket);
  virtual ~Connection();

  /** Send bytes: at once if the socket accepts them, else later. At most `limit` packets wait (0: no limit); the
   * oldest are dropped. */
  void send(const boost::shared_array<uint8_t>& bytes, size_t size, size_t limit = 0);
  void send(const std::vector<uint8_t>& bytes);
  /** Close; with `after_sending`, once all packets are sent. */
  void close(bool after_sending = false);
  bool isClosed() const;

  /** Called once, by the loop's thread. */
  std::function<void()> on_closed;

 protected:
  /** Read the available bytes; false at the end of the stream. */
  virtual bool onReadable() = 0;
  /** Send the bytes of a packet after the first `sent`, or a part of them. Returns their number, or -1 with errno. */
  virtual ptrdiff_t write(const uint8_t* bytes, size_t size, size_t sent);
  /** Read at most `size` bytes without waiting. Returns their number, 0 if none are available, -1 at the end. */
  ptrdiff_t receive(void* bytes, size_t size);
  int fd() const { return socket_.fd(); }

 private:
  friend class Loop;
  struct Packet {
    boost::shared_array<uint8_t> bytes;
    size_t size;
  };
  /** Send the waiting packets; false if the connection is broken. Needs the mutex. */
  bool flush();
  bool wantsToWrite() const;
  bool onWritable();

  mutable std::mutex mutex_;
  Socket socket_;
  std::deque<Packet> packets_;
  size_t sent_ = 0;
  bool is_closed_ = false, closes_after_sending_ = false;
};

/** Connection of packets, each after its length: headers, messages, requests. */
class FrameConnection : public Connection {
 public:
  using Connection::Connection;
  /** Called by the loop's thread with each packet; false closes the connection. */
  std::function<bool(const boost::shared_array<uint8_t>&, uint32_t)> on_frame;
  /** Maximum length of the next packet [bytes]. */
  uint32_t max_frame = 0;

 protected:
  bool onReadable() override;

 private:
  uint8_t length_[4] = {};
  size_t have_ = 0;
  uint32_t size_ = 0;
  size_t capacity_ = 0;
  boost::shared_array<uint8_t> body_;
};

/** Thread that watches all sockets of the node. */
class Loop {
 public:
  static Loop& instance();
  void start();
  /** Close all connections, and end the thread. */
  void stop();
  /** Watch a connection; false if there are too many. */
  bool add(const std::shared_ptr<Connection>& connection);
  /** Accept connections on a socket. */
  void accept(Socket listening, std::function<void(Socket)> accepted);
  void wake();
  bool isOwnThread() const { return std::this_thread::get_id() == thread_.get_id(); }

 private:
  void run();
  std::mutex mutex_;
  std::vector<std::shared_ptr<Connection>> connections_;
  std::thread thread_;
  int wake_[2] = {-1, -1};
  bool is_running_ = false;
};

}  // namespace net
}  // namespace ros
