// An event in a line of JSON for other programs, as it is told while a session runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/Event.h"
#include "experiment/TrialPlan.h"

namespace heft {

struct AnnouncedEvent {
  std::int64_t session_id = 0;
  std::string participant;
  std::string utc;                ///< of the event
  std::optional<TrialPlan> plan;  ///< of the trial that it belongs to
};

/// {"t_s":12.5,"utc":"...","session":1,"participant":"P07","kind":"cubes_shown","trial":3,...}:
/// kind, slot, label and detail as the table `event` has them, without a setup's files; nothing of
/// masses, levels or conditions. A long detail is cut: at most 2000 bytes in all.
std::string event_line(const Event& event, const AnnouncedEvent& about);

}  // namespace heft
