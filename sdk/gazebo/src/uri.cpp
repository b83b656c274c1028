#include <algorithm>
#include <sstream>
#include <vector>

#include <gazebo/common/URI.hh>

namespace gazebo {
namespace common {

namespace {

const char kAfterScheme[] = "://";

// What is between delimiters, where there is something.
std::vector<std::string> split(const std::string& text, char delimiter) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, delimiter);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

}  // namespace

std::string URIPath::Str(const std::string& delimiter) const {
  std::string text;
  for (const std::string& part : parts_) text += (text.empty() ? "" : delimiter) + part;
  return text;
}

bool URIPath::Valid(const std::string& text) {
  return !split(text, '/').empty() && text.find_first_of(" ?=&") == std::string::npos;
}

bool URIPath::Parse(const std::string& text) {
  if (!Valid(text)) return false;
  const std::vector<std::string> parts = split(text, '/');
  parts_.assign(parts.begin(), parts.end());
  return true;
}

std::string URIQuery::Str(const std::string& delimiter) const {
  std::string text;
  for (const auto& pair : values_) text += (text.empty() ? "?" : delimiter) + pair.first + "=" + pair.second;
  return text;
}

bool URIQuery::Valid(const std::string& text) { return URIQuery().Parse(text); }

bool URIQuery::Parse(const std::string& text) {
  if (!text.empty() && (text[0] != '?' || text.find_first_of(" ?", 1) != std::string::npos)) return false;
  std::map<std::string, std::string> values;
  for (const std::string& pair : split(text.empty() ? text : text.substr(1), '&')) {
    const std::vector<std::string> words = split(pair, '=');
    if (words.size() != 2) return false;
    values.emplace(words[0], words[1]);
  }
  values_.swap(values);
  return true;
}

std::string URI::Str() const { return (scheme_.empty() ? "" : scheme_ + kAfterScheme) + path_.Str() + query_.Str(); }

bool URI::Parse(const std::string& text) {
  const std::size_t colon = text.find(kAfterScheme);
  if (colon == std::string::npos || colon == 0) return false;
  const std::size_t path = colon + sizeof(kAfterScheme) - 1;
  const std::size_t query = std::min(text.find('?', path), text.size());
  URI parsed;
  parsed.scheme_ = text.substr(0, colon);
  if (!parsed.path_.Parse(text.substr(path, query - path)) || !parsed.query_.Parse(text.substr(query))) return false;
  *this = parsed;
  return true;
}

}  // namespace common
}  // namespace gazebo
