// The streams of octomap's messages and files.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "cube_codes.h"
#include "occupancy_tree.h"

namespace trundle::navigation {

namespace {

constexpr std::size_t kNodeSize = 5;  // of a full stream, without colors

}  // namespace

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

}  // namespace trundle::navigation
