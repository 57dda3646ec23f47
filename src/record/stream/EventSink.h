// Where a session's events and frames go: a log on disk (SessionLog) or memory (RecordedSession).
// The runner writes to either and can't tell which.
#pragma once

#include <string>

#include "base/Error.h"
#include "experiment/Event.h"
#include "experiment/Rows.h"

namespace heft {

/// acknowledged: committed to disk when append() returns, before the screen changes. buffered: in
/// order, with the next acknowledged event or within a second. A sink in memory keeps both alike.
enum class Durability { acknowledged, buffered };

/// Another process has locked the database. Nothing is lost: what was given is kept and written, in
/// its order, by the first call that can write.
class LogBusy : public Error {
 public:
  using Error::Error;
};

class EventSink {
 public:
  virtual ~EventSink() = default;

  /// Takes an event and all it changes, together or not at all.
  /// @throws Error when it could not be saved: what, why (disk full, ...), what to do; LogBusy when
  ///   it could not be saved yet
  virtual void append(const Event& event, const Changes& changes, Durability durability) = 0;

  /// Takes a displayed frame; frames keep their order among the events.
  virtual void add_frame(const FrameRow& frame) = 0;

  /// What the participant said about themselves (table participant_info); acknowledged.
  /// @throws Error as append()
  virtual void add_info(const std::string& key, const std::string& value) = 0;

  /// Puts everything taken so far where it stays.
  virtual void flush() = 0;
};

}  // namespace heft
