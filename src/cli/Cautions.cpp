// Cautions about protocols that are valid, but probably not what their author wants.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/dataset/Published.h"
#include "base/Names.h"
#include "cli/SessionOptions.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"
#include "physics/scene/Oracles.h"
#include "protocol/Protocol.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Comparison.h"

namespace heft::cli {

namespace {
bool has_compliant_contacts(const Protocol& protocol) {
  return protocol.contact_compliance_m_per_n > 0 ||
         std::ranges::any_of(protocol.techniques, [](const Technique& technique) {
           return technique.contact_compliance_m_per_n.value_or(0) > 0;
         });
}

// Rules that a staircase cannot reach, and defaults that suit other answers than the block's.
std::vector<std::string> cautions_of_procedures(const TaskBlock& block) {
  std::vector<std::string> found;
  const auto* comparison = block.as<Comparison::Block>();
  const bool is_forced = comparison && comparison->is_forced();
  for (const ReferenceStaircase& one : block.staircases()) {
    if (const auto* staircase = one.staircase.get_if<UpDown>()) {
      const UpDownConfig& config = staircase->config();
      if (config.stop_reversals >= config.stop_trials)
        found.push_back(fmt::format(
            "staircase \"{}\" cannot reach its {} reversals in {} trials: it always ends by its "
            "trials; raise stop_trials or reduce stop_reversals",
            one.staircase.name(), config.stop_reversals, config.stop_trials));
    }
    if (const auto* quest = one.staircase.get_if<Quest>())
      if (!is_forced && quest->config().gamma == QuestConfig().gamma)
        found.push_back(fmt::format(
            "staircase \"{}\" expects a share gamma = {} of positive answers far below the "
            "threshold, which suits forced choices only: set gamma to the share of false alarms, "
            "for example 0.05",
            one.staircase.name(), quest->config().gamma));
  }
  return found;
}
}  // namespace

// Warns of simulators that model one stroke or rigid contacts only, of settings that displace the
// clone from the filmed effector, which participants interpret as mass, of resets that reveal it,
// of techniques that replace predefined ones, of declared hypotheses that the protocol cannot test,
// and of procedures.
std::vector<std::string> cautions(const Protocol& protocol) {
  constexpr double stroke_m_s = 0.3;
  const auto& [mode, predict_s] = protocol.simulator.input;
  std::vector<std::string> found;
  const std::string& simulator = protocol.simulator.name;
  if (!entry_named("simulator", simulator, simulators()).for_sessions)
    found.push_back(fmt::format(
        "[physics] simulator = \"{}\" models one straight push: sessions refuse it if a hand "
        "does more: use \"boxes\" or \"auto\"",
        simulator));
  if (has_compliant_contacts(protocol) && !models_compliance(simulator))
    found.push_back(fmt::format(
        "contact_compliance_m_per_n has no effect: the contacts of \"{}\" are rigid; use \"boxes\"",
        simulator));
  if (mode == InputMode::hold || mode == InputMode::extrapolate)
    found.push_back(
        fmt::format("[physics] input = \"{}\" is for see-through displays; over video, where the "
                    "clone is seen beside the filmed effector, it adds apparent mass: use \"path\"",
                    name_of(mode)));
  if (protocol.layout.out_of_area == OutOfArea::give_back)
    found.emplace_back(
        "[layout] out_of_area = \"return\", the default, reveals the mass: light "
        "cubes jump back in most trials, heavy ones hardly ever: use \"together\"");
  for (const Technique& technique : protocol.techniques)
    if (technique.name == coupled_technique || technique.name == spring_technique)
      found.push_back(
          fmt::format("[[technique]] name = \"{}\" replaces the predefined technique of this name; "
                      "another name "
                      "keeps both apart",
                      technique.name));
  for (const auto& [name, needs] : published::untestable_in(protocol))
    found.push_back(
        fmt::format("[analysis] declares {}, which cannot be tested: it needs {}", name, needs));
  for (const Block& block : protocol.blocks)
    if (const auto* trials = std::get_if<TaskBlock>(&block))
      std::ranges::move(cautions_of_procedures(*trials), std::back_inserter(found));
  if (predict_s > 0) {
    const Scene scene = scene_of(protocol, coupled_technique, {});
    const double ahead_m = stroke_m_s * predict_s;
    const double slide_n_per_kg = sliding_force_n(scene.friction, 1, scene.gravity_m_s2);
    const std::string false_mass =
        slide_n_per_kg > 0
            ? fmt::format(", about {:.0f} g of apparent mass",
                          1e3 * scene.coupling.stiffness_n_per_m * ahead_m / slide_n_per_kg)
            : "";
    found.push_back(fmt::format(
        "[physics] predict_s = {} is for see-through displays; over video the clone runs {:.0f} mm "
        "ahead of an effector filmed at {} m/s{}: use 0",
        predict_s, 1e3 * ahead_m, stroke_m_s, false_mass));
  }
  return found;
}

}  // namespace heft::cli
