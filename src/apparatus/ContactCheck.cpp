// Whether who takes part can give the answers that the protocol takes, and the simulator bears what
// their hand does.
#include <fmt/format.h>

#include <optional>
#include <variant>

#include "apparatus/PictureSource.h"
#include "apparatus/SessionSetup.h"
#include "base/Error.h"
#include "physics/DecouplingSimulator.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"

namespace heft {

namespace {
// Where an answer is given; none: nothing is asked.
std::optional<std::string> first_block_with_trials(const Protocol& protocol) {
  for (const Block& block : protocol.blocks)
    if (!std::holds_alternative<DemonstrationBlock>(block) &&
        !std::holds_alternative<BreakBlock>(block))
      return block_name(block);
  return std::nullopt;
}

// Hands reach around corners; some simulators would stop in the middle of a trial. What a script's
// hand does somebody wrote down.
void require_general_simulator(const SessionConfig& options, const Protocol& protocol,
                               bool is_filmed) {
  const std::string& name = options.simulator.empty() ? protocol.simulator.name : options.simulator;
  if (simulator_named(name).for_sessions) return;
  if (!has_person(options) && !is_filmed) {
    const ResponderEntry& responder = responder_named(split_name(options.responder).name);
    if (!responder.touches_cubes || responder.file == ResponderFile::folder) return;
  }
  throw Error(
      fmt::format(
          "the simulator \"{}\" knows straight strokes at one cube only, and hands do more; "
          "expected another --simulator, or one in the protocol's [physics]",
          name),
      ExitCode::usage);
}
}  // namespace

void check(const SessionConfig& options, const Protocol& protocol) {
  const bool is_filmed = tracker_named(options.tracker).what == TrackerWhat::source;
  require_general_simulator(options, protocol, is_filmed);
  if (!protocol.require_contact || has_person(options)) return;
  const ResponderEntry& responder = responder_named(split_name(options.responder).name);
  const auto block = first_block_with_trials(protocol);
  if (responder.touches_cubes || is_filmed || !block) return;
  throw Error(
      fmt::format(
          "responder \"{}\" never touches a cube, and the protocol takes no answer before "
          "every cube was touched (require_contact = true), first in block \"{}\"; expected "
          "another responder, or require_contact = false",
          responder.name, *block),
      ExitCode::usage);
}

}  // namespace heft
