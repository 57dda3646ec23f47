// What sessions of versions 1 and 2 were run with. They told it in their headers (run_options, a
// JSON object) and in deviations, {"option", "from", "to"} each, when they went on with something
// else. Private to this room.
#pragma once

#include <optional>

#include "experiment/Event.h"
#include "record/SessionHeader.h"

namespace heft {

/// Follows one session's events, in order. A session that told its setups as events has none here.
class OlderSetups {
 public:
  /// @throws Error when the header's options can't be read
  explicit OlderSetups(const SessionHeader& header);

  /// What it was started with, before the first event. A simulator that was not named is the
  /// protocol's and stays empty.
  const std::optional<SessionConfig>& first() const { return first_; }

  /// The event, or the setup that came into force with it.
  Event told(Event event);

 private:
  std::optional<SessionConfig> first_, now_;
};

}  // namespace heft
