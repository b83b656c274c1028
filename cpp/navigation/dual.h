// Numbers with their derivatives by N variables (forward differentiation); with N = 0 they are plain numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace trundle::navigation {

template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope{};

  Dual() = default;
  Dual(double number) : value(number) {}  // NOLINT(google-explicit-constructor): numbers are constants

  // Result of a function of one number, with its derivative.
  [[nodiscard]] Dual mapped(double result, double derivative) const {
    Dual dual(result);
    for (std::size_t i = 0; i < N; ++i) dual.slope[i] = derivative * slope[i];
    return dual;
  }
};

// a f + b g in the derivatives, with a given value.
template <std::size_t N>
Dual<N> combined(double value, const Dual<N>& f, double a, const Dual<N>& g, double b) {
  Dual<N> dual(value);
  for (std::size_t i = 0; i < N; ++i) dual.slope[i] = a * f.slope[i] + b * g.slope[i];
  return dual;
}

template <std::size_t N>
Dual<N> operator+(const Dual<N>& f, const Dual<N>& g) {
  return combined(f.value + g.value, f, 1.0, g, 1.0);
}

template <std::size_t N>
Dual<N> operator-(const Dual<N>& f, const Dual<N>& g) {
  return combined(f.value - g.value, f, 1.0, g, -1.0);
}

template <std::size_t N>
Dual<N> operator*(const Dual<N>& f, const Dual<N>& g) {
  return combined(f.value * g.value, f, g.value, g, f.value);
}

template <std::size_t N>
Dual<N> operator/(const Dual<N>& f, const Dual<N>& g) {
  const double quotient = f.value / g.value;
  return combined(quotient, f, 1.0 / g.value, g, -quotient / g.value);
}

template <std::size_t N>
Dual<N> sine(const Dual<N>& f) {
  return f.mapped(std::sin(f.value), std::cos(f.value));
}

template <std::size_t N>
Dual<N> cosine(const Dual<N>& f) {
  return f.mapped(std::cos(f.value), -std::sin(f.value));
}

template <std::size_t N>
Dual<N> magnitude(const Dual<N>& f) {
  return f.mapped(std::abs(f.value), f.value < 0.0 ? -1.0 : 1.0);
}

// Length of a vector; its derivative at zero is zero.
template <std::size_t N>
Dual<N> length(const Dual<N>& x, const Dual<N>& y) {
  const double norm = std::sqrt(x.value * x.value + y.value * y.value);
  const double scale = norm > 1e-9 ? 1.0 / norm : 0.0;
  return combined(norm, x, x.value * scale, y, y.value * scale);
}

// The same angle in -π … π.
template <std::size_t N>
Dual<N> wrapped(const Dual<N>& angle) {
  return angle.mapped(std::remainder(angle.value, 2.0 * std::numbers::pi), 1.0);
}

}  // namespace trundle::navigation
