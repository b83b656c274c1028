#include "guarded_step.h"

#include <csetjmp>
#include <cstring>
#include <stdexcept>

namespace trundle {

namespace {

// MuJoCo is C: no exception may propagate through it.
thread_local std::jmp_buf escape;
thread_local char failure[sizeof(mjLogMessage::subject)];

void on_message(const mjLogMessage* message) {
  if (message->level < mjLOG_ERROR) return;  // mjData counts warnings
  std::memcpy(failure, message->subject, sizeof(failure));
  std::longjmp(escape, 1);
}

}  // namespace

void guarded_step(const mjModel* m, mjData* d) {
  static thread_local mjfLogHandler outer;
  outer = mujoco._mjPRIVATE_setTlsLogHandler(on_message);
  const bool failed = setjmp(escape) != 0;
  if (!failed) mujoco.mj_step(m, d);
  mujoco._mjPRIVATE_setTlsLogHandler(outer);
  if (failed) throw std::runtime_error(failure);
}

}  // namespace trundle
