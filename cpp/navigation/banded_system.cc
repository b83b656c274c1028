#include "banded_system.h"

#include <algorithm>
#include <cmath>

namespace trundle::navigation {

BandedSystem::BandedSystem(std::size_t size, std::size_t width)
    : size_(size), width_(width), entries_(size * (width + 1)), factor_(entries_.size()) {}

void BandedSystem::clear() { std::fill(entries_.begin(), entries_.end(), 0.0); }

bool BandedSystem::decompose(double damping) {
  factor_ = entries_;
  for (std::size_t row = 0; row < size_; ++row) {
    factor_[place(row, row)] += damping * (1.0 + factor_[place(row, row)]);
    for (std::size_t column = first(row); column <= row; ++column) {
      double sum = factor_[place(row, column)];
      for (std::size_t k = std::max(first(row), first(column)); k < column; ++k)
        sum -= factor_[place(row, k)] * factor_[place(column, k)];
      if (column < row) factor_[place(row, column)] = sum / factor_[place(column, column)];
      else if (!(sum > 0.0) || !std::isfinite(sum)) return false;
      else factor_[place(row, row)] = std::sqrt(sum);
    }
  }
  return true;
}

bool BandedSystem::solve(const std::vector<double>& right, double damping, std::vector<double>& solution) {
  if (!decompose(damping)) return false;
  solution = right;
  for (std::size_t row = 0; row < size_; ++row) {
    for (std::size_t k = first(row); k < row; ++k) solution[row] -= factor_[place(row, k)] * solution[k];
    solution[row] /= factor_[place(row, row)];
  }
  for (std::size_t row = size_; row-- > 0;) {
    solution[row] /= factor_[place(row, row)];
    for (std::size_t k = first(row); k < row; ++k) solution[k] -= factor_[place(row, k)] * solution[row];
  }
  return true;
}

}  // namespace trundle::navigation
