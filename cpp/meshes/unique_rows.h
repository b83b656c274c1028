// Distinct rows of an array of three columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trundle {

struct UniqueRows {
  std::vector<std::int64_t> first;   // index of each distinct row's first occurrence, in ascending order of the rows
  std::vector<std::int64_t> number;  // number of each row among the distinct ones
};

// Rows are compared by value: zeros of both signs are equal, and rows with NaN differ from every other.
template <typename Number>
UniqueRows unique_rows(const Number* rows, std::size_t count);

extern template UniqueRows unique_rows<float>(const float*, std::size_t);
extern template UniqueRows unique_rows<double>(const double*, std::size_t);

}  // namespace trundle
