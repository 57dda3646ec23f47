#include "engine/tasks/Sorting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "engine/tasks/TaskRules.h"

namespace heft {

namespace {
constexpr std::array offered{ActionKind::label, ActionKind::unlabel, ActionKind::validate,
                             ActionKind::dont_know};

bool all_labeled(const TaskState& state) {
  return std::ranges::all_of(state.labels, [](const auto& label) { return label.has_value(); });
}

// Labels from the lightest on go with masses from the lightest on.
bool labels_are_right(const TaskState& state) {
  std::vector<std::size_t> by_mass(state.labels.size());
  std::iota(by_mass.begin(), by_mass.end(), 0);
  std::ranges::sort(by_mass, {}, [&](std::size_t i) { return state.plan.masses_g[i]; });
  const auto expected = labels_for(state.plan.n_slots());
  for (std::size_t rank = 0; rank < by_mass.size(); ++rank)
    if (state.labels[by_mass[rank]] != expected[rank]) return false;
  return true;
}

std::optional<std::string> refusal(const TaskState& state, const Action& action) {
  const auto labels = labels_for(state.plan.n_slots());
  if (action.kind == ActionKind::label && std::ranges::find(labels, *action.label) == labels.end())
    return fmt::format("a trial with {} cubes has no label \"{}\"", labels.size(),
                       name_of(*action.label));
  if (action.kind == ActionKind::unlabel && !state.label_of(*action.slot))
    return fmt::format("cube {} has no label", *action.slot);
  if (action.kind == ActionKind::validate && !all_labeled(state))
    return "not all cubes have a label yet";
  return std::nullopt;
}

bool ends_trial(const TaskState&, const Action& action) {
  return action.kind == ActionKind::validate || action.kind == ActionKind::dont_know;
}

std::optional<Outcome> act(TaskState& state, const Action& action) {
  switch (action.kind) {
    case ActionKind::label:
      // A label belongs to one cube: giving a used one moves it.
      std::ranges::replace(state.labels, action.label, std::optional<Label>());
      state.label_of(*action.slot) = action.label;
      return std::nullopt;
    case ActionKind::unlabel:
      state.label_of(*action.slot).reset();
      return std::nullopt;
    case ActionKind::validate:
      return labels_are_right(state) ? Outcome::correct : Outcome::incorrect;
    default:
      return Outcome::dont_know;
  }
}

void show(const TaskState& state, ScreenState& screen) {
  screen.labels = state.labels;
  screen.can_validate = screen.can_answer && all_labeled(state);
}

// How many sequences of techniques can still follow, so that each can be drawn with equal
// probability.
class SequenceCounter {
 public:
  /// @param max_run longest run allowed; 0: any
  explicit SequenceCounter(int max_run) : max_run_(max_run) {}

  // Length of the run that ends with `next` after `run` trials of `last`; where runs are not
  // limited their length is not kept, which keeps the table small.
  int run_with(std::size_t next, std::size_t last, int run) const {
    return max_run_ > 0 && next == last ? run + 1 : 1;
  }

  // Ways to place the trials that are left of each technique after a run of `run` trials of `last`.
  double count(const std::vector<int>& left, std::size_t last, int run) {
    if (max_run_ > 0 && run > max_run_) return 0;
    if (std::accumulate(left.begin(), left.end(), 0) == 0) return 1;
    const auto key = std::tuple(left, last, run);
    if (const auto known = counts_.find(key); known != counts_.end()) return known->second;
    double ways = 0;
    for (std::size_t next = 0; next < left.size(); ++next)
      ways += ways_with(next, left, run_with(next, last, run));
    return counts_[key] = ways;
  }

  // The same where `next` comes first and makes a run of `run`.
  double ways_with(std::size_t next, std::vector<int> left, int run) {
    if (left[next] == 0) return 0;
    --left[next];
    return count(left, next, run);
  }

 private:
  int max_run_;
  std::map<std::tuple<std::vector<int>, std::size_t, int>, double> counts_;
};

// The balanced order of masses for the n-th trial of one technique: rounds through all orders, each
// round shuffled.
std::vector<double> balanced_order(const SortingBlock& block, std::uint64_t seed,
                                   const std::string& technique, int nth) {
  std::vector<double> order = block.masses_g;
  std::ranges::sort(order);
  std::vector<std::vector<double>> all;
  do {
    all.push_back(order);
  } while (std::ranges::next_permutation(order).found);
  const int n = static_cast<int>(all.size());
  RandomStream stream(seed, "orders/" + block.name + "/" + technique,
                      static_cast<std::uint64_t>(nth / n));
  stream.shuffle(std::span(all));
  return all[static_cast<std::size_t>(nth % n)];
}

// One coin after the other: this technique, or one of those after it.
std::size_t drawn(const std::vector<double>& ways, RandomStream& stream) {
  for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
    const double after =
        std::accumulate(ways.begin() + static_cast<std::ptrdiff_t>(i) + 1, ways.end(), 0.0);
    if (stream.coin(ways[i] + after > 0 ? ways[i] / (ways[i] + after) : 0)) return i;
  }
  return ways.size() - 1;
}
}  // namespace

const TaskRules sorting_rules{Task::sorting, offered, refusal, ends_trial, act, show};

std::vector<std::string> draw_techniques(const SortingBlock& block, std::uint64_t seed) {
  SequenceCounter counter(block.max_run);
  RandomStream stream(seed, "conditions/" + block.name);
  std::vector<int> left;
  for (const TechniqueTrials& some : block.trials) left.push_back(some.trials);
  std::vector<std::string> sequence;
  std::size_t last = left.size();  // none yet
  for (int n = block.n_trials(), run = 0; n > 0; --n) {
    std::vector<double> ways;
    for (std::size_t next = 0; next < left.size(); ++next)
      ways.push_back(counter.ways_with(next, left, counter.run_with(next, last, run)));
    const std::size_t next = drawn(ways, stream);
    run = counter.run_with(next, last, run);
    last = next;
    --left[next];
    sequence.push_back(block.trials[next].technique);
  }
  return sequence;
}

SortingRun::SortingRun(const SortingBlock& block, std::uint64_t seed)
    : block_(block), techniques_(draw_techniques(block, seed)) {}

TrialPlan SortingRun::plan(const TrialKey& key) const {
  const std::string& technique = techniques_.at(static_cast<std::size_t>(n_completed_));
  TrialPlan plan = key.plan(block_.name, Task::sorting, technique);
  // A repeated attempt is drawn freely: its planned order has been seen.
  if (block_.orders == SortingOrders::balanced && key.attempt == 1) {
    const auto nth = std::count(techniques_.begin(), techniques_.begin() + n_completed_, technique);
    plan.masses_g = balanced_order(block_, key.seed, technique, static_cast<int>(nth));
  } else {
    plan.masses_g = block_.masses_g;
    key.slots().shuffle(std::span(plan.masses_g));
  }
  return plan;
}

}  // namespace heft
