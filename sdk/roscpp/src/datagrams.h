#pragma once

#include "loop.h"

namespace ros {
namespace net {

/** UDPROS: messages in datagrams, which may be lost. Format: wiki.ros.org/ROS/UDPROS.
 *
 * Each datagram starts with 8 bytes: connection id (4), operation (1), message id (1), block (2); little endian. The
 * first one of a message has the number of its datagrams as block, later ones their index. */

constexpr int kDatagramSize = 1500;  // [bytes] that a subscriber asks for by default, as roscpp does
constexpr int kMinDatagramSize = 64;
constexpr int kMaxDatagramSize = 65507;  // longest payload of UDP over IPv4

/** Bind a UDP socket to an address, on a free port. */
Socket bindDatagrams(const std::string& address, uint16_t& port);
/** Send a bound socket's datagrams to a host; throws NetError. */
void connectDatagrams(Socket& socket, const std::string& host, uint16_t port);

/** Sends each packet in datagrams; a peer whose port is closed ends it. */
class DatagramSender : public Connection {
 public:
  /** `size`: maximum length of a datagram [bytes]. */
  DatagramSender(Socket socket, uint32_t id, int size);

 protected:
  bool onReadable() override;
  ptrdiff_t write(const uint8_t* bytes, size_t size, size_t sent) override;

 private:
  const uint32_t id_;
  const size_t room_;
  uint8_t message_ = 0;
};

/** Joins the datagrams of one publisher to messages. A message of which one is missing or out of order is dropped. */
class DatagramReceiver : public Connection {
 public:
  /** `id`: the only connection id that is listened to. */
  DatagramReceiver(Socket socket, uint32_t id) : Connection(std::move(socket)), id_(id) {}
  /** Called by the loop's thread with each message; false closes the connection. */
  std::function<bool(const boost::shared_array<uint8_t>&, uint32_t)> on_message;

 protected:
  bool onReadable() override;

 private:
  bool onDatagram(const uint8_t* bytes, size_t size);
  /** Add the payload of the message's next datagram. */
  void append(const uint8_t* bytes, size_t size);

  const uint32_t id_;
  bool is_open_ = false;  // a message has begun
  uint8_t message_ = 0;
  uint32_t blocks_ = 0, next_block_ = 0, size_ = 0;
  size_t filled_ = 0, capacity_ = 0;
  boost::shared_array<uint8_t> body_;
};

}  // namespace net
}  // namespace ros
