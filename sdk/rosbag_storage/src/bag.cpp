#include "rosbag/bag.h"

#include <ros/console.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "bag_impl.h"
#include "compression.h"

namespace rosbag {
namespace {

const char kVersion[] = "#ROSBAG V2.0\n";
constexpr uint64_t kVersionSize = sizeof kVersion - 1;
constexpr uint32_t kHeaderSize = 4096;  // fixed, so that it can be written again

}  // namespace

Bag::Bag() : impl_(new Impl) {}
Bag::Bag(const std::string& filename, uint32_t mode) : impl_(new Impl) { open(filename, mode); }
Bag::Bag(Bag&& other) : impl_(new Impl) { swap(other); }
Bag& Bag::operator=(Bag&& other) {
  swap(other);
  return *this;
}
Bag::~Bag() {
  try {
    close();
  } catch (const BagException& error) {
    ROS_ERROR("%s", error.what());
  }
}

void Bag::open(const std::string& filename, uint32_t mode) {
  close();
  impl_.reset(new Impl);
  impl_->path = filename;
  const bool is_append = mode & bagmode::Append, is_write = !is_append && (mode & bagmode::Write);
  impl_->mode = is_append ? bagmode::Append : is_write ? bagmode::Write : bagmode::Read;
  if (!is_append && !is_write && !(mode & bagmode::Read))
    throw BagException("no mode of a bag: " + std::to_string(mode));
  impl_->file = std::fopen(filename.c_str(), is_write ? "w+b" : is_append ? "r+b" : "rb");
  const bool is_new = is_write || (is_append && !impl_->file && errno == ENOENT);
  if (is_new && !impl_->file) impl_->file = std::fopen(filename.c_str(), "w+b");
  if (!impl_->file) throw BagIOException("cannot open " + filename + ": " + std::strerror(errno));
  if (is_new) {
    impl_->writeHeader(0);
    return;
  }
  std::unique_ptr<Impl> opened(new Impl);  // closed again, should the bag be damaged
  opened.swap(impl_);
  if (fseeko(opened->file, 0, SEEK_END) != 0) throw BagIOException("cannot read " + filename);
  opened->size = static_cast<uint64_t>(ftello(opened->file));
  opened->readIndex();
  if (is_append) opened->writeHeader(0);
  impl_ = std::move(opened);
}

void Bag::close() {
  if (!impl_->file) return;
  const std::unique_ptr<Impl> closed(std::move(impl_));
  impl_.reset(new Impl);
  impl_->path = closed->path;
  if (closed->mode == bagmode::Read) return;
  closed->writeChunk();
  closed->writeIndex();
  FILE* const file = std::exchange(closed->file, nullptr);
  if (std::fclose(file) != 0) throw BagIOException("cannot write " + closed->path + ": " + std::strerror(errno));
}

bool Bag::isOpen() const { return impl_->file != nullptr; }
std::string Bag::getFileName() const { return impl_->path; }
BagMode Bag::getMode() const { return impl_->mode; }
uint64_t Bag::getSize() const { return impl_->size; }
void Bag::setCompression(CompressionType compression) {
  if (compression != impl_->compression) impl_->writeChunk();
  impl_->compression = compression;
}
CompressionType Bag::getCompression() const { return impl_->compression; }
void Bag::setChunkThreshold(uint32_t chunk_threshold) { impl_->threshold = chunk_threshold; }
uint32_t Bag::getChunkThreshold() const { return impl_->threshold; }
void Bag::swap(Bag& other) { impl_.swap(other.impl_); }

uint8_t* Bag::reserve(const Connection& connection, const ros::Time& time, uint32_t size) {
  if (!impl_->file) throw BagIOException("the bag is not open");
  if (impl_->mode == bagmode::Read) throw BagException(impl_->path + ": the bag was opened to be read");
  if (time < ros::TIME_MIN)
    throw BagException("a message's time is before " + std::to_string(ros::TIME_MIN.toSec()) + " s");
  if (impl_->open_chunk.empty()) impl_->open_info.pos = impl_->index_pos;
  const uint32_t id = impl_->connect(connection);
  const IndexEntry entry{time, impl_->open_info.pos, static_cast<uint32_t>(impl_->open_chunk.size())};
  impl_->addEntry(id, entry);
  impl_->open_index[id].push_back(entry);
  impl_->open_info.start = std::min(impl_->open_info.start, time);
  impl_->open_info.end = std::max(impl_->open_info.end, time);
  ++impl_->open_info.counts[id];
  ++impl_->revision;
  const std::string header =
      Fields().set("op", packed(kMessage)).set("conn", packed(id)).set("time", packed(time)).text();
  std::string& chunk = impl_->open_chunk;
  chunk += packed(static_cast<uint32_t>(header.size())) + header + packed(size);
  chunk.resize(chunk.size() + size);
  return reinterpret_cast<uint8_t*>(&chunk[0] + (chunk.size() - size));
}

void Bag::finish() {
  if (impl_->open_chunk.size() > impl_->threshold) impl_->writeChunk();
}

uint32_t Bag::Impl::connect(const Bag::Connection& connection) {
  ros::M_string header = connection.header ? *connection.header : ros::M_string();
  header["topic"] = connection.topic;
  header["type"] = connection.datatype;
  header["md5sum"] = connection.md5sum;
  header["message_definition"] = connection.definition;
  const auto found = ids.find(header);
  if (found != ids.end()) return found->second;
  const uint32_t id = connections.empty() ? 0 : connections.rbegin()->first + 1;
  ids[header] = id;
  ConnectionInfo& info = connections[id];
  info.id = id;
  info.topic = connection.topic;
  info.datatype = connection.datatype;
  info.md5sum = connection.md5sum;
  info.msg_def = connection.definition;
  info.header.reset(new ros::M_string(header));
  Fields data;
  for (const auto& [name, value] : header) data.set(name, value);
  open_chunk +=
      record(Fields().set("op", packed(kConnection)).set("conn", packed(id)).set("topic", info.topic), data.text());
  return id;
}

void Bag::Impl::append(const std::string& bytes) {
  seek(index_pos);
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size())
    throw BagIOException("cannot write " + path + ": " + std::strerror(errno));
  index_pos += bytes.size();
  size = std::max(size, index_pos);
}

