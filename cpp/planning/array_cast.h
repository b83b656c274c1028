// NumPy arrays of the bindings.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "rigid.h"
#include "state_space.h"

namespace trundle::planning {

namespace nb = nanobind;

using Numbers = nb::ndarray<const double, nb::numpy, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <int columns>
using Rows = nb::ndarray<const double, nb::numpy, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;
using Table = nb::ndarray<const double, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

inline nb::object owned_array(std::vector<double> numbers, std::vector<std::size_t> shape) {
  auto* kept = new std::vector<double>(std::move(numbers));
  const nb::capsule owner(kept, [](void* data) noexcept { delete static_cast<std::vector<double>*>(data); });
  return nb::cast(nb::ndarray<nb::numpy, double>(kept->data(), shape.size(), shape.data(), owner));
}

inline std::span<const double> span_of(const Numbers& numbers, std::size_t size) {
  if (numbers.size() != size) throw nb::value_error("a state has one number for each variable");
  for (std::size_t i = 0; i < size; ++i)
    if (!std::isfinite(numbers.data()[i])) throw nb::value_error("a state has finite numbers only");
  return {numbers.data(), size};
}

inline std::vector<State> states_of(const Table& table, std::size_t columns) {
  if (table.shape(1) != columns) throw nb::value_error("a state has one number for each variable");
  std::vector<State> states;
  for (std::size_t i = 0; i < table.shape(0); ++i) {
    states.emplace_back(table.data() + i * columns, table.data() + (i + 1) * columns);
    for (const double number : states.back())
      if (!std::isfinite(number)) throw nb::value_error("a state has finite numbers only");
  }
  return states;
}

inline nb::object table_of(const std::vector<State>& states, std::size_t columns) {
  std::vector<double> numbers;
  numbers.reserve(states.size() * columns);
  for (const State& state : states) numbers.insert(numbers.end(), state.begin(), state.end());
  return owned_array(std::move(numbers), {states.size(), columns});
}

inline std::vector<Rigid> poses_of(const Rows<7>& rows) {
  std::vector<Rigid> poses;
  for (std::size_t i = 0; i < rows.shape(0); ++i) {
    for (std::size_t k = 0; k < 7; ++k)
      if (!std::isfinite(rows(i, k)) || std::abs(rows(i, k)) > 1e6) throw nb::value_error("a pose has finite numbers");
    poses.push_back(rigid_of(rows.data() + 7 * i));
  }
  return poses;
}

inline Vec3 vector_of(const Numbers& numbers) {
  if (numbers.size() != 3) throw nb::value_error("a vector has three numbers");
  for (std::size_t i = 0; i < 3; ++i)
    if (!std::isfinite(numbers.data()[i])) throw nb::value_error("a vector has finite numbers");
  return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
}

}  // namespace trundle::planning
