#include "connection_header.h"

#include <algorithm>

namespace ros {
namespace net {
namespace {

void append(std::vector<uint8_t>& bytes, uint32_t number) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<uint8_t>(number >> 8 * i));
}

uint32_t number(const uint8_t* bytes) {
  return bytes[0] | static_cast<uint32_t>(bytes[1]) << 8 | static_cast<uint32_t>(bytes[2]) << 16 |
         static_cast<uint32_t>(bytes[3]) << 24;
}

}  // namespace

std::vector<uint8_t> encodeHeader(const M_string& fields) {
  std::vector<uint8_t> bytes;
  append(bytes, 0);
  for (const auto& entry : fields) {
    const std::string text = entry.first + "=" + entry.second;
    append(bytes, static_cast<uint32_t>(text.size()));
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  const uint32_t size = static_cast<uint32_t>(bytes.size() - 4);
  for (int i = 0; i < 4; ++i) bytes[static_cast<size_t>(i)] = static_cast<uint8_t>(size >> 8 * i);
  return bytes;
}

XmlRpc::XmlRpcValue headerValue(const M_string& fields) {
  std::vector<uint8_t> bytes = encodeHeader(fields);
  return XmlRpc::XmlRpcValue(bytes.data() + 4, static_cast<int>(bytes.size() - 4));
}

M_string decodeHeader(const uint8_t* bytes, size_t size) {
  M_string fields;
  for (size_t at = 0; at < size;) {
    if (size - at < 4) throw NetError("a connection header ends in the middle of a length");
    const uint32_t length = number(bytes + at);
    at += 4;
    if (length > size - at) throw NetError("a field of a connection header is longer than the header");
    const std::string text(reinterpret_cast<const char*>(bytes + at), length);
    const size_t equals = text.find('=');
    if (equals == std::string::npos) throw NetError("a field of a connection header has no '='");
    fields[text.substr(0, equals)] = text.substr(equals + 1);
    at += length;
  }
  return fields;
}

M_string exchangeHeaders(Socket& socket, const M_string& fields) {
  const std::vector<uint8_t> own = encodeHeader(fields);
  socket.write(own.data(), own.size());
  uint8_t length[4];
  socket.read(length, sizeof(length));
  const uint32_t size = number(length);
  if (size > kMaxHeader) throw NetError("the peer's connection header is longer than 10 MB");
  std::vector<uint8_t> bytes;
  for (size_t at = 0; at < size; at = bytes.size()) {  // memory grows with what arrives, not with `size`
    bytes.resize(at + std::min<size_t>(size - at, 65536));
    socket.read(bytes.data() + at, bytes.size() - at);
  }
  M_string answer = decodeHeader(bytes.data(), bytes.size());
  if (answer.count("error")) throw NetError(answer["error"]);
  return answer;
}

const std::string& field(const M_string& fields, const std::string& name) {
  static const std::string empty;
  const auto found = fields.find(name);
  return found == fields.end() ? empty : found->second;
}

}  // namespace net
}  // namespace ros
