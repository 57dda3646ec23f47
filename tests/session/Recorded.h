// What a session that was kept in memory holds.
#pragma once

#include <vector>

#include "record/RecordedSession.h"

namespace heft::testing {

inline std::vector<Event> events_of(const RecordedSession& session, EventKind kind) {
  std::vector<Event> found;
  for (const RecordedEntry& entry : session.entries())
    if (const auto* recorded = std::get_if<RecordedEvent>(&entry);
        recorded && recorded->event.kind == kind)
      found.push_back(recorded->event);
  return found;
}

inline std::vector<FrameRow> frames_of(const RecordedSession& session) {
  std::vector<FrameRow> found;
  for (const RecordedEntry& entry : session.entries())
    if (const auto* frame = std::get_if<FrameRow>(&entry)) found.push_back(*frame);
  return found;
}

}  // namespace heft::testing
