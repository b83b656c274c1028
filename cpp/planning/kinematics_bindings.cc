#include "kinematics_bindings.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <utility>

#include "group_chain.h"
#include "link_tree.h"
#include "manipulability.h"
#include "pose_solver.h"
#include "state_check.h"
#include "tree_kinematics.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::planning {

namespace {

using Numbers = nb::ndarray<const double, nb::numpy, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Table = nb::ndarray<const double, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Whole = nb::ndarray<const std::int64_t, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

nb::object array_of(std::vector<double> numbers, std::vector<std::size_t> shape) {
  auto* kept = new std::vector<double>(std::move(numbers));
  const nb::capsule owner(kept, [](void* data) noexcept { delete static_cast<std::vector<double>*>(data); });
  return nb::cast(nb::ndarray<nb::numpy, double>(kept->data(), shape.size(), shape.data(), owner));
}

// Quaternion of a rotation, as x, y, z, w with w ≥ 0 (Shepperd).
void write_quaternion(const Rotation& r, double* out) {
  const double trace = r.m[0] + r.m[4] + r.m[8];
  double x, y, z, w;
  if (trace > 0.0) {
    const double s = 2.0 * std::sqrt(trace + 1.0);
    w = 0.25 * s, x = (r.m[7] - r.m[5]) / s, y = (r.m[2] - r.m[6]) / s, z = (r.m[3] - r.m[1]) / s;
  } else if (r.m[0] >= r.m[4] && r.m[0] >= r.m[8]) {
    const double s = 2.0 * std::sqrt(1.0 + r.m[0] - r.m[4] - r.m[8]);
    w = (r.m[7] - r.m[5]) / s, x = 0.25 * s, y = (r.m[1] + r.m[3]) / s, z = (r.m[2] + r.m[6]) / s;
  } else if (r.m[4] >= r.m[8]) {
    const double s = 2.0 * std::sqrt(1.0 + r.m[4] - r.m[0] - r.m[8]);
    w = (r.m[2] - r.m[6]) / s, x = (r.m[1] + r.m[3]) / s, y = 0.25 * s, z = (r.m[5] + r.m[7]) / s;
  } else {
    const double s = 2.0 * std::sqrt(1.0 + r.m[8] - r.m[0] - r.m[4]);
    w = (r.m[3] - r.m[1]) / s, x = (r.m[2] + r.m[6]) / s, y = (r.m[5] + r.m[7]) / s, z = 0.25 * s;
  }
  const double scale = std::copysign(1.0 / std::sqrt(x * x + y * y + z * z + w * w), w);
  out[0] = scale * x, out[1] = scale * y, out[2] = scale * z, out[3] = scale * w;
}

Rigid pose_of(const Numbers& row) {
  if (row.shape(0) != 7) throw nb::value_error("a pose is x, y, z, qx, qy, qz, qw");
  for (std::size_t i = 0; i < 7; ++i)
    if (!std::isfinite(row(i))) throw nb::value_error("a pose is finite");
  const double* at = row.data();
  if (!(at[3] * at[3] + at[4] * at[4] + at[5] * at[5] + at[6] * at[6] > 1e-12))
    throw nb::value_error("the quaternion of a pose is not zero");
  return rigid_of(at);
}

// Rows of `joints`: kind, parent link, variable, leading variable. Rows of `numbers`: origin as a pose, axis,
// multiplier, offset.
LinkTree tree_of(const Whole& joints, const Table& numbers) {
  if (joints.shape(1) != 4 || numbers.shape(1) != 12 || joints.shape(0) != numbers.shape(0))
    throw nb::value_error("joints are (n, 4), numbers (n, 12)");
  std::vector<TreeJoint> made(joints.shape(0));
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double* at = numbers.data() + 12 * i;
    if (joints(i, 0) < 0 || joints(i, 0) > static_cast<int>(JointKind::kFloating))
      throw nb::value_error("no such kind");
    made[i] = {static_cast<JointKind>(joints(i, 0)),
               static_cast<int>(joints(i, 1)),
               static_cast<int>(joints(i, 2)),
               rigid_of(at),
               {at[7], at[8], at[9]},
               static_cast<int>(joints(i, 3)),
               at[10],
               at[11]};
  }
  return LinkTree(std::move(made));
}

