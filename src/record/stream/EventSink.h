// Destinations of a session's events and frames: the interface, a log on disk (SessionLog) and a
// session in memory (RecordedSession). The runner uses the interface only.
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

/// acknowledged: on disk when append() returns, before the screen changes. buffered: written in
/// order with the next acknowledged event, or within a second. In memory there is no difference.
enum class Durability { acknowledged, buffered };

/// Another process has locked the database. No data are lost: they are kept and written, in order,
/// by the first call that can write.
class LogBusy : public Error {
 public:
  using Error::Error;
};

class EventSink {
 public:
  virtual ~EventSink() = default;

  /// Writes an event and all its changes, or nothing.
  /// @throws Error if it could not be saved: what, why (disk full, ...), what to do; LogBusy if the
  ///   database is locked
  virtual void append(const Event& event, const Changes& changes, Durability durability) = 0;

  /// Writes a displayed frame; frames keep their order among the events.
  virtual void add_frame(const FrameRow& frame) = 0;

  /// Writes an answer about the participant (table participant_info); acknowledged.
  /// @throws Error as append()
  virtual void add_info(const std::string& key, const std::string& value) = 0;

  /// Writes everything buffered.
  virtual void flush() = 0;
};

struct RecordedEvent {
  Event event;
  Changes changes;
};

/// An event with its changes, or a displayed frame.
using RecordedEntry = std::variant<RecordedEvent, FrameRow>;

/// A session in memory, recorded by worker threads and stored by SessionArchive.
class RecordedSession final : public EventSink {
 public:
  explicit RecordedSession(SessionHeader header) : header_(std::move(header)) {}

  void append(const Event& event, const Changes& changes, Durability durability) override;
  void add_frame(const FrameRow& frame) override;
  void add_info(const std::string& key, const std::string& value) override;
  void flush() override {}

  const SessionHeader& header() const { return header_; }
  /// Events and frames in order.
  const std::vector<RecordedEntry>& entries() const { return entries_; }

 private:
  SessionHeader header_;
  std::vector<RecordedEntry> entries_;
};

}  // namespace heft
