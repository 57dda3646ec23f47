// Whether who takes part can give the answers that the protocol takes.
#include <fmt/format.h>

#include <optional>
#include <variant>

#include "apparatus/PictureSource.h"
#include "apparatus/SessionSetup.h"
#include "base/Error.h"
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
}  // namespace

void check(const Setup& options, const Protocol& protocol) {
  if (!protocol.require_contact || has_person(options)) return;
  const ResponderEntry& responder = responder_named(split_name(options.responder).name);
  const bool is_filmed = tracker_named(options.tracker).what == TrackerWhat::source;
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
