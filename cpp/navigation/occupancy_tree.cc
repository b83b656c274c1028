#include "occupancy_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace trundle::navigation {

namespace {

constexpr int kCenter = 1 << (kTreeDepth - 1);
constexpr int kBlockLevels = 3;
constexpr std::size_t kNodeSize = 5;  // of a full stream, without colors
constexpr int kBlockDepth = kTreeDepth - kBlockLevels;

// Bits of x, y and z in turn, x lowest: the order in which octomap's streams have the children.
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < kTreeDepth; ++bit)
    code |= std::uint64_t{(x >> bit & 1U) | (y >> bit & 1U) << 1 | (z >> bit & 1U) << 2} << 3 * bit;
  return code;
}

int gathered(std::uint64_t code, int axis) {
  int value = 0;
  for (int bit = 0; bit < kTreeDepth; ++bit) value |= static_cast<int>(code >> (3 * bit + axis) & 1U) << bit;
  return value;
}

TreeLeaf leaf_of(std::uint64_t code, int depth) {
  return {gathered(code, 0), gathered(code, 1), gathered(code, 2), depth};
}

std::size_t place_in_block(const TreeKey& key) {
  std::size_t place = 0;
  for (int bit = 0; bit < kBlockLevels; ++bit)
    for (int axis = 0; axis < 3; ++axis)
      place |= static_cast<std::size_t>(key[static_cast<std::size_t>(axis)] >> bit & 1) << (3 * bit + axis);
  return place;
}

std::uint64_t block_of(const TreeKey& key) {
  return interleaved(static_cast<std::uint32_t>(key[0] >> kBlockLevels),
                     static_cast<std::uint32_t>(key[1] >> kBlockLevels),
                     static_cast<std::uint32_t>(key[2] >> kBlockLevels));
}

}  // namespace

// Marks cubes; consecutive ones are mostly of one block.
class OccupancyTree::Cursor {
 public:
  explicit Cursor(OccupancyTree& tree) : tree_(tree) {}

  void mark(const TreeKey& key, bool is_hit) {
    const TreeKey place{key[0] >> kBlockLevels, key[1] >> kBlockLevels, key[2] >> kBlockLevels};
    if (!block_ || place != place_) {
      place_ = place;
      block_ = tree_.block_at(block_of(key), true);
      if (!block_) {
        is_whole = false;
        return;
      }
      if (block_->passed.none() && block_->hit.none()) touched.push_back(block_);
    }
    (is_hit ? block_->hit : block_->passed).set(place_in_block(key));
  }

  std::vector<Block*> touched;
  bool is_whole = true;

 private:
  OccupancyTree& tree_;
  TreeKey place_{};
  Block* block_ = nullptr;
};

bool OccupancyTree::key_of(const Point& point, TreeKey& key) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(point[axis] / options_.resolution) + kCenter;
    if (!(cell >= 0.0 && cell < 2 * kCenter)) return false;
    key[axis] = static_cast<int>(cell);
  }
  return true;
}

OccupancyTree::Block* OccupancyTree::block_at(std::uint64_t code, bool create) {
  const auto found = blocks_.find(code);
  if (found != blocks_.end()) return found->second.get();
  if (!create || blocks_.size() >= kMaxBlocks) return nullptr;
  return blocks_.emplace(code, std::make_unique<Block>()).first->second.get();
}

// Marks the cubes from one point as far as that of another, which is left out: Amanatides, Woo, "A Fast Voxel Traversal
// Algorithm for Ray Tracing" (1987).
void OccupancyTree::pass(Cursor& cursor, const Point& from, const Point& to) const {
  TreeKey key{}, last{};
  if (!key_of(from, key) || !key_of(to, last)) return;
  std::array<int, 3> step{};
  std::array<double, 3> next{}, stride{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double way = to[axis] - from[axis];
    step[axis] = last[axis] > key[axis] ? 1 : last[axis] < key[axis] ? -1 : 0;
    if (step[axis] == 0) {
      next[axis] = stride[axis] = std::numeric_limits<double>::infinity();
      continue;
    }
    const double edge = (key[axis] - kCenter + (step[axis] > 0 ? 1 : 0)) * options_.resolution;
    next[axis] = (edge - from[axis]) / way;
    stride[axis] = options_.resolution / std::abs(way);
  }
  while (key != last) {
    cursor.mark(key, false);
    const std::size_t axis = next[0] <= next[1] ? (next[0] <= next[2] ? 0U : 2U) : (next[1] <= next[2] ? 1U : 2U);
    if (step[axis] == 0) return;
    key[axis] += step[axis];
    if (key[axis] == last[axis]) {
      step[axis] = 0;
      next[axis] = std::numeric_limits<double>::infinity();
    } else {
      next[axis] += stride[axis];
    }
  }
}

