#include <fmt/format.h>

#include "apparatus/configuration/ResolvedConfig.h"
#include "apparatus/sources/PictureSource.h"
#include "base/Error.h"
#include "physics/DecouplingSimulator.h"
#include "view/ArView.h"

namespace heft {

namespace {
// The first block with trials; none if there are none.
std::optional<std::string> first_block_with_trials(const Protocol& protocol) {
  for (const Block& block : protocol.blocks)
    if (!std::holds_alternative<DemonstrationBlock>(block) &&
        !std::holds_alternative<BreakBlock>(block))
      return block_name(block);
  return std::nullopt;
}

// The model whose hand is tracked; none if a person's or a filmed hand is.
const ResponderEntry* tracked_model(const ResolvedConfig::Parts& parts) {
  const bool is_filmed = parts.tracker->what == TrackerWhat::source;
  return has_person(parts.config) || is_filmed ? nullptr : parts.model.entry;
}

// Models' hands may move around corners, where some simulators would stop in the middle of a trial.
// A script's movements were chosen by its author.
void require_general_simulator(const std::string& simulator, const ResponderEntry* model) {
  if (simulator_named(simulator).for_sessions) return;
  if (model && (!model->touches_cubes || model->file == ResponderFile::folder)) return;
  throw Error(
      fmt::format(
          "the simulator \"{}\" models only straight pushes of one cube, but hands move freely; "
          "expected another --simulator, or one in the protocol's [physics]",
          simulator),
      ExitCode::usage);
}
}  // namespace

void require_compatible_plugs(const ResolvedConfig::Parts& parts) {
  const std::string& view = parts.config.view.name;
  const auto* model = std::get_if<Plug>(&parts.config.responder);
  if (parts.tracker->is_dragged && model)
    throw Error(
        fmt::format("tracker \"mouse\": the participant drags the effector, but the responder "
                    "\"{}\" moves it without a mouse; expected --tracker hand or "
                    "synthetic, or --responder human",
                    model->name),
        ExitCode::usage);
  if (!parts.tracker->has_pictures &&
      (!model || parts.model.entry->file == ResponderFile::folder || parts.view->has_screen))
    throw Error(
        fmt::format("tracker \"{}\": only a model's strokes are computed, without pictures; "
                    "expected a model as --responder and no window, or --tracker hand",
                    parts.tracker->name),
        ExitCode::usage);
  if (parts.tracker->is_dragged && !parts.view->has_screen)
    throw Error(
        fmt::format("tracker \"mouse\": the effector is dragged in the window, and the view "
                    "\"{}\" has none; expected --view window",
                    view),
        ExitCode::usage);
  if (!model && !parts.view->has_screen)
    throw Error(
        fmt::format("a participant cannot see or touch the view \"{}\"; expected --view window, "
                    "or a model as --responder",
                    view),
        ExitCode::usage);
}

void require_answerable(const ResolvedConfig::Parts& parts, const Protocol& protocol) {
  const ResponderEntry* model = tracked_model(parts);
  if (parts.tracker->has_pictures) require_general_simulator(parts.config.simulator, model);
  const auto block = first_block_with_trials(protocol);
  if (!protocol.require_contact || !model || model->touches_cubes || !block) return;
  throw Error(
      fmt::format(
          "responder \"{}\" never touches a cube, but the protocol takes no answer before "
          "every cube was touched (require_contact = true), first in block \"{}\"; expected "
          "another responder, or require_contact = false",
          model->name, *block),
      ExitCode::usage);
}

void require_questions(const Protocol& protocol) {
  for (const Block& block : protocol.blocks) {
    const auto* trials = std::get_if<TaskBlock>(&block);
    if (trials && trials->lacks_question())
      throw Error(fmt::format("block {} asks a question of the questionnaire {} that the session's "
                              "texts lack; expected one that is answered on the screen",
                              trials->name(), *trials->questionnaire()),
                  ExitCode::invalid_file);
    const auto mistake = trials ? trials->mistake_in_question() : std::nullopt;
    if (mistake)
      throw Error(fmt::format("block {}: {}", trials->name(), *mistake), ExitCode::invalid_file);
  }
}

}  // namespace heft
