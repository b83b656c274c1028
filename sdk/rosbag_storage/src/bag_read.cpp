#include <algorithm>

#include "bag_impl.h"
#include "compression.h"

namespace rosbag {
namespace {

const std::string kVersion = "#ROSBAG V2.0\n";
constexpr uint32_t kMaxChunk = 1u << 30;
constexpr size_t kEntrySize = 12, kCountSize = 8;

}  // namespace

Bag::Impl::~Impl() {
  if (file) std::fclose(file);
}

void Bag::Impl::seek(uint64_t pos) {
  if (fseeko(file, static_cast<off_t>(pos), SEEK_SET) != 0) throw BagIOException("cannot read " + path);
}

std::string Bag::Impl::read(uint64_t count) {
  if (count > size) throw BagFormatException(path + ": a record is longer than the file");
  std::string bytes(count, '\0');
  if (std::fread(&bytes[0], 1, count, file) != count)
    throw BagFormatException(path + ": the file ends within a record");
  return bytes;
}

Bag::Impl::Record Bag::Impl::readRecord() {
  const std::string header = read(unpacked<uint32_t>(read(4).data()));
  Record record{Fields(header.data(), header.size()), 0, unpacked<uint32_t>(read(4).data())};
  record.data_pos = static_cast<uint64_t>(ftello(file));
  return record;
}

void Bag::Impl::readIndex() {
  seek(0);
  const std::string version = size < kVersion.size() ? "" : read(kVersion.size());
  if (version != kVersion) {
    const bool is_bag = version.compare(0, 8, "#ROSBAG ") == 0;
    throw BagFormatException(
        path + (is_bag ? ": only bags of version 2.0 are read; rosbag fix converts others" : ": not a bag"));
  }
  const Record header = readRecord();
  if (header.fields.number<uint8_t>("op") != kFileHeader) throw BagFormatException(path + ": the header is missing");
  if (!header.fields.word("encryptor").empty()) throw BagFormatException(path + ": encrypted bags are not read");
  index_pos = header.fields.number<uint64_t>("index_pos");
  if (index_pos == 0) throw BagUnindexedException();
  uint32_t left = header.fields.number<uint32_t>("conn_count");
  uint64_t next = index_pos;
  for (; left > 0; --left) {
    seek(next);
    const Record record = readRecord();
    readConnection(record);
    next = record.data_pos + record.data_size;
  }
  for (left = header.fields.number<uint32_t>("chunk_count"); left > 0; --left) {
    seek(next);
    const Record record = readRecord();
    chunks.push_back(readChunkInfo(record));
    next = record.data_pos + record.data_size;
  }
  for (const ChunkInfo& one : chunks) readEntries(one);
}

void Bag::Impl::readConnection(const Record& record) {
  if (record.fields.number<uint8_t>("op") != kConnection)
    throw BagFormatException(path + ": no connection in the index");
  const std::string data = read(record.data_size);
  const Fields header(data.data(), data.size());
  ConnectionInfo info;
  info.id = record.fields.number<uint32_t>("conn");
  info.topic = record.fields.word("topic");
  info.datatype = header.word("type");
  info.md5sum = header.word("md5sum");
  info.msg_def = header.word("message_definition");
  info.header.reset(new ros::M_string(header.all()));
  ros::M_string key = header.all();
  key["topic"] = info.topic;
  ids[key] = info.id;
  connections[info.id] = info;
}

ChunkInfo Bag::Impl::readChunkInfo(const Record& record) {
  if (record.fields.number<uint8_t>("op") != kChunkInfo || record.fields.number<uint32_t>("ver") != 1)
    throw BagFormatException(path + ": the index of chunks is damaged");
  ChunkInfo info;
  info.pos = record.fields.number<uint64_t>("chunk_pos");
  info.start = record.fields.time("start_time");
  info.end = record.fields.time("end_time");
  const std::string data = read(record.data_size);
  for (size_t at = 0; at + kCountSize <= data.size(); at += kCountSize)
    info.counts[unpacked<uint32_t>(&data[at])] = unpacked<uint32_t>(&data[at + 4]);
  return info;
}

void Bag::Impl::readEntries(const ChunkInfo& of) {
  seek(of.pos);
  const Record header = readRecord();
  if (header.fields.number<uint8_t>("op") != kChunk) throw BagFormatException(path + ": no chunk where the index says");
  uint64_t next = header.data_pos + header.data_size;
  for (size_t left = of.counts.size(); left > 0; --left) {
    seek(next);
    const Record record = readRecord();
    const uint32_t connection = record.fields.number<uint32_t>("conn");
    if (record.fields.number<uint8_t>("op") != kIndex || record.fields.number<uint32_t>("ver") != 1 ||
        connections.count(connection) == 0)
      throw BagFormatException(path + ": the index of a chunk is damaged");
    const std::string data = read(record.data_size);
    for (size_t at = 0; at + kEntrySize <= data.size(); at += kEntrySize)
      addEntry(connection, {Fields::timeOf(unpacked<uint32_t>(&data[at]), unpacked<uint32_t>(&data[at + 4])), of.pos,
                            unpacked<uint32_t>(&data[at + 8])});
    next = record.data_pos + record.data_size;
  }
}

void Bag::Impl::addEntry(uint32_t connection, const IndexEntry& entry) {
  std::vector<IndexEntry>& entries = index[connection];
  if (!entries.empty() && entry < entries.back()) unsorted.insert(connection);
  entries.push_back(entry);
}

const std::map<uint32_t, std::vector<IndexEntry> >& Bag::Impl::sortedIndex() {
  for (const uint32_t connection : unsorted) std::stable_sort(index[connection].begin(), index[connection].end());
  unsorted.clear();
  return index;
}

void Bag::Impl::loadChunk(uint64_t pos) {
  if (pos == chunk_pos) return;
  seek(pos);
  const Record record = readRecord();
  const uint32_t length = record.fields.number<uint32_t>("size");
  if (record.fields.number<uint8_t>("op") != kChunk || length > kMaxChunk)
    throw BagFormatException(path + ": a chunk is damaged");
  const std::string bytes = read(record.data_size);
  chunk_pos = 0;
  chunk = uncompressed(record.fields.word("compression"), bytes, length);
  chunk_pos = pos;
}

const uint8_t* Bag::Impl::readMessage(const ConnectionInfo& connection, const IndexEntry& entry, uint32_t& length) {
  if (!file) throw BagIOException(path + ": the bag is closed");
  const bool is_open = !open_chunk.empty() && entry.chunk_pos == open_info.pos;
  if (!is_open) loadChunk(entry.chunk_pos);
  const std::string& bytes = is_open ? open_chunk : chunk;
  for (size_t at = entry.offset;;) {  // connections may come before the message
    const auto take = [&]() {
      if (at > bytes.size() || bytes.size() - at < 4) throw BagFormatException(path + ": a chunk ends within a record");
      const uint32_t count = unpacked<uint32_t>(&bytes[at]);
      at += 4;
      if (count > bytes.size() - at) throw BagFormatException(path + ": a record is longer than its chunk");
      const char* const start = bytes.data() + at;
      at += count;
      return std::make_pair(start, count);
    };
    const auto header = take(), data = take();
    const Fields fields(header.first, header.second);
    const uint8_t operation = fields.number<uint8_t>("op");
    if (operation == kConnection) continue;
    if (operation != kMessage || fields.number<uint32_t>("conn") != connection.id)
      throw BagFormatException(path + ": no message where the index says");
    length = data.second;
    return reinterpret_cast<const uint8_t*>(data.first);
  }
}

}  // namespace rosbag