bool OccupancyTree::insert(const Point& origin, std::span<const Point> hits, std::span<const Point> floor,
                           double max_range) {
  Cursor cursor(*this);
  const auto add = [&](const Point& end, bool is_hit) {
    const double length = std::hypot(end[0] - origin[0], end[1] - origin[1], end[2] - origin[2]);
    if (!std::isfinite(length)) return;
    const bool is_cut = max_range > 0.0 && length > max_range;
    Point to = end;
    if (is_cut)
      for (std::size_t axis = 0; axis < 3; ++axis)
        to[axis] = origin[axis] + (end[axis] - origin[axis]) * max_range / length;
    pass(cursor, origin, to);
    TreeKey key{};
    if (key_of(to, key)) cursor.mark(key, is_hit && !is_cut);
  };
  for (const Point& point : hits) add(point, true);
  for (const Point& point : floor) add(point, false);
  for (Block* block : cursor.touched) {
    for (std::size_t at = 0; at < 512; ++at) {
      if (!block->hit[at] && !block->passed[at]) continue;
      const float changed = block->odds[at] + (block->hit[at] ? options_.hit : options_.miss);
      block->odds[at] = std::clamp(changed, options_.lower, options_.upper);
      block->known.set(at);
    }
    block->hit.reset();
    block->passed.reset();
  }
  return cursor.is_whole;
}

void OccupancyTree::clear_box(const Point& low, const Point& high) {
  for (auto& [code, block] : blocks_) {
    for (std::size_t at = 0; at < 512; ++at) {
      if (!block->known[at]) continue;
      const TreeLeaf leaf = leaf_of(code << 3 * kBlockLevels | at, kTreeDepth);
      const std::array<int, 3> key{leaf.x, leaf.y, leaf.z};
      bool is_inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double middle = (key[axis] - kCenter + 0.5) * options_.resolution;
        is_inside = is_inside && middle + 0.5 * options_.resolution >= low[axis] &&
                    middle - 0.5 * options_.resolution <= high[axis];
      }
      if (is_inside) block->odds[at] = options_.lower;
    }
  }
}

CubeKind OccupancyTree::kind(const Block& block, std::size_t index) const {
  if (!block.known[index]) return CubeKind::kUnknown;
  return block.odds[index] > 0.0F ? CubeKind::kOccupied : CubeKind::kFree;
}

std::vector<std::uint64_t> OccupancyTree::sorted_codes() const {
  std::vector<std::uint64_t> codes;
  codes.reserve(blocks_.size());
  for (const auto& [code, block] : blocks_)
    if (block->known.any()) codes.push_back(code);
  std::sort(codes.begin(), codes.end());
  return codes;
}

// Goes through the tree above the blocks, and writes it depth first.
class OccupancyTree::Writer {
 public:
  explicit Writer(const OccupancyTree& tree) : tree_(tree), codes_(tree.sorted_codes()) {}

  // Returns the kind of a cube; of a mixed one, the stream of its children is written.
  CubeKind binary(std::uint64_t code, int depth, std::size_t first, std::size_t last) {
    if (first == last) return CubeKind::kUnknown;
    if (depth == kTreeDepth) return tree_.kind(*block_, code & 511U);
    if (depth == kBlockDepth) block_ = tree_.blocks_.at(codes_[first]).get();
    const std::size_t at = out.size(), known = leaves.size();
    out.resize(at + 2);
    std::uint32_t bits = 0;
    std::array<CubeKind, 8> kinds{};
    for (std::size_t child = 0; child < 8; ++child) {
      const std::size_t end = after(code << 3 | child, depth + 1, first, last);
      kinds[child] = binary(code << 3 | child, depth + 1, first, end);
      first = depth < kBlockDepth ? end : first;
      bits |= static_cast<std::uint32_t>(kinds[child]) << 2 * child;
    }
    const bool is_uniform = kinds[0] != CubeKind::kMixed &&
                            std::all_of(kinds.begin(), kinds.end(), [&](CubeKind k) { return k == kinds[0]; });
    if (is_uniform) {
      out.resize(at);
      leaves.resize(known);
      return kinds[0];
    }
    for (std::size_t child = 0; child < 8; ++child)
      if (kinds[child] == wanted) leaves.push_back(leaf_of(code << 3 | child, depth + 1));
    out[at] = static_cast<std::uint8_t>(bits & 255U);
    out[at + 1] = static_cast<std::uint8_t>(bits >> 8);
    return CubeKind::kMixed;
  }

