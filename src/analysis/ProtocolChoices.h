// What a protocol chose where the paper leaves it open, so that a report says what was run.
#pragma once

#include <string>
#include <vector>

#include "analysis/Dataset.h"
#include "protocol/Protocol.h"

namespace heft {

struct ProtocolChoice {
  std::string protocol;  ///< its name; the first digits of its hash where several share one
  std::string choice, value;
};

/// The choices of one protocol, in the order of paper.toml.
std::vector<ProtocolChoice> choices_in(const Protocol& protocol);

/// Those of every protocol that the sessions ran, each once. A logged text that is no protocol has
/// none.
std::vector<ProtocolChoice> protocol_choices(const std::vector<SessionData>& sessions);

}  // namespace heft
