#include "block_cholesky.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace trundle::navigation {

namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

Block transposed(const Block& a) { return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}; }

// target -= a bᵀ
void subtract_product(Block& target, const Block& a, const Block& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      target[3 * i + j] -= a[3 * i] * b[3 * j] + a[3 * i + 1] * b[3 * j + 1] + a[3 * i + 2] * b[3 * j + 2];
}

// Replaces a block by its lower Cholesky factor; false where it is not positive definite.
bool decompose_block(Block& a) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[3 * i + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[3 * i + k] * a[3 * j + k];
      if (i != j) a[3 * i + j] = sum / a[3 * j + j];
      else if (!(sum > 0.0) || !std::isfinite(sum)) return false;
      else a[3 * i + i] = std::sqrt(sum);
    }
    for (std::size_t j = i + 1; j < 3; ++j) a[3 * i + j] = 0.0;
  }
  return true;
}

// a = a l⁻ᵀ
void divide_by_transposed(Block& a, const Block& l) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = a[3 * i + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[3 * i + k] * l[3 * j + k];
      a[3 * i + j] = sum / l[3 * j + j];
    }
}

void solve_lower(const Block& l, Triple& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= l[3 * i + k] * x[k];
    x[i] /= l[3 * i + i];
  }
}

void solve_upper(const Block& l, Triple& x) {
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) x[i] -= l[3 * k + i] * x[k];
    x[i] /= l[3 * i + i];
  }
}

}  // namespace

BlockCholesky::BlockCholesky(int count, std::vector<std::pair<int, int>> pairs)
    : pairs_(std::move(pairs)), place_(index(count)), columns_(index(count)) {
  order();
}

// Eliminates a node of the fewest neighbors, the first of equals; its neighbors become neighbors of each other.
void BlockCholesky::order() {
  const int count = static_cast<int>(place_.size());
  std::vector<std::vector<int>> neighbors(index(count));
  for (const auto& [i, j] : pairs_) {
    neighbors[index(i)].push_back(j);
    neighbors[index(j)].push_back(i);
  }
  std::set<std::pair<std::size_t, int>> by_degree;
  for (int i = 0; i < count; ++i) {
    std::sort(neighbors[index(i)].begin(), neighbors[index(i)].end());
    by_degree.emplace(neighbors[index(i)].size(), i);
  }
  std::vector<int> merged;
  for (int place = 0; place < count; ++place) {
    const int node = by_degree.begin()->second;
    by_degree.erase(by_degree.begin());
    place_[index(node)] = place;
    const std::vector<int> clique = std::move(neighbors[index(node)]);
    for (const int neighbor : clique) {
      std::vector<int>& own = neighbors[index(neighbor)];
      by_degree.erase({own.size(), neighbor});
      merged.clear();
      std::set_union(own.begin(), own.end(), clique.begin(), clique.end(), std::back_inserter(merged));
      std::erase_if(merged, [&](int other) { return other == node || other == neighbor; });
      own = merged;
      by_degree.emplace(own.size(), neighbor);
    }
    columns_[index(place)].rows = clique;  // as rows of the system, until all places are known
  }
  for (Column& column : columns_) {
    for (int& row : column.rows) row = place_[index(row)];
    std::sort(column.rows.begin(), column.rows.end());
    column.blocks.resize(column.rows.size());
  }
}

Block& BlockCholesky::block_at(Column& column, int row) {
  const auto found = std::lower_bound(column.rows.begin(), column.rows.end(), row);
  return column.blocks[static_cast<std::size_t>(found - column.rows.begin())];
}

bool BlockCholesky::decompose() {
  for (Column& column : columns_) {
    if (!decompose_block(column.diagonal)) return false;
    for (Block& block : column.blocks) divide_by_transposed(block, column.diagonal);
    for (std::size_t a = 0; a < column.rows.size(); ++a) {
      Column& target = columns_[index(column.rows[a])];
      subtract_product(target.diagonal, column.blocks[a], column.blocks[a]);
      for (std::size_t b = a + 1; b < column.rows.size(); ++b)
        subtract_product(block_at(target, column.rows[b]), column.blocks[b], column.blocks[a]);
    }
  }
  return true;
}

bool BlockCholesky::solve(const std::vector<Block>& diagonal, const std::vector<Block>& beside,
                          std::vector<Triple>& right) {
  for (Column& column : columns_) std::fill(column.blocks.begin(), column.blocks.end(), Block{});
  for (std::size_t i = 0; i < diagonal.size(); ++i) columns_[index(place_[i])].diagonal = diagonal[i];
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const int i = place_[index(pairs_[k].first)], j = place_[index(pairs_[k].second)];
    // Block (i, j) of the system; the lower triangle has rows after columns.
    if (i > j) block_at(columns_[index(j)], i) = beside[k];
    else block_at(columns_[index(i)], j) = transposed(beside[k]);
  }
  if (!decompose()) return false;
  std::vector<Triple> x(right.size());
  for (std::size_t i = 0; i < right.size(); ++i) x[index(place_[i])] = right[i];
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    solve_lower(columns_[c].diagonal, x[c]);
    for (std::size_t r = 0; r < columns_[c].rows.size(); ++r) {
      const Block& block = columns_[c].blocks[r];
      Triple& target = x[index(columns_[c].rows[r])];
      for (std::size_t i = 0; i < 3; ++i)
        target[i] -= block[3 * i] * x[c][0] + block[3 * i + 1] * x[c][1] + block[3 * i + 2] * x[c][2];
    }
  }
  for (std::size_t c = columns_.size(); c-- > 0;) {
    for (std::size_t r = 0; r < columns_[c].rows.size(); ++r) {
      const Block& block = columns_[c].blocks[r];
      const Triple& source = x[index(columns_[c].rows[r])];
      for (std::size_t i = 0; i < 3; ++i)
        x[c][i] -= block[i] * source[0] + block[3 + i] * source[1] + block[6 + i] * source[2];
    }
    solve_upper(columns_[c].diagonal, x[c]);
  }
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = x[index(place_[i])];
  return true;
}

}  // namespace trundle::navigation