  // Returns whether a cube is known and a leaf, and its odds or the greatest of its children.
  std::pair<CubeKind, float> full(std::uint64_t code, int depth, std::size_t first, std::size_t last) {
    constexpr float kNone = std::numeric_limits<float>::lowest();
    if (first == last) return {CubeKind::kUnknown, kNone};
    if (depth == kBlockDepth) block_ = tree_.blocks_.at(codes_[first]).get();
    const std::size_t at = out.size();
    if (depth == kTreeDepth) {
      if (!block_->known[code & 511U]) return {CubeKind::kUnknown, kNone};
      put(block_->odds[code & 511U], 0);
      return {CubeKind::kFree, block_->odds[code & 511U]};
    }
    put(0.0F, 0);
    std::uint32_t children = 0;
    float most = kNone;
    bool is_uniform = true;
    for (std::size_t child = 0; child < 8; ++child) {
      const std::size_t end = after(code << 3 | child, depth + 1, first, last);
      const auto [kind, odds] = full(code << 3 | child, depth + 1, first, end);
      first = depth < kBlockDepth ? end : first;
      if (kind != CubeKind::kUnknown) children |= 1U << child;
      is_uniform = is_uniform && kind == CubeKind::kFree && (child == 0 || odds == most);
      most = std::max(most, odds);
    }
    if (children == 0) {
      out.resize(at);
      return {CubeKind::kUnknown, kNone};
    }
    if (is_uniform) {
      out.resize(at);
      put(most, 0);
      return {CubeKind::kFree, most};
    }
    write(at, most, static_cast<std::uint8_t>(children));
    return {CubeKind::kMixed, most};
  }

  std::size_t size() const { return codes_.size(); }

  std::vector<std::uint8_t> out;
  std::vector<TreeLeaf> leaves;
  CubeKind wanted = CubeKind::kMixed;  // kind of the leaves that are listed; mixed: none

 private:
  // Number of the first block after a cube; inside a block, the block itself counts.
  std::size_t after(std::uint64_t code, int depth, std::size_t first, std::size_t last) const {
    if (depth > kBlockDepth) return last;
    const std::uint64_t end = (code + 1) << 3 * (kBlockDepth - depth);
    return static_cast<std::size_t>(std::lower_bound(codes_.begin() + static_cast<std::ptrdiff_t>(first),
                                                     codes_.begin() + static_cast<std::ptrdiff_t>(last), end) -
                                    codes_.begin());
  }

  void put(float value, std::uint8_t children) {
    out.resize(out.size() + kNodeSize);
    write(out.size() - kNodeSize, value, children);
  }

  void write(std::size_t at, float value, std::uint8_t children) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (std::size_t byte = 0; byte < 4; ++byte) out[at + byte] = static_cast<std::uint8_t>(bits >> 8 * byte & 255U);
    out[at + 4] = children;
  }

  const OccupancyTree& tree_;
  std::vector<std::uint64_t> codes_;
  const Block* block_ = nullptr;
};

std::vector<std::uint8_t> OccupancyTree::binary() const {
  Writer writer(*this);
  writer.binary(0, 0, 0, writer.size());
  return std::move(writer.out);
}

std::vector<std::uint8_t> OccupancyTree::full() const {
  Writer writer(*this);
  writer.full(0, 0, 0, writer.size());
  return std::move(writer.out);
}

std::vector<TreeLeaf> OccupancyTree::leaves(CubeKind kind) const {
  Writer writer(*this);
  writer.wanted = kind;
  writer.binary(0, 0, 0, writer.size());
  return std::move(writer.leaves);
}

// Gives all cubes of a leaf one value.
bool OccupancyTree::fill(const TreeLeaf& leaf, float odds) {
  odds = std::clamp(odds, options_.lower, options_.upper);
  const std::uint64_t code = interleaved(static_cast<std::uint32_t>(leaf.x), static_cast<std::uint32_t>(leaf.y),
                                         static_cast<std::uint32_t>(leaf.z));
  if (leaf.depth > kBlockDepth) {
    const int shift = 3 * (kTreeDepth - leaf.depth);
    const std::uint64_t first = code << shift;
    Block* block = block_at(first >> 3 * kBlockLevels, true);
    if (!block) return false;
    for (std::size_t at = first & 511U; at < (first & 511U) + (std::size_t{1} << shift); ++at) {
      block->odds[at] = odds;
      block->known.set(at);
    }
    return true;
  }
  const int shift = 3 * (kBlockDepth - leaf.depth);
  if (std::uint64_t{1} << shift > kMaxBlocks) return false;
  for (std::uint64_t place = code << shift; place < (code + 1) << shift; ++place) {
    Block* block = block_at(place, true);
    if (!block) return false;
    block->odds.fill(odds);
    block->known.set();
  }
  return true;
}

