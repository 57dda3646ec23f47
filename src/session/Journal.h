// The path of every event of a running session: it gets its time, is folded by the engine and
// logged. An acknowledged event is on disk when its call returns, unless another process has locked
// the database. Then it waits, in order, for flush(), and until then nothing that acknowledges it
// may be shown (SessionControl::wait_while_held).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "apparatus/SessionClock.h"
#include "engine/Engine.h"
#include "record/stream/EventSink.h"

namespace heft {

class Journal {
 public:
  /// @param on_event called after every event
  Journal(Engine& engine, EventSink& sink, SessionClock& clock,
          std::function<void(const Engine&)> on_event)
      : engine_(engine), sink_(sink), clock_(clock), on_event_(std::move(on_event)) {}

  /// Logs an event at its own time, or at the last event's if that is later.
  /// @throws Error if the engine refuses it or the log cannot save it
  void emit(Event event, Durability durability);

  /// The same at the time of its admission.
  /// @return the reason if it is no longer possible; empty: it is folded and logged
  [[nodiscard]] std::string emit(const AdmittedEvent& admitted, Durability durability);

  /// Logs an acknowledged event at the current time.
  void emit_now(EventPayload what) { emit({now_s(), std::move(what)}, Durability::acknowledged); }

  /// Leaves the session so that it can be resumed: an open attempt becomes void and is repeated
  /// with the same draws.
  void leave(const std::string& why);

  void add_frame(const FrameRow& frame);
  void add_info(const std::string& key, const std::string& value);

  /// Writes buffered events. @return whether everything is on disk
  bool flush();
  /// The same if the last flush was a while ago.
  void flush_now_and_then();

  /// Set while another process locks the database and events wait: what could not be saved.
  const std::optional<LogBusy>& busy() const { return busy_; }

  /// Number of continuations after a pause.
  int n_continued() const { return n_continued_; }

  const Engine& engine() const { return engine_; }
  SessionClock& clock() { return clock_; }
  double now_s() const { return log_time(clock_.now_s()); }

 private:
  void keep(const Event& event, const Changes& changes, Durability durability);
  template <typename Write>
  void write(const Write& write);

  Engine& engine_;
  EventSink& sink_;
  SessionClock& clock_;
  std::function<void(const Engine&)> on_event_;
  std::optional<LogBusy> busy_;
  int n_continued_ = 0;
  double flushed_s_ = 0;
};

}  // namespace heft
