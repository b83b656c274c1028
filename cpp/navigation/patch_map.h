// Grid of cells that grows as needed, in patches that copies of the grid share until one changes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace trundle::navigation {

template <typename Cell>
class PatchMap {
 public:
  explicit PatchMap(double resolution) : resolution_(resolution) {}

  // True for positions in the grid; others are farther than any laser reaches: 1.6 km at 5 cm.
  bool reaches(double position) const { return std::abs(position / resolution_) < kMaxCell; }
  // Number of the cell along an axis; positions outside the grid are in the last one.
  int cell_of(double position) const {
    return static_cast<int>(std::floor(std::min(std::max(-kMaxCell, position / resolution_), kMaxCell)));
  }
  double corner(int cell) const { return cell * resolution_; }

  // A cell to read; null if no cell of its patch was written.
  const Cell* find(int column, int row) const {
    const Patch* patch = patch_at(column >> kShift, row >> kShift);
    return patch == nullptr ? nullptr : &(*patch)[index_in_patch(column, row)];
  }

  // A cell to write to.
  Cell& at(int column, int row) {
    include(column >> kShift, row >> kShift);
    auto& patch = patches_[index(column >> kShift, row >> kShift)];
    if (patch == nullptr) patch = std::make_shared<Patch>();
    else if (patch.use_count() > 1) patch = std::make_shared<Patch>(*patch);
    return (*patch)[index_in_patch(column, row)];
  }

 private:
  static constexpr double kMaxCell = 32767.0;
  static constexpr int kShift = 5, kMask = (1 << kShift) - 1;
  using Patch = std::array<Cell, 1 << (2 * kShift)>;

  static std::size_t index_in_patch(int column, int row) {
    return static_cast<std::size_t>((row & kMask) << kShift | (column & kMask));
  }

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column - first_column_);
  }

  bool contains(int column, int row) const {
    return column >= first_column_ && row >= first_row_ && column < first_column_ + columns_ &&
           row < first_row_ + rows_;
  }

  const Patch* patch_at(int column, int row) const {
    return contains(column, row) ? patches_[index(column, row)].get() : nullptr;
  }

  void include(int column, int row) {
    if (contains(column, row)) return;
    PatchMap grown(resolution_);
    grown.first_column_ = rows_ ? std::min(first_column_, column) : column;
    grown.first_row_ = rows_ ? std::min(first_row_, row) : row;
    grown.columns_ = (rows_ ? std::max(first_column_ + columns_, column + 1) : column + 1) - grown.first_column_;
    grown.rows_ = (rows_ ? std::max(first_row_ + rows_, row + 1) : row + 1) - grown.first_row_;
    grown.patches_.resize(static_cast<std::size_t>(grown.columns_) * static_cast<std::size_t>(grown.rows_));
    for (int old_row = first_row_; old_row < first_row_ + rows_; ++old_row)
      for (int old_column = first_column_; old_column < first_column_ + columns_; ++old_column)
        grown.patches_[grown.index(old_column, old_row)] = std::move(patches_[index(old_column, old_row)]);
    *this = std::move(grown);
  }

  double resolution_;                                              // [m]
  int first_column_ = 0, first_row_ = 0, columns_ = 0, rows_ = 0;  // numbers of the patches
  std::vector<std::shared_ptr<Patch>> patches_;
};

}  // namespace trundle::navigation
