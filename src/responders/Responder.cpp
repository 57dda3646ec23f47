#include "responders/Responder.h"

#include <algorithm>
#include <array>

#include "base/Names.h"
#include "responders/ResponderParameters.h"

namespace heft {

namespace {
constexpr std::array table{
    ResponderEntry{"simulated", "a hand that pushes cubes, an eye for the clone, a decision",
                   ResponderFile::parameters, make_simulated, simulated_parts},
    ResponderEntry{"population", "as simulated; its file also gives spreads and correlations",
                   ResponderFile::parameters, make_simulated, simulated_parts},
    ResponderEntry{"always_yes",
                   "finds a difference in every trial without touching a cube",
                   ResponderFile::none,
                   make_always_yes,
                   {},
                   false},
    ResponderEntry{"always_no",
                   "never finds a difference, never touches a cube",
                   ResponderFile::none,
                   make_always_no,
                   {},
                   false},
    ResponderEntry{"coin", "finds a difference with probability p, whatever it sees",
                   ResponderFile::parameters, make_coin, coin_parts, false},
    ResponderEntry{"criterion_only", "answers from its criterion and noise alone, never looking",
                   ResponderFile::parameters, make_criterion_only, criterion_only_parts, false},
    ResponderEntry{"start_anchored",
                   "knows the plan: \"same\" once the level is a fraction of where it started",
                   ResponderFile::parameters, make_start_anchored, start_anchored_parts, false},
    ResponderEntry{"weber", "knows the plan: compares masses by a fixed fraction, never looking",
                   ResponderFile::parameters, make_weber, weber_parts, false},
    ResponderEntry{"ideal", "the simulated hand, with an observer who uses all that is displayed",
                   ResponderFile::parameters, make_ideal, ideal_parts},
    ResponderEntry{"scripted",
                   "plays back a folder of trajectories and timed actions",
                   ResponderFile::folder,
                   make_scripted,
                   {}},
};
}  // namespace

std::span<const ResponderEntry> responders() {
  return table;
}

const ResponderEntry& responder_named(std::string_view name) {
  return entry_named("responder", name, responders());
}

std::string describe_parameters(const ResponderEntry& responder) {
  return describe_parameters(responder.parts);
}

}  // namespace heft
