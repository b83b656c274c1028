#include "manipulability.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trundle::planning {

namespace {

constexpr std::size_t kMost = 6;
constexpr int kSweeps = 20;

// Eigenvalues of a symmetric matrix of `size` rows (Jacobi's rotations).
std::array<double, kMost> eigenvalues(std::array<std::array<double, kMost>, kMost> a, std::size_t size) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double off = 0.0, diagonal = 0.0;
    for (std::size_t p = 0; p < size; ++p) {
      diagonal += a[p][p] * a[p][p];
      for (std::size_t q = p + 1; q < size; ++q) off += a[p][q] * a[p][q];
    }
    if (off <= 1e-30 * diagonal) break;
    for (std::size_t p = 0; p < size; ++p) {
      for (std::size_t q = p + 1; q < size; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        for (std::size_t k = 0; k < size; ++k) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y;
          a[k][q] = s * x + c * y;
        }
        for (std::size_t k = 0; k < size; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y;
          a[q][k] = s * x + c * y;
        }
      }
    }
  }
  std::array<double, kMost> values{};
  for (std::size_t i = 0; i < size; ++i) values[i] = std::max(a[i][i], 0.0);
  return values;
}

}  // namespace

std::pair<double, double> manipulability(const double* jacobian, std::size_t columns, std::size_t rows) {
  const std::size_t size = std::min(columns, rows);
  const bool is_tall = columns < rows;
  std::array<std::array<double, kMost>, kMost> product{};
  for (std::size_t p = 0; p < size; ++p)
    for (std::size_t q = 0; q < size; ++q)
      for (std::size_t k = 0; k < (is_tall ? rows : columns); ++k)
        product[p][q] += is_tall ? jacobian[k * columns + p] * jacobian[k * columns + q]
                                 : jacobian[p * columns + k] * jacobian[q * columns + k];
  const std::array<double, kMost> values = eigenvalues(product, size);
  double volume = 1.0, smallest = values[0], largest = values[0];
  for (std::size_t i = 0; i < size; ++i) {
    volume *= std::sqrt(values[i]);
    smallest = std::min(smallest, values[i]);
    largest = std::max(largest, values[i]);
  }
  return {volume, largest > 0.0 ? std::sqrt(smallest / largest) : 0.0};
}

}  // namespace trundle::planning
