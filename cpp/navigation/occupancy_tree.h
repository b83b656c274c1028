// Log-odds of cubes in space, octomap's streams of them, and their projection onto the ground.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace trundle::navigation {

constexpr int kTreeDepth = 16;               // levels below the first cube, which spans 2^16 cubes
constexpr std::size_t kMaxBlocks = 100'000;  // of 512 cubes: about 220 MB
constexpr std::size_t kMaxMapCells = 100'000'000;

struct TreeOptions {
  double resolution = 0.05;         // length of a cube [m]
  float hit = 0.85F, miss = -0.4F;  // log-odds of a ray that ends in a cube, and of one that passes
  float lower = -2.0F, upper = 3.5F;
};

using Point = std::array<double, 3>;
using TreeKey = std::array<int, 3>;  // of a cube: 0 … 2^16 − 1; the origin is the lower corner of 2^15

// A cube of the tree: indices at its depth.
struct TreeLeaf {
  int x, y, z, depth;
};

// Cells of a map: −1 unknown, 0 free, 100 occupied; row by row.
struct Projection {
  int x = 0, y = 0;  // keys of the first cell
  int width = 0, height = 0;
  std::vector<std::int8_t> cells;
};

enum class CubeKind : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2, kMixed = 3 };

// Blocks of 8 × 8 × 8 cubes by their place; a cube that no ray reached is unknown.
class OccupancyTree {
 public:
  explicit OccupancyTree(const TreeOptions& options) : options_(options) {}
  OccupancyTree(const OccupancyTree&) = delete;
  OccupancyTree& operator=(const OccupancyTree&) = delete;

  // Adds rays from `origin`; those to `hits` end in occupied cubes, those to `floor` in free ones. Rays are cut at
  // `max_range` [m], where they free their last cube; not positive: they are not cut. False: new blocks were left out,
  // as there are kMaxBlocks.
  bool insert(const Point& origin, std::span<const Point> hits, std::span<const Point> floor, double max_range);

  // Makes the known cubes of a box free; corners are in it.
  void clear_box(const Point& low, const Point& high);
  void reset() { blocks_.clear(); }

  // octomap's streams, pruned: two bits for each child, or a float and a byte of children for each node.
  std::vector<std::uint8_t> binary() const;
  std::vector<std::uint8_t> full() const;
  // Replaces everything by a stream; false: it ends early, is too deep, or has more than kMaxBlocks.
  bool read_binary(std::span<const std::uint8_t> data);
  bool read_full(std::span<const std::uint8_t> data, std::size_t node_size);

  std::vector<TreeLeaf> leaves(CubeKind kind) const;

  // Projects the cubes between two heights, which touch those of the cubes: occupied if one is, else free if one is.
  // Throws std::length_error for more than kMaxMapCells.
  Projection project(double low, double high) const;

  bool is_empty() const { return blocks_.empty(); }
  float odds(const Point& point) const;  // NaN: unknown
  const TreeOptions& options() const { return options_; }

 private:
  struct Block {
    std::array<float, 512> odds{};
    std::bitset<512> known, passed, hit;  // the last two during an insertion
  };
  class Cursor;
  class Writer;

  bool key_of(const Point& point, TreeKey& key) const;
  void pass(Cursor& cursor, const Point& from, const Point& to) const;
  Block* block_at(std::uint64_t code, bool create);
  bool fill(const TreeLeaf& leaf, float odds);
  std::vector<std::uint64_t> sorted_codes() const;
  CubeKind kind(const Block& block, std::size_t index) const;

  TreeOptions options_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Block>> blocks_;
};

}  // namespace trundle::navigation
