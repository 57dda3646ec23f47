// Where every event of a running session goes through: it is given its time, folded by the engine,
// and logged. An event that people wait for is on disk before its call returns.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apparatus/SessionClock.h"
#include "engine/Engine.h"
#include "record/EventSink.h"

namespace heft {

class Journal {
 public:
  /// @param told called after every event
  Journal(Engine& engine, EventSink& sink, SessionClock& clock,
          std::function<void(const Engine&)> told)
      : engine_(engine), sink_(sink), clock_(clock), told_(std::move(told)) {}

  /// Takes an event at its own time, or at that of the last event where that is later.
  /// @throws Error when the engine refuses it or the log can't save it
  void emit(Event event, Durability durability);

  /// The same, at the time that it was admitted with.
  void emit(const AdmittedEvent& admitted, Durability durability);

  /// An event of now, on disk when this returns.
  void emit_now(Happening what) { emit({now_s(), std::move(what)}, Durability::acknowledged); }

  /// Leaves the session so that it can be resumed: an open attempt is void and will run again with
  /// the same draws.
  void leave(const std::string& why);

  /// What waits in memory goes to disk where the last time was a while ago.
  void flush_now_and_then();

  const Engine& engine() const { return engine_; }
  EventSink& sink() { return sink_; }
  SessionClock& clock() { return clock_; }
  double now_s() const { return log_time(clock_.now_s()); }

 private:
  void keep(const Event& event, const Changes& changes, Durability durability);

  Engine& engine_;
  EventSink& sink_;
  SessionClock& clock_;
  std::function<void(const Engine&)> told_;
  double flushed_s_ = 0;
};

}  // namespace heft
