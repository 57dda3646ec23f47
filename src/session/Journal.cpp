#include "session/Journal.h"

#include <algorithm>

namespace heft {

namespace {
constexpr double flush_every_s = 1;
}  // namespace

void Journal::emit(Event event, Durability durability) {
  clock_.advance_to(event.t_s);
  event.t_s = std::max(event.t_s, engine_.last_s());
  const Changes changes = engine_.apply(event);
  sink_.append(event, changes, durability);
  told_(engine_);
}

void Journal::emit_now(EventKind kind, std::string detail, std::optional<double> value) {
  Event event;
  event.t_s = now_s();
  event.kind = kind;
  event.detail = std::move(detail);
  event.value = value;
  emit(event, Durability::acknowledged);
}

void Journal::leave(const std::string& why) {
  if (engine_.trial_is_open()) emit_now(EventKind::voided, std::string(void_interrupted));
  if (engine_.state() != SessionState::paused) emit_now(EventKind::paused, why);
}

void Journal::flush_now_and_then() {
  const double now_s = clock_.now_s();
  if (now_s - flushed_s_ < flush_every_s) return;
  sink_.flush();
  flushed_s_ = now_s;
}

}  // namespace heft
