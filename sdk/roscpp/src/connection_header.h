#pragma once

#include <string>
#include <vector>

#include "ros/datatypes.h"
#include "socket.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
namespace net {

constexpr uint32_t kMaxHeader = 10000000;  // [bytes]; a header holds a definition of a message
constexpr uint32_t kMaxMessage = 1000000000;

/** Bytes of the fields, after their total length: the first bytes on a connection. */
std::vector<uint8_t> encodeHeader(const M_string& fields);
/** Bytes of the fields alone, as binary data of XML-RPC. */
XmlRpc::XmlRpcValue headerValue(const M_string& fields);
/** Fields of a header without its total length; throws NetError. */
M_string decodeHeader(const uint8_t* bytes, size_t size);
/** Send a header, and read the peer's; throws NetError, with the peer's text if it refuses. */
M_string exchangeHeaders(Socket& socket, const M_string& fields);
/** Value of a field; "" if there is none. */
const std::string& field(const M_string& fields, const std::string& name);

}  // namespace net
}  // namespace ros
