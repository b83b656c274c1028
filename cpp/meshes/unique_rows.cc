#include "unique_rows.h"

#include <algorithm>
#include <array>
#include <bit>

namespace trundle {

namespace {

constexpr std::int64_t kFree = -1;

std::uint64_t mixed(std::uint64_t bits) {  // the finalizer of MurmurHash3
  bits = (bits ^ (bits >> 33)) * 0xff51afd7ed558ccdULL;
  bits = (bits ^ (bits >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return bits ^ (bits >> 33);
}

template <typename Number>
std::uint64_t hash_of(const Number* row, std::size_t index) {
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    if (row[i] != row[i]) return mixed(index);  // rows with NaN equal no other, so they are spread over the table
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(row[i]) + 0.0));
  }
  return hash;
}

template <typename Number>
bool is_equal(const Number* a, const Number* b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

template <typename Number>
bool is_less(const Number* a, const Number* b) {
  for (int i = 0; i < 3; ++i) {
    if (a[i] < b[i] || (a[i] == a[i] && b[i] != b[i])) return true;  // NaN is the largest
    if (b[i] < a[i] || (b[i] == b[i] && a[i] != a[i])) return false;
  }
  return false;
}

// Hash table with linear probing, at most half full.
template <typename Number>
class RowTable {
 public:
  explicit RowTable(const Number* rows) : rows_(rows), slots_(1024, kFree) {}

  std::int64_t number_of(std::size_t index) {
    if (2 * first.size() >= slots_.size()) grow();
    const std::size_t slot = slot_of(index);
    if (slots_[slot] == kFree) {
      slots_[slot] = static_cast<std::int64_t>(first.size());
      first.push_back(static_cast<std::int64_t>(index));
    }
    return slots_[slot];
  }

  std::vector<std::int64_t> first;

 private:
  std::size_t slot_of(std::size_t index) const {
    const Number* row = rows_ + 3 * index;
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(row, index) & mask;
    while (slots_[slot] != kFree && !is_equal(rows_ + 3 * first[slots_[slot]], row)) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    slots_.assign(4 * slots_.size(), kFree);
    for (std::size_t i = 0; i < first.size(); ++i) slots_[slot_of(first[i])] = static_cast<std::int64_t>(i);
  }

  const Number* rows_;
  std::vector<std::int64_t> slots_;
};

}  // namespace

template <typename Number>
UniqueRows unique_rows(const Number* rows, std::size_t count) {
  RowTable<Number> table(rows);
  UniqueRows unique;
  unique.number.resize(count);
  for (std::size_t i = 0; i < count; ++i) unique.number[i] = table.number_of(i);
  struct Entry {
    std::array<Number, 3> row;
    std::int64_t number;
  };
  std::vector<Entry> sorted(table.first.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Number* row = rows + 3 * table.first[i];
    sorted[i] = {{row[0], row[1], row[2]}, static_cast<std::int64_t>(i)};
  }
  std::sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return is_less(a.row.data(), b.row.data()) || (!is_less(b.row.data(), a.row.data()) && a.number < b.number);
  });
  std::vector<std::int64_t> rank(sorted.size());
  unique.first.resize(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    rank[sorted[i].number] = static_cast<std::int64_t>(i);
    unique.first[i] = table.first[sorted[i].number];
  }
  for (std::int64_t& number : unique.number) number = rank[number];
  return unique;
}

template UniqueRows unique_rows<float>(const float*, std::size_t);
template UniqueRows unique_rows<double>(const double*, std::size_t);

}  // namespace trundle