// (states, links, 7)
nb::object link_poses(const TreeKinematics& kinematics, const Table& states) {
  if (states.shape(1) != kinematics.variables()) throw nb::value_error("a state holds every variable");
  const std::size_t count = states.shape(0), links = kinematics.tree().size();
  std::vector<double> rows(count * links * 7);
  {
    const nb::gil_scoped_release unlocked;
    std::vector<Rigid> poses;
    for (std::size_t i = 0; i < count; ++i) {
      kinematics.tree().compute({states.data() + i * kinematics.variables(), kinematics.variables()}, poses);
      for (std::size_t k = 0; k < links; ++k) {
        double* row = rows.data() + 7 * (i * links + k);
        row[0] = poses[k].p.x, row[1] = poses[k].p.y, row[2] = poses[k].p.z;
        write_quaternion(poses[k].r, row + 3);
      }
    }
  }
  return array_of(std::move(rows), {count, links, 7});
}

class GroupKinematics {
 public:
  GroupKinematics(const TreeKinematics& kinematics, int link, const Numbers& tip, const Whole& columns,
                  const Table& limits)
      : tree_(kinematics.tree()),
        variables_(kinematics.variables()),
        group_(make(kinematics, link, pose_of(tip), columns, limits)),
        solver_(group_.chain, {}) {}

  void configure(bool position_only, double epsilon, int type, std::uint64_t seed) {
    if (!(epsilon > 0.0)) throw nb::value_error("epsilon is positive");
    solver_ = PoseSolver(group_.chain, {position_only, epsilon, static_cast<SolveType>(type), seed});
  }

  nb::object jacobian(const Numbers& state) const {
    check(state);
    const std::size_t n = group_.chain.size();
    std::vector<double> rows(6 * n);
    {
      const nb::gil_scoped_release unlocked;
      const std::span<const double> values(state.data(), variables_);
      std::vector<double> columns(n);
      for (std::size_t i = 0; i < n; ++i)
        columns[i] = values[static_cast<std::size_t>(group_.chain.columns()[i].variable)];
      std::array<double, kMaxChainJoints> held{};
      group_.chain.hold(values, held);
      JointChain::Pose pose;
      group_.chain.place(columns.data(), held.data(), pose);
      group_.chain.jacobian(pose, rows.data());
      const Rotation base = base_pose(values).r;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t part = 0; part < 2; ++part) {
          double* at = rows.data() + 3 * part * n + i;
          const Vec3 turned = base * Vec3{at[0], at[n], at[2 * n]};
          at[0] = turned.x, at[n] = turned.y, at[2 * n] = turned.z;
        }
    }
    return array_of(std::move(rows), {6, n});
  }

  PoseSolution solve(const Numbers& target, const Numbers& state, std::int64_t iterations, const Numbers& tolerances,
                     const nb::object& check_state) const {
    check(state);
    if (tolerances.shape(0) != 0 && tolerances.shape(0) != group_.chain.size())
      throw nb::value_error("a tolerance for each variable of the group");
    const std::span<const double> values(state.data(), variables_);
    PoseRequest request{pose_of(target), values, iterations, {tolerances.data(), tolerances.shape(0)}, nullptr};
    StateCheck* native = nullptr;
    PythonCheck python(check_state, variables_);
    if (!check_state.is_none()) request.check = nb::try_cast(check_state, native) ? native : &python;
    PoseSolution solution;
    {
      const nb::gil_scoped_release unlocked;
      request.target = inverse(base_pose(values)) * request.target;
      solution = solver_.solve(request);
    }
    python.raise();
    return solution;
  }

 private:
  // Asks a Python function; its first exception ends the search.
  class PythonCheck : public StateCheck {
   public:
    PythonCheck(const nb::object& function, std::size_t variables) : function_(function), variables_(variables) {}

    bool is_valid(const double* state) override {
      if (error_) return true;
      const nb::gil_scoped_acquire locked;
      try {
        return nb::cast<bool>(function_(array_of({state, state + variables_}, {variables_})));
      } catch (...) {
        error_ = std::current_exception();
        return true;
      }
    }

    void raise() const {
      if (error_) std::rethrow_exception(error_);
    }

   private:
    const nb::object& function_;
    std::size_t variables_;
    std::exception_ptr error_;
  };

  static GroupChain make(const TreeKinematics& kinematics, int link, const Rigid& tip, const Whole& columns,
                         const Table& limits) {
    if (link < 0 || static_cast<std::size_t>(link) >= kinematics.tree().size()) throw nb::value_error("no such link");
    if (columns.shape(1) != 3 || limits.shape(1) != 2 || columns.shape(0) != limits.shape(0))
      throw nb::value_error("columns are (n, 3), limits (n, 2)");
    std::vector<ChainColumn> made(columns.shape(0));
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (columns(i, 0) < 0 || static_cast<std::size_t>(columns(i, 0)) >= kinematics.variables())
        throw nb::value_error("no such variable");
      made[i] = {static_cast<int>(columns(i, 0)), limits(i, 0), limits(i, 1), columns(i, 1) != 0, columns(i, 2) != 0};
    }
    return group_chain(kinematics.tree(), link, tip, std::move(made));
  }

  void check(const Numbers& state) const {
    if (state.shape(0) != variables_) throw nb::value_error("a state holds every variable");
  }

  Rigid base_pose(std::span<const double> state) const {
    if (group_.is_base_fixed) return group_.base_pose;
    std::vector<Rigid> poses;
    tree_.compute(state, poses);
    return group_.base < 0 ? Rigid{} : poses[static_cast<std::size_t>(group_.base)];
  }

  LinkTree tree_;
  std::size_t variables_;
  GroupChain group_;
  PoseSolver solver_;
};

