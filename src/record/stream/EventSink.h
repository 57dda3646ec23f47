// Where a session's events and frames go: a log on disk (SessionLog) or memory (RecordedSession).
// The runner writes to either and can't tell which.
// A session kept in memory: everything a log would hold of it, in order, as a value. Worker threads
// record into it; SessionArchive stores it.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/Error.h"
#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "record/schema/SessionHeader.h"

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

struct RecordedEvent {
  Event event;
  Changes changes;
};

/// An event with what it changes, or a displayed frame.
using RecordedEntry = std::variant<RecordedEvent, FrameRow>;

class RecordedSession final : public EventSink {
 public:
  explicit RecordedSession(SessionHeader header) : header_(std::move(header)) {}

  void append(const Event& event, const Changes& changes, Durability) override {
    entries_.emplace_back(std::in_place_type<RecordedEvent>, event, changes);
  }
  void add_frame(const FrameRow& frame) override { entries_.push_back(frame); }
  void add_info(const std::string& key, const std::string& value) override {
    header_.participant_info[key] = value;
  }
  void flush() override {}

  const SessionHeader& header() const { return header_; }
  /// Events and frames in the order they came.
  const std::vector<RecordedEntry>& entries() const { return entries_; }

 private:
  SessionHeader header_;
  std::vector<RecordedEntry> entries_;
};

}  // namespace heft
