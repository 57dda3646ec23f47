// A session kept in memory: everything a log would hold of it, in order, as a value. Worker threads
// record into it; SessionArchive stores it.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "record/schema/SessionHeader.h"
#include "record/stream/EventSink.h"

namespace heft {

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
