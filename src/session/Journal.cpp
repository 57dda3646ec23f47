#include "session/Journal.h"

#include <algorithm>

#include "base/Clock.h"

namespace heft {

namespace {
constexpr double flush_every_s = 1;
constexpr std::string_view log_is_locked = "the log is locked by another program";
}  // namespace

// What the log has kept for later is written when it can be. While that is awaited, more may come.
template <typename Write>
void Journal::write(const Write& write) {
  try {
    write();
  } catch (const LogBusy& why) {
    if (!wait_for_log_) throw;
    if (!is_standing_still_) stand_still(why);
  }
}

void Journal::stand_still(const LogBusy& why) {
  const bool pauses = clock_.is_wall() && engine_.state() == SessionState::running;
  const double since_s = monotonic_s();
  is_standing_still_ = true;
  if (pauses) emit_now(SessionPaused{std::string(log_is_locked)});
  for (double waited_s = 0; !writes_again(); waited_s = monotonic_s() - since_s)
    if (!wait_for_log_(waited_s)) {
      is_standing_still_ = false;
      throw LogBusy(why);
    }
  is_standing_still_ = false;
  if (pauses && engine_.state() == SessionState::paused) emit_now(SessionContinued{});
}

bool Journal::writes_again() {
  try {
    sink_.flush();
    return true;
  } catch (const LogBusy&) {
    return false;
  }
}

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
  if (event.as<SessionContinued>()) ++n_continued_;
  write([&] { sink_.append(event, changes, durability); });
  told_(engine_);
}

void Journal::leave(const std::string& why) {
  if (engine_.trial_is_open()) emit_now(TrialVoided{std::string(void_interrupted)});
  if (engine_.state() != SessionState::paused) emit_now(SessionPaused{why});
}

void Journal::add_frame(const FrameRow& frame) {
  write([&] { sink_.add_frame(frame); });
}

void Journal::add_info(const std::string& key, const std::string& value) {
  bool is_written = false;
  while (!is_written)
    write([&] {
      sink_.add_info(key, value);
      is_written = true;
    });
}

void Journal::flush() {
  write([&] { sink_.flush(); });
  flushed_s_ = clock_.now_s();
}

void Journal::flush_now_and_then() {
  if (clock_.now_s() - flushed_s_ >= flush_every_s) flush();
}

}  // namespace heft