nb::object ratio_of(const Table& jacobian) {
  if (jacobian.shape(0) > 6) throw nb::value_error("at most six rows");
  const auto [volume, ratio] = manipulability(jacobian.data(), jacobian.shape(1), jacobian.shape(0));
  return nb::make_tuple(volume, ratio);
}

}  // namespace

void bind_kinematics(nb::module_& module) {
  nb::class_<StateCheck>(module, "StateCheck");
  nb::class_<PoseSolution>(module, "PoseSolution")
      .def_ro("is_found", &PoseSolution::is_found)
      .def_prop_ro("columns", [](const PoseSolution& self) { return array_of(self.columns, {self.columns.size()}); })
      .def_ro("position_error", &PoseSolution::position_error)
      .def_ro("rotation_error", &PoseSolution::rotation_error)
      .def_ro("iterations", &PoseSolution::iterations)
      .def_ro("attempts", &PoseSolution::attempts)
      .def_ro("refused", &PoseSolution::refused);
  nb::class_<TreeKinematics>(module, "TreeKinematics")
      .def(
          "__init__",
          [](TreeKinematics* self, const Whole& joints, const Table& numbers) {
            new (self) TreeKinematics(tree_of(joints, numbers));
          },
          "joints"_a, "numbers"_a)
      .def("link_poses", link_poses, "states"_a);
  nb::class_<GroupKinematics>(module, "GroupKinematics")
      .def(nb::init<const TreeKinematics&, int, const Numbers&, const Whole&, const Table&>(), "kinematics"_a, "link"_a,
           "tip"_a, "columns"_a, "limits"_a)
      .def("configure", &GroupKinematics::configure, "position_only"_a, "epsilon"_a, "solve_type"_a, "seed"_a)
      .def("jacobian", &GroupKinematics::jacobian, "state"_a)
      .def("solve", &GroupKinematics::solve, "target"_a, "state"_a, "iterations"_a, "tolerances"_a, "check"_a.none());
  module.def("manipulability", &ratio_of, "jacobian"_a);
}

}  // namespace trundle::planning
