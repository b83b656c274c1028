#include "xml_rpc.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "ros/datatypes.h"

namespace ros {
namespace net {
namespace {

using XmlRpc::XmlRpcValue;

constexpr size_t kMaxHead = 65536, kMaxBody = 100000000;

/** Head of a request or an answer: its first line, and its fields in lower case. */
struct Head {
  std::string first;
  M_string fields;

  explicit Head(const std::string& text) {
    size_t end = text.find("\r\n");
    first = text.substr(0, end);
    while (end != std::string::npos && end + 2 < text.size()) {
      const size_t start = end + 2;
      end = text.find("\r\n", start);
      const std::string line = text.substr(start, end == std::string::npos ? end : end - start);
      const size_t colon = line.find(':');
      if (colon == std::string::npos) continue;
      std::string name = line.substr(0, colon);
      std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
      const size_t value = line.find_first_not_of(' ', colon + 1);
      fields[name] = value == std::string::npos ? "" : line.substr(value);
    }
  }
  bool has(const std::string& name) const { return fields.count(name) > 0; }
  /** Length of the body; false if it is missing or too large. */
  bool length(size_t& size) const {
    const auto found = fields.find("content-length");
    if (found == fields.end() || found->second.empty() || found->second.size() > 9) return false;
    if (!std::all_of(found->second.begin(), found->second.end(), [](unsigned char c) { return std::isdigit(c); }))
      return false;
    size = std::strtoul(found->second.c_str(), nullptr, 10);
    return size <= kMaxBody;
  }
};

std::string tagged(const std::string& xml, const std::string& tag, size_t from, size_t& end) {
  const size_t start = xml.find("<" + tag + ">", from);
  const size_t stop = start == std::string::npos ? start : xml.find("</" + tag + ">", start);
  if (stop == std::string::npos) return "";
  end = stop + tag.size() + 3;
  return xml.substr(start + tag.size() + 2, stop - start - tag.size() - 2);
}

/** Parameters of a call, or the only parameter of an answer. */
XmlRpcValue readParameters(const std::string& xml, size_t from) {
  XmlRpcValue values;
  values.setSize(0);
  size_t at = from;
  while ((at = xml.find("<param>", at)) != std::string::npos) {
    int offset = static_cast<int>(at) + 7;
    XmlRpcValue value;
    if (!value.fromXml(xml, &offset)) throw NetError("invalid XML-RPC");
    values[values.size()] = value;
    at = static_cast<size_t>(offset);
  }
  return values;
}

std::string writeParameters(const XmlRpcValue& values) {
  std::string xml = "<params>";
  for (int i = 0; i < values.size(); ++i) xml += "<param>" + values[i].toXml() + "</param>";
  return xml + "</params>";
}

class HttpConnection : public Connection {
 public:
  HttpConnection(Socket socket, const XmlRpcLookup& find) : Connection(std::move(socket)), find_(find) {}

 protected:
  bool onReadable() override {
    char block[16384];
    const ptrdiff_t count = receive(block, sizeof(block));
    if (count <= 0) return count == 0;
    text_.append(block, static_cast<size_t>(count));
    while (true) {
      const size_t end = text_.find("\r\n\r\n");
      if (end == std::string::npos) return text_.size() <= kMaxHead;
      const Head head(text_.substr(0, end));
      size_t length = 0;
      if (!head.length(length)) return answer(head, "411 Length Required", "");
      // True if a browser sent the request, which these fields show: any web page that a user visits can reach this
      // port.
      if (head.has("origin") || head.has("sec-fetch-site") || head.has("sec-fetch-mode"))
        return answer(head, "403 Forbidden", "");
      if (text_.size() < end + 4 + length) return true;
      const std::string body = text_.substr(end + 4, length);
      text_.erase(0, end + 4 + length);
      if (!answer(head, "200 OK", handle(body))) return false;
    }
  }

