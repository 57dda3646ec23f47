#include "session/Journal.h"

#include <algorithm>

namespace heft {

namespace {
constexpr double flush_every_s = 1;
}  // namespace

// Calls `write`; a busy log buffers what it could not write, in order.
template <typename Write>
void Journal::write(const Write& write) {
  try {
    write();
  } catch (const LogBusy& why) {
    if (!busy_) busy_ = why;
  }
}

void Journal::emit(Event event, Durability durability) {
  clock_.advance_to(event.t_s);
  event.t_s = std::max(event.t_s, engine_.last_s());
  keep(event, engine_.apply(event), durability);
}

std::string Journal::emit(const AdmittedEvent& admitted, Durability durability) {
  const Applied applied = engine_.apply(admitted);
  if (!applied.changes) return applied.refusal;
  clock_.advance_to(admitted.event().t_s);
  keep(admitted.event(), *applied.changes, durability);
  return {};
}

void Journal::keep(const Event& event, const Changes& changes, Durability durability) {
  if (event.is<SessionContinued>()) ++n_continued_;
  write([&] { sink_.append(event, changes, durability); });
  on_event_(engine_);
}

void Journal::leave(const std::string& why) {
  if (engine_.trial_is_open()) emit_now(TrialVoided{std::string(void_interrupted)});
  if (engine_.state() != SessionState::paused) emit_now(SessionPaused{why});
}

void Journal::add_frame(const FrameRow& frame) {
  write([&] { sink_.add_frame(frame); });
}

void Journal::add_info(const std::string& key, const std::string& value) {
  write([&] { sink_.add_info(key, value); });
}

bool Journal::flush() {
  busy_.reset();
  write([&] { sink_.flush(); });
  flushed_s_ = clock_.now_s();
  return !busy_;
}

void Journal::flush_now_and_then() {
  if (clock_.now_s() - flushed_s_ >= flush_every_s) flush();
}

}  // namespace heft
