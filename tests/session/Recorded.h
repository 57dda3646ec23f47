// Contents of a session that was recorded in memory.
#pragma once

#include <string>
#include <vector>

#include "record/stream/EventSink.h"

namespace heft::testing {

inline std::vector<Event> events_of(const RecordedSession& session, EventKind kind) {
  std::vector<Event> found;
  for (const RecordedEntry& entry : session.entries())
    if (const auto* recorded = std::get_if<RecordedEvent>(&entry);
        recorded && recorded->event.kind() == kind)
      found.push_back(recorded->event);
  return found;
}

/// The pages of texts in the order that they were shown in.
inline std::vector<std::string> pages_of(const RecordedSession& session) {
  std::vector<std::string> pages;
  for (const Event& event : events_of(session, event_kind<TextShown>))
    pages.push_back(event.as<TextShown>()->page);
  return pages;
}

inline std::vector<FrameRow> frames_of(const RecordedSession& session) {
  std::vector<FrameRow> found;
  for (const RecordedEntry& entry : session.entries())
    if (const auto* frame = std::get_if<FrameRow>(&entry)) found.push_back(*frame);
  return found;
}

}  // namespace heft::testing
