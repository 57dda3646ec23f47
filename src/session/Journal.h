// Where every event of a running session goes through: it is given its time, folded by the engine,
// and logged. An acknowledged event is on disk when its call returns, unless another process has
// locked the database: then it waits, in order, until flush() can write it, and until then nothing
// may be shown that acknowledges it (SessionControl::wait_while_held).
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
  /// @param told called after every event
  Journal(Engine& engine, EventSink& sink, SessionClock& clock,
          std::function<void(const Engine&)> told)
      : engine_(engine), sink_(sink), clock_(clock), told_(std::move(told)) {}

  /// Takes an event at its own time, or at that of the last event where that is later.
  /// @throws Error when the engine refuses it or the log can't save it
  void emit(Event event, Durability durability);

  /// The same, at the time that it was admitted with.
  /// @return why it can't come any more; empty: it is folded and logged
  [[nodiscard]] std::string emit(const AdmittedEvent& admitted, Durability durability);

  /// An event of now, acknowledged.
  void emit_now(EventPayload what) { emit({now_s(), std::move(what)}, Durability::acknowledged); }

  /// Leaves the session so that it can be resumed: an open attempt is void and will run again with
  /// the same draws.
  void leave(const std::string& why);

  void add_frame(const FrameRow& frame);
  void add_info(const std::string& key, const std::string& value);

  /// Writes what waits in memory. @return whether everything is on disk
  bool flush();
  /// The same where the last time was a while ago.
  void flush_now_and_then();

  /// Set while another process locks the database and events wait for it: what could not be saved.
  const std::optional<LogBusy>& busy() const { return busy_; }

  /// How often the session went on after a pause.
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
  std::function<void(const Engine&)> told_;
  std::optional<LogBusy> busy_;
  int n_continued_ = 0;
  double flushed_s_ = 0;
};

}  // namespace heft
