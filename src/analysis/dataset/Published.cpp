#include "analysis/dataset/Published.h"

#include "base/SimulationChoices.h"

namespace heft::published {

std::optional<Condition> condition_of(const Technique& technique) {
  const auto* coupling = std::get_if<Coupling>(&technique.law);
  if (!coupling) return std::nullopt;
  if (!coupling->decoupled) return Condition::coupled;
  const Coupling paper;  // its defaults are the paper's numbers (4.2)
  const bool same =
      coupling->stiffness_n_per_m == paper.stiffness_n_per_m &&
      coupling->torsional_stiffness_nm_per_rad == paper.torsional_stiffness_nm_per_rad &&
      coupling->clone_mass_kg == paper.clone_mass_kg &&
      coupling->damping_ratio == paper.damping_ratio;
  return same ? std::optional(Condition::decoupled) : std::nullopt;
}

std::map<std::string, Condition> conditions_in(const Protocol& protocol) {
  std::map<std::string, Condition> conditions;
  const auto add = [&](const std::string& name) {
    const auto condition =
        condition_of(technique_named(name, protocol.techniques, protocol.coupling));
    if (condition) conditions.emplace(name, *condition);
  };
  for (const char* name : {coupled_technique, spring_technique}) add(name);
  for (const Technique& technique : protocol.techniques) add(technique.name);
  return conditions;
}

void Comparable::add(std::optional<Condition> condition, bool masses_equal) {
  same_ = same_ && condition && masses_equal && (!any_ || condition == condition_);
  condition_ = condition;
  any_ = true;
}

}  // namespace heft::published