 private:
  std::string handle(const std::string& body) const {
    size_t end = 0;
    const std::string name = tagged(body, "methodName", 0, end);
    const XmlRpcMethod method = find_(name);
    XmlRpcValue fault;
    try {
      if (!method) throw NetError("no method " + name.substr(0, 100));
      XmlRpcValue result;
      result[0] = method(readParameters(body, end));
      return "<?xml version=\"1.0\"?>\r\n<methodResponse>" + writeParameters(result) + "</methodResponse>\r\n";
    } catch (const XmlRpc::XmlRpcException& error) {
      fault["faultString"] = error.getMessage();
    } catch (const std::exception& error) {
      fault["faultString"] = std::string(error.what());
    }
    fault["faultCode"] = -1;
    return "<?xml version=\"1.0\"?>\r\n<methodResponse><fault>" + fault.toXml() + "</fault></methodResponse>\r\n";
  }

  /** Send an answer; false if the connection ends with it. */
  bool answer(const Head& head, const std::string& status, const std::string& body) {
    const std::string text = "HTTP/1.1 " + status + "\r\nServer: roscpp\r\nContent-Type: text/xml\r\nContent-Length: " +
                             std::to_string(body.size()) + "\r\n\r\n" + body;
    send(std::vector<uint8_t>(text.begin(), text.end()));
    const auto wish = head.fields.find("connection");
    const bool ends =
        wish != head.fields.end() ? wish->second == "close" : head.first.find("HTTP/1.0") != std::string::npos;
    if (ends || body.empty()) close(true);
    return !body.empty();
  }

  const XmlRpcLookup find_;
  std::string text_;
};

}  // namespace

XmlRpcValue callXmlRpc(const std::string& host, uint16_t port, const std::string& method,
                       const XmlRpcValue& parameters) {
  const std::string body = "<?xml version=\"1.0\"?>\r\n<methodCall><methodName>" + method + "</methodName>" +
                           writeParameters(parameters) + "</methodCall>\r\n";
  const std::string request =
      "POST / HTTP/1.1\r\nUser-Agent: roscpp\r\nHost: " + host + ":" + std::to_string(port) +
      "\r\nConnection: close\r\nContent-Type: text/xml\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
      body;
  Socket socket = Socket::connect(host, port);
  socket.write(request.data(), request.size());
  std::string text;
  char block[16384];
  size_t end = std::string::npos, length = kMaxBody;
  while (end == std::string::npos || text.size() < end + 4 + length) {
    const size_t count = socket.readSome(block, sizeof(block));
    if (count == 0) break;
    text.append(block, count);
    if (end != std::string::npos) continue;
    end = text.find("\r\n\r\n");
    if (end == std::string::npos && text.size() > kMaxHead) throw NetError("the server's answer is no HTTP");
    if (end != std::string::npos && !Head(text.substr(0, end)).length(length)) length = kMaxBody;  // up to the end
    if (text.size() > kMaxHead + kMaxBody) throw NetError("the server's answer is too long");
  }
  if (end == std::string::npos) throw NetError("the server closed the connection");
  if (Head(text).first.find(" 200") == std::string::npos) throw NetError("the server answers " + Head(text).first);
  const size_t fault = text.find("<fault>", end);
  if (fault != std::string::npos) {
    int offset = static_cast<int>(fault) + 7;
    const XmlRpcValue value(text, &offset);
    throw NetError(value.hasMember("faultString") && value["faultString"].getType() == XmlRpcValue::TypeString
                       ? static_cast<const std::string&>(value["faultString"])
                       : "the server reports a fault");
  }
  const XmlRpcValue values = readParameters(text, end);
  if (values.size() == 0) throw NetError("the server's answer has no value");
  return values[0];
}

std::shared_ptr<Connection> serveXmlRpc(Socket socket, const XmlRpcLookup& find) {
  return std::make_shared<HttpConnection>(std::move(socket), find);
}

}  // namespace net
}  // namespace ros
