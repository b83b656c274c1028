#include "score_window.h"

#include <algorithm>
#include <cmath>

namespace trundle::navigation {

namespace {

constexpr int kMaxSize = 4096;      // cells along a side
constexpr double kReach = 2.5;      // of the kernel, in standard deviations
constexpr double kMaxSmear = 16.0;  // [cells]
constexpr int kParts = 4;           // of a cell along an axis: places of hits are told apart
constexpr int kShift = 2;           // a level's cells are 1 << kShift as long as those below
constexpr double kHighest = 255.0;
constexpr double kFar = 1e8;  // beyond every window [cells]

int cell_of(double place) { return static_cast<int>(std::floor(std::min(std::max(-kFar, place), kFar))); }

}  // namespace

ScoreWindow::ScoreWindow(const Point& center, double half_width, double resolution, double smear)
    : resolution_(std::max(resolution, 2.0 * half_width / kMaxSize)),
      smear_(std::clamp(smear, 0.5 * resolution_, kMaxSmear * resolution_)) {
  const int half = std::min(static_cast<int>(std::ceil(half_width / resolution_)), kMaxSize / 2);
  // Whole cells from the origin on, so that windows of the same place have the same cells.
  corner_ = {(std::floor(center.x / resolution_) - half) * resolution_,
             (std::floor(center.y / resolution_) - half) * resolution_};
  levels_.resize(kLevels);
  levels_[0].size = 2 * half + 1;
  const std::size_t count = static_cast<std::size_t>(levels_[0].size) * static_cast<std::size_t>(levels_[0].size);
  levels_[0].values.assign(count, 0);
  drawn_.assign(count, 0);
  reach_ = static_cast<int>(std::ceil(kReach * smear_ / resolution_));
  const double scale = -0.5 * resolution_ * resolution_ / (smear_ * smear_);
  for (int part = 0; part < kParts * kParts; ++part)
    for (int row = -reach_; row <= reach_; ++row)
      for (int column = -reach_; column <= reach_; ++column) {
        const double x = column + 0.5 - (part % kParts + 0.5) / kParts, y = row + 0.5 - (part / kParts + 0.5) / kParts;
        kernels_.push_back(static_cast<std::uint8_t>(kHighest * std::exp(scale * (x * x + y * y))));
      }
}

int ScoreWindow::column_of(double x) const { return cell_of((x - corner_.x) / resolution_); }

int ScoreWindow::row_of(double y) const { return cell_of((y - corner_.y) / resolution_); }

void ScoreWindow::add(const Point& hit) {
  Level& cells = levels_[0];
  const double x = (hit.x - corner_.x) / resolution_, y = (hit.y - corner_.y) / resolution_;
  if (!(x >= 0.0 && y >= 0.0 && x < cells.size && y < cells.size)) return;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const int part = static_cast<int>((y - row) * kParts) * kParts + static_cast<int>((x - column) * kParts);
  const auto width = static_cast<std::size_t>(cells.size);
  std::uint16_t& drawn = drawn_[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
  const auto bit = static_cast<std::uint16_t>(1u << part);
  if (drawn & bit) return;
  drawn = static_cast<std::uint16_t>(drawn | bit);
  const int first = std::max(-reach_, -column), last = std::min(reach_, cells.size - 1 - column);
  const std::ptrdiff_t side = 2 * reach_ + 1;
  for (int i = std::max(-reach_, -row); i <= std::min(reach_, cells.size - 1 - row); ++i) {
    const std::uint8_t* kernel = kernels_.data() + (part * side + i + reach_) * side + reach_;
    std::uint8_t* values = cells.values.data() + static_cast<std::ptrdiff_t>(row + i) * cells.size + column;
    for (int j = first; j <= last; ++j) values[j] = std::max(values[j], kernel[j]);
  }
}

void ScoreWindow::add_between(const Point& a, const Point& b) {
  const int parts = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / smear_) + 1;
  for (int i = 1; i < parts; ++i) {
    const double part = static_cast<double>(i) / parts;
    add({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
  }
}

void ScoreWindow::finish() {
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const Level& below = levels_[k - 1];
    Level& level = levels_[k];
    level.size = (below.size >> kShift) + 1;
    const auto size = static_cast<std::size_t>(level.size), fine = static_cast<std::size_t>(below.size);
    level.values.assign(size * size, 0);
    // Blocks without an overlap first; a cell is the highest of its block and those to the right and above.
    for (std::size_t row = 0; row < fine; ++row)
      for (std::size_t column = 0; column < fine; ++column) {
        std::uint8_t& value = level.values[(row >> kShift) * size + (column >> kShift)];
        value = std::max(value, below.values[row * fine + column]);
      }
    for (std::size_t row = 0; row < size; ++row)
      for (std::size_t column = 0; column < size; ++column) {
        std::uint8_t& value = level.values[row * size + column];
        const std::size_t right = column + 1 < size ? 1 : 0, above = row + 1 < size ? size : 0;
        const std::size_t cell = row * size + column;
        value = std::max(
            {value, level.values[cell + right], level.values[cell + above], level.values[cell + above + right]});
      }
  }
}

ScoreWindow::Sample ScoreWindow::sample(const Point& place) const {
  const double x = (place.x - corner_.x) / resolution_ - 0.5, y = (place.y - corner_.y) / resolution_ - 0.5;
  const double column = std::floor(x), row = std::floor(y);
  const auto size = static_cast<double>(levels_[0].size);
  if (!(column >= 0.0 && row >= 0.0 && column + 1.0 < size && row + 1.0 < size)) return {0.0, 0.0, 0.0};
  const std::size_t width = static_cast<std::size_t>(levels_[0].size);
  const std::uint8_t* cell =
      levels_[0].values.data() + static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
  const double u = x - column, v = y - row;
  const double a = cell[0], b = cell[1], c = cell[width], d = cell[width + 1];
  const double lower = a + u * (b - a), upper = c + u * (d - c);
  const double scale = 1.0 / (kHighest * resolution_);
  return {(lower + v * (upper - lower)) / kHighest, ((1.0 - v) * (b - a) + v * (d - c)) * scale,
          (upper - lower) * scale};
}

}  // namespace trundle::navigation
