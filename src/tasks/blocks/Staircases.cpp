#include "tasks/blocks/Staircases.h"

#include <fmt/format.h>

#include <algorithm>

#include "psychophysics/ProcedureKinds.h"

namespace heft {

namespace {
bool is_unfinished(const Procedure& staircase) {
  return !staircase.finished();
}

// Number of trials with one observer, who answers yes if the difference plus noise in proportion to
// the threshold exceeds the threshold; in a forced choice, 0: at the threshold 75 % are correct.
int simulated_trials(Procedure procedure, double threshold_g, bool is_forced,
                     std::uint64_t observer) {
  const double noise_per_threshold = is_forced ? 1 / 0.6745 : 0.4;
  constexpr int enough_trials = 1000;  // steps too small for the start may never converge
  RandomStream stream(0, "expected length", observer);
  const RandomStream levels = level_stream(observer, procedure.name());
  while (!procedure.finished() && procedure.n_trials() < enough_trials) {
    const double level_g = procedure.next_level(levels);
    const double seen_g = level_g + noise_per_threshold * threshold_g * stream.normal();
    procedure.respond({seen_g > (is_forced ? 0 : threshold_g)}, level_g);
  }
  return procedure.n_trials();
}

double mean_trials(const Procedure& procedure, double largest_threshold_g, bool is_forced) {
  if (const auto planned = procedure.planned_trials()) return *planned;
  if (const auto most = procedure.most_trials()) return *most;
  constexpr int n_observers = 200;
  double total = 0;
  for (int i = 0; i < n_observers; ++i) {
    const double fraction = 0.25 + 0.75 * (i + 0.5) / n_observers;
    total += simulated_trials(procedure, fraction * largest_threshold_g, is_forced,
                              static_cast<std::uint64_t>(i));
  }
  return total / n_observers;
}

// Staircases of one reference that start above and below use the same observers.
double largest_start_g(std::span<const ReferenceStaircase> staircases, double reference_g) {
  double largest_g = 0;
  for (const ReferenceStaircase& other : staircases)
    if (other.reference_g == reference_g)
      for (double level_g : other.staircase.planned_levels())
        largest_g = std::max(largest_g, level_g);
  return largest_g;
}
}  // namespace

double expected_trials(std::span<const ReferenceStaircase> staircases, bool is_forced) {
  double trials = 0;
  for (const ReferenceStaircase& reference : staircases)
    trials += mean_trials(reference.staircase, largest_start_g(staircases, reference.reference_g),
                          is_forced);
  return trials;
}

bool depend_on_answers(std::span<const ReferenceStaircase> staircases) {
  return std::ranges::any_of(staircases, [](const ReferenceStaircase& reference) {
    return !reference.staircase.planned_trials();
  });
}

std::string in_words(const InterleaveConfig& interleaving) {
  std::string order(name_of(interleaving.interleave));
  if (interleaving.max_lag > 0)
    order += fmt::format(", at most {} trials ahead", interleaving.max_lag);
  return order;
}

void add_staircases(Choices& choices, std::span<const ReferenceStaircase> staircases) {
  for (const ReferenceStaircase& reference : staircases) {
    const std::string its_name = "staircase " + reference.staircase.name();
    if (std::string course = ProcedureKinds::course(reference.staircase, "g"); !course.empty())
      choices.emplace_back(its_name + ", start and steps", std::move(course));
    choices.emplace_back(its_name, ProcedureKinds::described(reference.staircase));
  }
}

RunningStaircases::RunningStaircases(const std::vector<ReferenceStaircase>& staircases,
                                     const InterleaveConfig& interleaving)
    : interleaving_(interleaving) {
  for (const ReferenceStaircase& entry : staircases) staircases_.push_back(entry.staircase);
}

bool RunningStaircases::finished() const {
  return std::ranges::none_of(staircases_, is_unfinished);
}

std::size_t RunningStaircases::next(RandomStream& stream) const {
  return next_staircase(staircases_, interleaving_, previous_, stream).value();
}

std::size_t RunningStaircases::drawn_unfinished(RandomStream& stream) const {
  std::vector<std::size_t> unfinished;
  for (std::size_t i = 0; i < staircases_.size(); ++i)
    if (is_unfinished(staircases_[i])) unfinished.push_back(i);
  return unfinished.at(stream.below(unfinished.size()));
}

void RunningStaircases::respond(const TrialRow& row, const Response& response, Changes& changes) {
  const auto found = std::ranges::find(staircases_, row.plan.staircase, &Procedure::name);
  if (found == staircases_.end()) return;  // catch and practice trials
  const Update update = found->respond(response, *row.plan.level_g);
  if (const auto& reversal = update.reversal)
    changes.reversals = {{row.attempt_index, found->name(), reversal->number, reversal->level,
                          reversal->step_before, reversal->step_after}};
  if (update.finish)
    for (const Estimate& estimate : found->estimates())
      changes.estimates.push_back(row_of(found->name(), estimate, *update.finish));
  previous_ = static_cast<std::size_t>(found - staircases_.begin());
}

std::optional<std::string> RunningStaircases::unfinished_staircase() const {
  if (staircases_.size() < 2 || std::ranges::count_if(staircases_, is_unfinished) != 1)
    return std::nullopt;
  return std::ranges::find_if(staircases_, is_unfinished)->name();
}

}  // namespace heft
