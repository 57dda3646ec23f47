#include "psychophysics/Interleaving.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace heft {

namespace {
int fewest_trials(std::span<const Procedure> staircases) {
  int fewest = std::numeric_limits<int>::max();
  for (const Procedure& staircase : staircases)
    if (!staircase.finished()) fewest = std::min(fewest, staircase.n_trials());
  return fewest;
}

// Indices in file order. Not empty while a staircase is unfinished, because the least advanced one
// may always run.
std::vector<std::size_t> may_run(std::span<const Procedure> staircases, int max_lag) {
  const int fewest = fewest_trials(staircases);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < staircases.size(); ++i)
    if (!staircases[i].finished() && (max_lag == 0 || staircases[i].n_trials() - fewest < max_lag))
      indices.push_back(i);
  return indices;
}

std::size_t next_in_turn(const std::vector<std::size_t>& candidates,
                         std::optional<std::size_t> previous) {
  if (!previous) return candidates.front();
  const auto next = std::upper_bound(candidates.begin(), candidates.end(), *previous);
  return next == candidates.end() ? candidates.front() : *next;
}
}  // namespace

ConfigMistakes InterleaveConfig::check() const {
  return out_of_range(*this);
}

std::optional<std::size_t> next_staircase(std::span<const Procedure> staircases,
                                          const InterleaveConfig& config,
                                          std::optional<std::size_t> previous,
                                          RandomStream& stream) {
  const std::vector<std::size_t> candidates = may_run(staircases, valid_config(config).max_lag);
  if (candidates.empty()) return std::nullopt;
  if (candidates.size() == 1 || config.interleave == Interleave::sequential)
    return candidates.front();
  if (config.interleave == Interleave::round_robin) return next_in_turn(candidates, previous);
  return candidates[stream.below(candidates.size())];
}

InterleavedRun::InterleavedRun(InterleavedProcedures procedures)
    : procedures_(std::move(procedures)) {
  open_trial();
}

Update InterleavedRun::respond(const Response& response, std::optional<double> shown) {
  const Update update = procedures_.staircases[*current_].respond(response, shown.value_or(level_));
  previous_ = current_;
  open_trial();
  return update;
}

void InterleavedRun::open_trial() {
  ++trial_;
  RandomStream stream(procedures_.seed, "interleave", static_cast<std::uint64_t>(trial_));
  current_ = next_staircase(procedures_.staircases, procedures_.interleaving, previous_, stream);
  if (current_) level_ = staircase().next_level(level_stream(procedures_.seed, staircase().name()));
}

}  // namespace heft
