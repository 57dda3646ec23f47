// Where every event of a running session goes through: it is given its time, folded by the engine,
// and logged. An event that people wait for is on disk before its call returns; while another
// program keeps the log locked, the session is paused and the call waits.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "apparatus/SessionClock.h"
#include "engine/Engine.h"
#include "record/EventSink.h"

namespace heft {

class Journal {
 public:
  /// Waits a little while the log is locked. @param waited_s so far; 0: it has just been found out
  /// @return false: the session can't wait any longer
  using WaitForLog = std::function<bool(double waited_s)>;

  /// @param told called after every event
  Journal(Engine& engine, EventSink& sink, SessionClock& clock,
          std::function<void(const Engine&)> told)
      : engine_(engine), sink_(sink), clock_(clock), told_(std::move(told)) {}

  /// What is done while the log is locked; without it the first LogBusy is thrown.
  void while_locked(WaitForLog wait) { wait_for_log_ = std::move(wait); }

  /// Takes an event at its own time, or at that of the last event where that is later.
  /// @throws Error when the engine refuses it or the log can't save it
  void emit(Event event, Durability durability);

  /// The same, at the time that it was admitted with.
  void emit(const AdmittedEvent& admitted, Durability durability);

  /// An event of now, on disk when this returns.
  void emit_now(EventPayload what) { emit({now_s(), std::move(what)}, Durability::acknowledged); }

  /// Leaves the session so that it can be resumed: an open attempt is void and will run again with
  /// the same draws.
  void leave(const std::string& why);

  void add_frame(const FrameRow& frame);
  void add_info(const std::string& key, const std::string& value);

  /// What waits in memory goes to disk.
  void flush();
  /// The same where the last time was a while ago.
  void flush_now_and_then();

  /// How often the session went on after a pause.
  int n_continued() const { return n_continued_; }

  const Engine& engine() const { return engine_; }
  SessionClock& clock() { return clock_; }
  double now_s() const { return log_time(clock_.now_s()); }

 private:
  void keep(const Event& event, const Changes& changes, Durability durability);
  template <typename Write>
  void write(const Write& write);
  void stand_still(const LogBusy& why);
  bool writes_again();

  Engine& engine_;
  EventSink& sink_;
  SessionClock& clock_;
  std::function<void(const Engine&)> told_;
  WaitForLog wait_for_log_;
  bool is_standing_still_ = false;
  int n_continued_ = 0;
  double flushed_s_ = 0;
};

}  // namespace heft
