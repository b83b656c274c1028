#include "law_tables.h"

namespace trundle {

namespace {

constexpr double kMagic = 7.2751;  // marks models that have tables
constexpr int kTables = 10;

template <typename Row>
std::span<const Row> table(const mjModel* m, int number) {
  const auto* rows = reinterpret_cast<const Row*>(m->numeric_data + m->numeric_adr[number]);
  return {rows, static_cast<std::size_t>(m->numeric_size[number]) * sizeof(double) / sizeof(Row)};
}

}  // namespace

bool LawTables::find(const mjModel* m, LawTables& tables) {
  if (m->nnumeric != kTables) return false;
  // Magic, on, moving surfaces, equality, chains, springs, groups, stepped data, threshold speed of tunnelling, two
  // frictions without pairs.
  const double* head = m->numeric_data + m->numeric_adr[0];
  if (head[0] != kMagic) return false;
  tables = {table<RestitutionRow>(m, 1),
            table<FrictionRow>(m, 2),
            table<DampingRow>(m, 3),
            table<MotionRow>(m, 4),
            table<MotorRow>(m, 5),
            table<ChainRow>(m, 6).first(static_cast<std::size_t>(head[4])),
            table<SpringRow>(m, 7).first(static_cast<std::size_t>(head[5])),
            table<ComplianceRow>(m, 8),
            table<GeomRow>(m, 9),
            static_cast<int>(head[6]),
            static_cast<int>(head[3]),
            static_cast<std::uintptr_t>(head[7]),
            head[9] > 0.0,
            head[8],
            head[1] > 0.0,
            head[1] < 0.0,
            head[2] > 0.0};
  return true;
}

}  // namespace trundle
