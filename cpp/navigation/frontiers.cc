#include "frontiers.h"

#include <array>
#include <cstddef>
#include <deque>
#include <utility>

namespace trundle {

namespace {

using Cell = std::pair<int, int>;  // column, row

constexpr std::array<Cell, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
constexpr std::array<Cell, 8> kAround{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

class Search {
 public:
  Search(const std::uint8_t* costs, const GridShape& shape)
      : costs_(costs), shape_(shape), is_seen_(shape.size()), is_frontier_(shape.size()) {}

  std::vector<FrontierCell> run(const Cell& start) {
    std::vector<FrontierCell> found;
    Cell first;
    if (!nearest_free(start, first)) return found;
    is_seen_.assign(shape_.size(), false);
    std::deque<Cell> queue{first};
    mark(is_seen_, first);
    std::int32_t count = 0;
    while (!queue.empty()) {
      const Cell cell = queue.front();
      queue.pop_front();
      for (const Cell& step : kSides) {
        const Cell next{cell.first + step.first, cell.second + step.second};
        if (!shape_.contains(next.first, next.second)) continue;
        if (cost(next) == kFreeSpace) {
          if (mark(is_seen_, next)) queue.push_back(next);
        } else if (is_new_frontier(next)) {
          collect(next, count++, found);
        }
      }
    }
    return found;
  }

 private:
  std::uint8_t cost(const Cell& cell) const { return costs_[shape_.index(cell.first, cell.second)]; }

  // True for the first visit of a cell.
  bool mark(std::vector<bool>& marks, const Cell& cell) {
    const std::size_t index = shape_.index(cell.first, cell.second);
    if (marks[index]) return false;
    marks[index] = true;
    return true;
  }

  bool nearest_free(const Cell& start, Cell& found) {
    std::deque<Cell> queue{start};
    mark(is_seen_, start);
    while (!queue.empty()) {
      found = queue.front();
      queue.pop_front();
      if (cost(found) == kFreeSpace) return true;
      for (const Cell& step : kSides) {
        const Cell next{found.first + step.first, found.second + step.second};
        if (shape_.contains(next.first, next.second) && mark(is_seen_, next)) queue.push_back(next);
      }
    }
    return false;
  }

  bool is_new_frontier(const Cell& cell) const {
    if (cost(cell) != kNoInformation || is_frontier_[shape_.index(cell.first, cell.second)]) return false;
    for (const Cell& step : kSides) {
      const Cell next{cell.first + step.first, cell.second + step.second};
      if (shape_.contains(next.first, next.second) && cost(next) == kFreeSpace) return true;
    }
    return false;
  }

  void collect(const Cell& first, std::int32_t number, std::vector<FrontierCell>& found) {
    std::deque<Cell> queue{first};
    mark(is_frontier_, first);
    while (!queue.empty()) {
      const Cell cell = queue.front();
      queue.pop_front();
      found.push_back({number, cell.first, cell.second});
      for (const Cell& step : kAround) {
        const Cell next{cell.first + step.first, cell.second + step.second};
        if (shape_.contains(next.first, next.second) && is_new_frontier(next)) {
          mark(is_frontier_, next);
          queue.push_back(next);
        }
      }
    }
  }

  const std::uint8_t* costs_;
  GridShape shape_;
  std::vector<bool> is_seen_, is_frontier_;
};

}  // namespace

std::vector<FrontierCell> find_frontiers(const std::uint8_t* costs, const GridShape& shape, int column, int row) {
  if (!shape.contains(column, row)) return {};
  return Search(costs, shape).run({column, row});
}

}  // namespace trundle
