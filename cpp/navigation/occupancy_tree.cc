#include "occupancy_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "cube_codes.h"

namespace trundle::navigation {

namespace {

constexpr int kCenter = 1 << (kTreeDepth - 1);

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
  if (width * static_cast<std::size_t>(found.height) > kMaxMapCells)
    throw std::length_error(std::to_string(found.width) + " × " + std::to_string(found.height) + " cells; at most " +
                            std::to_string(kMaxMapCells));
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
