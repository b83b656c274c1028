// Symmetric positive definite systems whose entries lie near the diagonal, by Cholesky decomposition.
#pragma once

#include <cstddef>
#include <vector>

namespace trundle::navigation {

class BandedSystem {
 public:
  // size: number of unknowns; width: greatest distance of an entry from the diagonal.
  BandedSystem(std::size_t size, std::size_t width);

  void clear();

  [[nodiscard]] std::size_t size() const { return size_; }

  // Entry of the lower triangle: row - width <= column <= row.
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return entries_[place(row, column)]; }

  // Solves the system with its diagonal raised by a share of itself and of one; false where it is not positive
  // definite.
  [[nodiscard]] bool solve(const std::vector<double>& right, double damping, std::vector<double>& solution);

 private:
  [[nodiscard]] std::size_t place(std::size_t row, std::size_t column) const {
    return row * (width_ + 1) + (width_ + column - row);
  }
  [[nodiscard]] std::size_t first(std::size_t row) const { return row > width_ ? row - width_ : 0; }
  [[nodiscard]] bool decompose(double damping);

  std::size_t size_, width_;
  std::vector<double> entries_, factor_;
};

}  // namespace trundle::navigation
