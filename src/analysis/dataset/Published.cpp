#include "analysis/dataset/Published.h"

#include <algorithm>
#include <set>

#include "base/SimulationChoices.h"
#include "tasks/Comparison.h"
#include "tasks/Introduction.h"
#include "tasks/Sorting.h"

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

namespace {
bool are(const std::vector<double>& masses_g, std::span<const double> papers) {
  return std::ranges::is_permutation(masses_g, papers);
}

// What the blocks of a protocol have of the paper's experiments.
struct PapersTasks {
  std::set<Condition> sorted;     // conditions of sortings of the paper's masses
  bool introduced = false;        // with the paper's masses and technique
  std::set<double> references_g;  // of comparisons in the paper's technique

  explicit PapersTasks(const Protocol& protocol) : conditions_(conditions_in(protocol)) {
    for (const Block& block : protocol.blocks)
      if (const auto* trials = std::get_if<TaskBlock>(&block)) add(*trials);
  }

 private:
  void add(const TaskBlock& block) {
    const auto* sorting = block.as<heft::Sorting::Block>();
    if (sorting && are(sorting->masses_g, sorting_masses_g) && sorting->table_friction.empty())
      for (const TechniqueTrials& one : sorting->trials)
        if (const auto condition = condition_named(one.technique)) sorted.insert(*condition);
    const auto* first = block.as<Introduction::Block>();
    if (first && are(first->masses_g, introduction_masses_g) &&
        condition_named(first->condition) == Condition::decoupled)
      introduced = true;
    const auto* comparison = block.as<Comparison::Block>();
    if (comparison && comparison->has_three_answers())
      for (const ReferenceStaircase& one : block.staircases())
        if (jnd_at(one.reference_g) &&
            condition_named(one.condition.empty() ? comparison->condition : one.condition) ==
                Condition::decoupled)
          references_g.insert(one.reference_g);
  }

  std::optional<Condition> condition_named(const std::string& technique) const {
    const auto found = conditions_.find(technique);
    return found == conditions_.end() ? std::nullopt : std::optional(found->second);
  }

  std::map<std::string, Condition> conditions_;
};
}  // namespace

std::vector<UntestableHypothesis> untestable_in(const Protocol& protocol) {
  const PapersTasks has(protocol);
  const bool compares = has.references_g.size() > 1;
  constexpr std::string_view comparisons =
      "comparisons with \"no difference\" at two of 15, 200 and 800 g in C2";
  const std::array<std::pair<bool, std::string_view>, hypotheses.size()> needed{
      {{has.sorted.contains(Condition::coupled), "sortings of 15, 200 and 800 g in C1"},
       {has.sorted.contains(Condition::decoupled), "sortings of 15, 200 and 800 g in C2"},
       {has.introduced, "an introduction with 15 and 800 g in C2"},
       {compares, comparisons},
       {compares, comparisons}}};
  std::vector<UntestableHypothesis> all;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const auto& [has_them, what] = needed.at(i);
    const std::string_view name = hypotheses.at(i).name;
    if (protocol.analysis.declares(name) && !has_them) all.push_back({name, what});
  }
  return all;
}

}  // namespace heft::published
