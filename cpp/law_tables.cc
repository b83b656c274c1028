#include "law_tables.h"

namespace trundle {

namespace {

constexpr double kMagic = 7.2751;  // no number that another model begins with
constexpr int kTables = 10;

template <typename Row>
std::span<const Row> table(const mjModel* m, int number) {
  const auto* rows = reinterpret_cast<const Row*>(m->numeric_data + m->numeric_adr[number]);
  return {rows, static_cast<std::size_t>(m->numeric_size[number]) * sizeof(double) / sizeof(Row)};
}

}  // namespace

bool LawTables::find(const mjModel* m, const mjData* d, LawTables& found) {
  if (m->nnumeric != kTables) return false;
  const double* head = m->numeric_data + m->numeric_adr[0];  // magic, on, moving surfaces, marks, equality, chains, springs
  if (head[0] != kMagic) return false;
  found = {table<RestitutionRow>(m, 1),
           table<DirectionRow>(m, 2),
           table<DampingRow>(m, 3),
           table<GeomRow>(m, 4),
           table<MotionRow>(m, 5),
           table<MotorRow>(m, 6),
           table<ChainRow>(m, 7).first(static_cast<std::size_t>(head[5])),
           table<SpringRow>(m, 8).first(static_cast<std::size_t>(head[6])),
           table<DeadZoneRow>(m, 9),
           static_cast<int>(head[3]),
           static_cast<int>(head[4]),
           head[1] > 0.0,
           head[2] > 0.0,
           d->userdata[0] > 0.0};
  return true;
}

}  // namespace trundle