void Bag::Impl::writeHeader(uint64_t index) {
  Fields fields;
  fields.set("op", packed(kFileHeader)).set("index_pos", packed(index));
  fields.set("conn_count", packed(static_cast<uint32_t>(index == 0 ? 0 : connections.size())));
  fields.set("chunk_count", packed(static_cast<uint32_t>(index == 0 ? 0 : chunks.size())));
  const std::string bytes = record(fields, std::string(kHeaderSize - fields.text().size(), ' '));
  const uint64_t after = std::max<uint64_t>(index_pos, kVersionSize + bytes.size());
  index_pos = 0;
  append(kVersion + bytes);
  index_pos = after;
}

void Bag::Impl::writeChunk() {
  if (open_chunk.empty()) return;
  const std::string data = compressed(compression, open_chunk);
  std::string bytes = record(Fields()
                                 .set("op", packed(kChunk))
                                 .set("compression", nameOf(compression))
                                 .set("size", packed(static_cast<uint32_t>(open_chunk.size()))),
                             data);
  for (const auto& [id, entries] : open_index) {
    std::string rows;
    for (const IndexEntry& entry : entries) rows += packed(entry.time) + packed(entry.offset);
    Fields fields;
    fields.set("op", packed(kIndex)).set("ver", packed(1u)).set("conn", packed(id));
    bytes += record(fields.set("count", packed(static_cast<uint32_t>(entries.size()))), rows);
  }
  append(bytes);
  chunks.push_back(open_info);
  open_chunk.clear();
  open_index.clear();
  open_info = ChunkInfo();
}

void Bag::Impl::writeIndex() {
  const uint64_t start = index_pos;
  std::string bytes;
  for (const auto& [id, info] : connections) {
    Fields data;
    for (const auto& [name, value] : *info.header) data.set(name, value);
    bytes +=
        record(Fields().set("op", packed(kConnection)).set("conn", packed(id)).set("topic", info.topic), data.text());
  }
  for (const ChunkInfo& chunk : chunks) {
    std::string counts;
    for (const auto& [id, count] : chunk.counts) counts += packed(id) + packed(count);
    Fields fields;
    fields.set("op", packed(kChunkInfo)).set("ver", packed(1u)).set("chunk_pos", packed(chunk.pos));
    fields.set("start_time", packed(chunk.start)).set("end_time", packed(chunk.end));
    bytes += record(fields.set("count", packed(static_cast<uint32_t>(chunk.counts.size()))), counts);
  }
  append(bytes);
  writeHeader(start);
}

}  // namespace rosbag