bool OccupancyTree::read_binary(std::span<const std::uint8_t> data) {
  reset();
  std::vector<TreeLeaf> inner;
  if (!data.empty()) inner.push_back({0, 0, 0, 0});
  std::size_t at = 0;
  while (!inner.empty()) {
    const TreeLeaf node = inner.back();
    inner.pop_back();
    if (at + 2 > data.size() || node.depth >= kTreeDepth) return false;
    const std::uint32_t bits = data[at] | std::uint32_t{data[at + 1]} << 8;
    at += 2;
    for (int child = 7; child >= 0; --child) {
      const auto kind = static_cast<CubeKind>(bits >> 2 * child & 3U);
      const TreeLeaf cube{2 * node.x + (child & 1), 2 * node.y + (child >> 1 & 1), 2 * node.z + (child >> 2),
                          node.depth + 1};
      if (kind == CubeKind::kMixed) inner.push_back(cube);
      if (kind == CubeKind::kFree && !fill(cube, options_.lower)) return false;
      if (kind == CubeKind::kOccupied && !fill(cube, options_.upper)) return false;
    }
  }
  return true;
}

bool OccupancyTree::read_full(std::span<const std::uint8_t> data, std::size_t node_size) {
  reset();
  std::vector<TreeLeaf> nodes;
  if (!data.empty()) nodes.push_back({0, 0, 0, 0});
  std::size_t at = 0;
  while (!nodes.empty()) {
    const TreeLeaf node = nodes.back();
    nodes.pop_back();
    if (at + node_size > data.size() || node_size < kNodeSize) return false;
    std::uint32_t bits = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) bits |= std::uint32_t{data[at + byte]} << 8 * byte;
    const std::uint8_t children = data[at + node_size - 1];
    at += node_size;
    const float odds = std::bit_cast<float>(bits);
    if (children == 0) {
      if (!std::isfinite(odds) || !fill(node, odds)) return false;
      continue;
    }
    if (node.depth >= kTreeDepth) return false;
    for (int child = 7; child >= 0; --child)
      if (children >> child & 1)
        nodes.push_back(
            {2 * node.x + (child & 1), 2 * node.y + (child >> 1 & 1), 2 * node.z + (child >> 2), node.depth + 1});
  }
  return true;
}

Projection OccupancyTree::project(double low, double high) const {
  Projection found;
  std::array<int, 2> first{2 * kCenter, 2 * kCenter}, last{-1, -1};
  const auto each = [&](const auto& visit) {
    for (const auto& [code, block] : blocks_)
      for (std::size_t at = 0; at < 512; ++at)
        if (block->known[at]) visit(leaf_of(code << 3 * kBlockLevels | at, kTreeDepth), kind(*block, at));
  };
  each([&](const TreeLeaf& leaf, CubeKind) {
    first = {std::min(first[0], leaf.x), std::min(first[1], leaf.y)};
    last = {std::max(last[0], leaf.x), std::max(last[1], leaf.y)};
  });
  if (last[0] < 0) return found;
  found.x = first[0];
  found.y = first[1];
  found.width = last[0] - first[0] + 1;
  found.height = last[1] - first[1] + 1;
  const auto width = static_cast<std::size_t>(found.width);
  found.cells.assign(width * static_cast<std::size_t>(found.height), -1);
  each([&](const TreeLeaf& leaf, CubeKind cube) {
    const double below = (leaf.z - kCenter) * options_.resolution;
    if (below + options_.resolution <= low || below >= high) return;
    std::int8_t& cell =
        found.cells[static_cast<std::size_t>(leaf.y - first[1]) * width + static_cast<std::size_t>(leaf.x - first[0])];
    if (cube == CubeKind::kOccupied) cell = 100;
    if (cube == CubeKind::kFree && cell < 0) cell = 0;
  });
  return found;
}

float OccupancyTree::odds(const Point& point) const {
  TreeKey key{};
  if (!key_of(point, key)) return std::numeric_limits<float>::quiet_NaN();
  const auto found = blocks_.find(block_of(key));
  const std::size_t at = place_in_block(key);
  if (found == blocks_.end() || !found->second->known[at]) return std::numeric_limits<float>::quiet_NaN();
  return found->second->odds[at];
}

}  // namespace trundle::navigation
