// The Python module `_contact_laws`: contact laws that MuJoCo lacks, applied between collision detection and the
// solver, the recording of contacts, and the commands of motors.
//
// MuJoCo calls them by mjcb_control in every step of every model; a model without tables costs a comparison.
// mjcb_sensor runs after the solver. Callbacks that were installed before are called first.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_offset.h"
#include "friction_pyramid.h"
#include "friction_slip.h"
#include "grazing.h"
#include "joint_stop.h"
#include "law_tables.h"
#include "midpoint.h"
#include "motor_bindings.h"
#include "mujoco_api.h"
#include "plain_metric.h"
#include "plane_cylinder.h"
#include "restitution.h"
#include "row_stepper.h"
#include "stepping.h"
#include "surface_motion.h"
#include "tunnelling.h"
#include "velocity_damping.h"
#include "velocity_motor.h"

namespace nb = nanobind;

namespace trundle {

MujocoApi mujoco;

namespace {

std::atomic<mjfGeneric> previous = nullptr;
std::atomic<mjfSensor> previous_sensor = nullptr;

// Grazing contacts, friction directions, surface motion and slip; return whether the constraints must be rebuilt.
bool turn_friction(const LawTables& laws, const mjModel* m, mjData* d) {
  const bool grazes = release_grazing(m, d);
  align_friction(laws, m, d);
  move_surfaces(laws, m, d);
  return release_slipping(laws, m, d) || grazes;
}

void rebuild_constraints(const mjModel* m, mjData* d) {
  mujoco.mj_makeConstraint(m, d);
  mujoco.mj_island(m, d);
  mujoco.mj_projectConstraint(m, d);
}

void apply_laws(const LawTables& laws, const mjModel* m, mjData* d) {
  update_midpoints(laws, m, d);
  const bool changed = turn_friction(laws, m, d);
  if (changed) rebuild_constraints(m, d);
  const bool bounced = !laws.restitution.empty() && apply_restitution(laws, m, d);
  if (bounced || changed) mujoco.mj_fwdVelocity(m, d);
  resist_slip(laws, m, d);
  apply_damping(laws, m, d);
  apply_compliance(laws, m, d);
  hold_sliding(laws, m, d);
  shape_pyramids(laws, m, d);
  approach_stops(m, d);
}

// Apply the laws to a state that is evaluated, not stepped; laws that act over a step are left out.
void apply_static_laws(const LawTables& laws, const mjModel* m, mjData* d) {
  if (turn_friction(laws, m, d)) {
    rebuild_constraints(m, d);
    mujoco.mj_fwdVelocity(m, d);
  }
  resist_slip(laws, m, d);
  apply_compliance(laws, m, d);
  shape_pyramids(laws, m, d);
  approach_stops(m, d);
}

thread_local bool busy = false;  // a previous callback may call this one

void on_control(const mjModel* m, mjData* d) {
  if (busy) return;
  busy = true;
  if (const mjfGeneric first = previous.load()) first(m, d);
  LawTables laws;
  if (LawTables::find(m, laws)) {
    if (laws.on) apply_laws(laws, m, d);
    else if (laws.evaluates) apply_static_laws(laws, m, d);
    add_springs(laws, d);
    apply_midpoint_bias(laws, m, d);
    drive_motors(laws, m, d);
    update_ccd(laws, m, d);
    if (laws.on) use_plain_metric(m, d);
  }
  busy = false;
}

void on_sensor(const mjModel* m, mjData* d, int stage) {
  if (busy) return;
  busy = true;
  if (const mjfSensor first = previous_sensor.load()) first(m, d, stage);
  LawTables laws;
  if (stage == mjSTAGE_ACC && LawTables::find(m, laws) && (laws.on || laws.evaluates)) record_loads(laws, m, d);
  busy = false;
}

// Install the callbacks; those installed before are called first.
void install() {
  busy = false;  // an exception may have left the flag set
  if (*mujoco.control != on_control) {
    previous = *mujoco.control;
    *mujoco.control = on_control;
  }
  if (*mujoco.sensor != on_sensor) {
    previous_sensor = *mujoco.sensor;
    *mujoco.sensor = on_sensor;
  }
}

std::vector<std::string> names() {
  std::vector<std::string> result{"mjCOLLISIONFUNC", "mjcb_control", "mjcb_sensor", "mjcb_time"};
#define TRUNDLE_NAME(name) result.push_back(#name);
  TRUNDLE_MUJOCO_FUNCTIONS(TRUNDLE_NAME)
#undef TRUNDLE_NAME
  return result;
}

void bind(const std::vector<std::uintptr_t>& addresses) {
  if (addresses.size() != names().size()) throw std::invalid_argument("one address for each name of names()");
  const std::uintptr_t* next = addresses.data();
  install_plane_cylinder(reinterpret_cast<mjfCollision(*)[mjNGEOMTYPES]>(*next++));
  mujoco.control = reinterpret_cast<mjfGeneric*>(*next++);
  mujoco.sensor = reinterpret_cast<mjfSensor*>(*next++);
  mujoco.time = reinterpret_cast<mjfTime*>(*next++);
  *mujoco.time = nullptr;  // profiling reads the clock some thirty times a step, 1/15 of a small robot's step
#define TRUNDLE_BIND(name) mujoco.name = reinterpret_cast<decltype(mujoco.name)>(*next++);
  TRUNDLE_MUJOCO_FUNCTIONS(TRUNDLE_BIND)
#undef TRUNDLE_BIND
}

mjtNum steady_s() { return std::chrono::duration<mjtNum>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void set_timers(bool on) { *mujoco.time = on ? steady_s : nullptr; }

const mjModel* model_at(std::uintptr_t address) { return reinterpret_cast<const mjModel*>(address); }
mjData* data_at(std::uintptr_t address) { return reinterpret_cast<mjData*>(address); }

void report(std::uintptr_t model, std::uintptr_t data) {
  LawTables laws;
  if (!LawTables::find(model_at(model), laws)) throw std::invalid_argument("this model has no laws");
  report_efforts(laws, model_at(model), data_at(data));
}

constexpr std::size_t kRowNumbers = sizeof(ContactRow) / sizeof(double);

using Rows = nb::ndarray<const double, nb::shape<-1, kRowNumbers>, nb::c_contig, nb::device::cpu>;

// New array (rows, kRowNumbers).
nb::object array_of(const std::vector<ContactRow>& rows) {
  double* numbers = new double[rows.size() * kRowNumbers];
  if (!rows.empty()) std::memcpy(numbers, rows.data(), rows.size() * sizeof(ContactRow));
  nb::capsule owner(numbers, [](void* memory) noexcept { delete[] static_cast<double*>(memory); });
  return nb::cast(nb::ndarray<nb::numpy, double>(numbers, {rows.size(), kRowNumbers}, owner));
}

std::vector<ContactRow> rows_of(const Rows& array) {
  std::vector<ContactRow> rows(array.shape(0));
  if (!rows.empty()) std::memcpy(rows.data(), array.data(), rows.size() * sizeof(ContactRow));
  return rows;
}

nb::object read_contacts(std::uintptr_t model, std::uintptr_t data, const std::vector<int>& contacts) {
  std::vector<ContactRow> rows;
  for (const int contact : contacts) {
    if (contact < 0 || contact >= data_at(data)->ncon) throw std::invalid_argument("no such contact");
    rows.push_back(read_contact(model_at(model), data_at(data), contact));
  }
  return array_of(rows);
}

// Times of the rows [ns], and all rows; the recorder is empty afterwards.
std::pair<std::vector<std::int64_t>, nb::object> take_rows(ContactRecorder& recorder) {
  std::vector<std::int64_t> times_ns;
  std::vector<ContactRow> rows;
  for (const RecordedStep& step : recorder.steps()) {
    times_ns.insert(times_ns.end(), step.rows.size(), step.time_ns);
    rows.insert(rows.end(), step.rows.begin(), step.rows.end());
  }
  recorder.clear();
  return {times_ns, array_of(rows)};
}

std::pair<int, bool> step(std::uintptr_t model, std::uintptr_t data, int count,
                          const std::vector<ContactRecorder*>& recorders, const std::vector<StepAction*>& actions,
                          bool acts_first, std::int64_t time_ns, std::int64_t step_ns) {
  const StepHooks hooks{recorders, actions, acts_first, time_ns, step_ns};
  const nb::gil_scoped_release release;
  const Stepped stepped = step_with_hooks(model_at(model), data_at(data), count, hooks);
  return {stepped.count, stepped.goes_on};
}

void bind_stepping(nb::module_& module) {
  nb::class_<ContactRecorder>(module, "ContactRecorder")
      .def(nb::init<const std::vector<int>&, int, std::size_t>(), nb::arg("geoms"), nb::arg("geom_count"),
           nb::arg("max_steps"))
      .def_prop_ro("is_stale", &ContactRecorder::is_stale)
      .def("set_sleeping", [](ContactRecorder& self, const Rows& rows) { self.set_sleeping(rows_of(rows)); })
      .def("replace_since", [](ContactRecorder& self, std::int64_t time_ns,
                               const Rows& rows) { self.replace_since(time_ns, rows_of(rows)); })
      .def("take", take_rows)
      .def("copy", [](const ContactRecorder& self) { return ContactRecorder(self); });
  module.def("read_contacts", read_contacts, nb::arg("model"), nb::arg("data"), nb::arg("contacts"));
  nb::class_<StepAction>(module, "StepAction").def("checkpoint", [](nb::handle_t<StepAction> self) {
    return nb::cpp_function(
        [owner = nb::borrow(self), restore = nb::cast<StepAction&>(self).checkpoint()] { restore(); });
  });
  module.def("step", step, nb::arg("model"), nb::arg("data"), nb::arg("count"), nb::arg("recorders"),
             nb::arg("actions"), nb::arg("acts_first"), nb::arg("time_ns"), nb::arg("step_ns"));
}

using Addresses = std::vector<std::pair<std::uintptr_t, std::uintptr_t>>;
template <typename Value>
using Array = nb::ndarray<Value, nb::c_contig, nb::device::cpu>;

RowStepper make_row_stepper(const Addresses& workers, std::vector<int> links, double max_speed, bool always_actuated) {
  std::vector<std::pair<mjModel*, mjData*>> result;
  for (const auto [model, data] : workers) {
    LawTables laws;
    if (!LawTables::find(model_at(model), laws)) throw std::invalid_argument("this model has no laws");
    result.emplace_back(const_cast<mjModel*>(model_at(model)), data_at(data));
  }
  return {std::move(result), std::move(links), max_speed, always_actuated};
}

void step_rows(const RowStepper& stepper, const Array<const bool>& chosen, const Array<double>& states,
               const Array<const double>& max_efforts, const Array<const double>& rates, const Array<bool>& unstable,
               const Array<double>& poses, const Array<double>& twists, int steps) {
  const std::size_t count = chosen.size();
  const WorldRows rows{count,        chosen.data(),   states.data(), max_efforts.data(),
                       rates.data(), unstable.data(), poses.data(),  twists.data()};
  for (const std::size_t length :
       {states.shape(0), max_efforts.shape(0), rates.shape(0), unstable.shape(0), poses.shape(0), twists.shape(0)})
    if (length != count) throw std::invalid_argument("every array has one row for each world");
  const nb::gil_scoped_release release;
  stepper.step(rows, steps);
}

}  // namespace

}  // namespace trundle

NB_MODULE(_contact_laws, module) {
  module.attr("VERSION") = mjVERSION_HEADER;
  module.def("names", trundle::names);
  module.def("bind", trundle::bind, nb::arg("addresses"));
  module.def("install", trundle::install);
  module.def("set_timers", trundle::set_timers, nb::arg("on"));
  nb::class_<trundle::RowStepper>(module, "RowStepper")
      .def("step", trundle::step_rows, nb::arg("chosen").noconvert(), nb::arg("states").noconvert(),
           nb::arg("max_efforts").noconvert(), nb::arg("rates").noconvert(), nb::arg("unstable").noconvert(),
           nb::arg("poses").noconvert(), nb::arg("twists").noconvert(), nb::arg("steps"));
  module.def("make_row_stepper", trundle::make_row_stepper, nb::arg("workers"), nb::arg("links"), nb::arg("max_speed"),
             nb::arg("always_actuated"));
  module.def("report_efforts", trundle::report, nb::arg("model"), nb::arg("data"));
  trundle::bind_stepping(module);
  trundle::bind_motors(module);
}
