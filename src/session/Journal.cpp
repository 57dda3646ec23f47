#include "session/Journal.h"

#include <algorithm>

namespace heft {

namespace {
constexpr double flush_every_s = 1;
}  // namespace

void Journal::emit(Event event, Durability durability) {
  clock_.advance_to(event.t_s);
  event.t_s = std::max(event.t_s, engine_.last_s());
  keep(event, engine_.apply(event), durability);
}

void Journal::emit(const AdmittedEvent& admitted, Durability durability) {
  clock_.advance_to(admitted.event().t_s);
  keep(admitted.event(), engine_.apply(admitted), durability);
}

void Journal::keep(const Event& event, const Changes& changes, Durability durability) {
  sink_.append(event, changes, durability);
  told_(engine_);
}

void Journal::leave(const std::string& why) {
  if (engine_.trial_is_open()) emit_now(TrialVoided{std::string(void_interrupted)});
  if (engine_.state() != SessionState::paused) emit_now(SessionPaused{why});
}

void Journal::flush_now_and_then() {
  const double now_s = clock_.now_s();
  if (now_s - flushed_s_ < flush_every_s) return;
  sink_.flush();
  flushed_s_ = now_s;
}

}  // namespace heft
