// How well a Jacobian lets a tip move.
#pragma once

#include <cstddef>
#include <utility>

namespace trundle::planning {

// Yoshikawa's manipulability (the product of the singular values) and the ratio of the smallest to the largest one.
// `rows` × `columns` by rows, at most 6 rows; with fewer columns than rows, of as many values as there are columns.
std::pair<double, double> manipulability(const double* jacobian, std::size_t columns, std::size_t rows);

}  // namespace trundle::planning
