// What every payload of an event declares beside its fields: its name in the log, and what the
// engine does with it. Event.h lists the payloads.
#pragma once

#include <string_view>

namespace heft {

/// What the engine does with an event, and when it takes it.
enum class EventRole {
  course,   ///< decides what comes next; refused when it is not due, and after the session's end
  attempt,  ///< belongs to the open attempt; refused without one, and while the session is paused
  setting,  ///< folded, may come at any time
  recorded  ///< only kept, may come at any time
};

struct EventType {
  std::string_view name;  ///< in the log
  EventRole role = EventRole::recorded;
};

template <typename Payload>
concept Recorded = Payload::event_type.role == EventRole::recorded;

}  // namespace heft
