#pragma once

#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "records.h"
#include "rosbag/bag.h"

namespace rosbag {

/** Chunk of a bag: the times of its messages, and their number by connection. */
struct ChunkInfo {
  uint64_t pos = 0;
  ros::Time start = ros::TIME_MAX, end = ros::TIME_MIN;
  std::map<uint32_t, uint32_t> counts;
};

struct Bag::Impl {
  ~Impl();
  /** Read the index; throws. */
  void readIndex();
  /** Bytes of a message, until the next call. */
  const uint8_t* readMessage(const ConnectionInfo& connection, const IndexEntry& entry, uint32_t& size);
  uint32_t connect(const Bag::Connection& connection);
  void addEntry(uint32_t connection, const IndexEntry& entry);
  /** Messages of each connection in the order of their times. */
  const std::map<uint32_t, std::vector<IndexEntry> >& sortedIndex();
  void writeHeader(uint64_t index_pos);
  void writeChunk();
  void writeIndex();

  std::string path;
  BagMode mode = bagmode::Write;
  CompressionType compression = compression::Uncompressed;
  uint32_t threshold = 768 * 1024;
  FILE* file = nullptr;
  uint64_t size = 0;
  std::map<uint32_t, ConnectionInfo> connections;
  std::map<ros::M_string, uint32_t> ids;
  std::vector<ChunkInfo> chunks;
  uint64_t index_pos = 0;
  /** Number that changes with each message written. */
  uint64_t revision = 0;
  /** Chunk that is being written. */
  std::string open_chunk;
  ChunkInfo open_info;
  std::map<uint32_t, std::vector<IndexEntry> > open_index;
  /** Chunk that was read last. */
  std::string chunk;
  uint64_t chunk_pos = 0;

 private:
  struct Record {
    Fields fields;
    uint64_t data_pos;
    uint32_t data_size;
  };
  void seek(uint64_t pos);
  void append(const std::string& bytes);
  std::string read(uint64_t count);
  /** Read a record's header at the file's position; its data follow. */
  Record readRecord();
  void readConnection(const Record& record);
  ChunkInfo readChunkInfo(const Record& record);
  void readEntries(const ChunkInfo& chunk);
  void loadChunk(uint64_t pos);
  std::map<uint32_t, std::vector<IndexEntry> > index;
  /** Connections whose messages came in another order than that of their times. */
  std::set<uint32_t> unsorted;
};

}  // namespace rosbag
