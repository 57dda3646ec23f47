#include "session/Planning.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/Random.h"

namespace heft {

namespace {

// How many condition sequences can still follow, so that each can be drawn with equal probability.
class SequenceCounter {
 public:
  /// @param max_run longest run allowed; 0: any
  explicit SequenceCounter(int max_run) : max_run_(max_run) {}

  // Length of the run that ends with `next` after `run` trials of `last`; where runs are not
  // limited their length is not kept, which keeps the table small.
  int run_with(Condition next, Condition last, int run) const {
    return max_run_ > 0 && next == last ? run + 1 : 1;
  }

  // Ways to place n_c1 and n_c2 more trials after a run of `run` trials of `last`.
  double count(int n_c1, int n_c2, Condition last, int run) {
    if (max_run_ > 0 && run > max_run_) return 0;
    if (n_c1 + n_c2 == 0) return 1;
    const auto key = std::tuple(n_c1, n_c2, last, run);
    if (const auto known = counts_.find(key); known != counts_.end()) return known->second;
    double ways = 0;
    if (n_c1 > 0) ways += count(n_c1 - 1, n_c2, Condition::C1, run_with(Condition::C1, last, run));
    if (n_c2 > 0) ways += count(n_c1, n_c2 - 1, Condition::C2, run_with(Condition::C2, last, run));
    return counts_[key] = ways;
  }

 private:
  int max_run_;
  std::map<std::tuple<int, int, Condition, int>, double> counts_;
};

// The balanced order of masses for the n-th trial of one condition: rounds through all orders, each
// round shuffled.
std::vector<double> balanced_order(const SortingBlock& block, std::uint64_t seed,
                                   Condition condition, int nth) {
  std::vector<double> order = block.masses_g;
  std::ranges::sort(order);
  std::vector<std::vector<double>> all;
  do {
    all.push_back(order);
  } while (std::ranges::next_permutation(order).found);
  const int n = static_cast<int>(all.size());
  RandomStream stream(seed, "orders/" + block.name + "/" + std::string(name_of(condition)),
                      static_cast<std::uint64_t>(nth / n));
  stream.shuffle(std::span(all));
  return all[static_cast<std::size_t>(nth % n)];
}

RandomStream slot_stream(const TrialKey& key) {
  return RandomStream(key.seed, "slots", static_cast<std::uint64_t>(key.trial_number),
                      static_cast<std::uint64_t>(key.attempt));
}

RandomStream trial_stream(const TrialKey& key, std::string_view purpose) {
  return RandomStream(key.seed, purpose, static_cast<std::uint64_t>(key.trial_number));
}

TrialPlan plan_of(const TrialKey& key, const std::string& block, Task task, Condition condition) {
  TrialPlan plan;
  plan.trial_number = key.trial_number;
  plan.attempt = key.attempt;
  plan.block = block;
  plan.task = task;
  plan.condition = condition;
  return plan;
}

std::size_t drawn_unfinished(const std::vector<Procedure>& staircases, RandomStream& stream) {
  std::vector<std::size_t> unfinished;
  for (std::size_t i = 0; i < staircases.size(); ++i)
    if (!staircases[i].finished()) unfinished.push_back(i);
  return unfinished.at(stream.below(unfinished.size()));
}

}  // namespace

std::vector<Condition> draw_conditions(const SortingBlock& block, std::uint64_t seed) {
  SequenceCounter counter(block.max_run);
  RandomStream stream(seed, "conditions/" + block.name);
  std::vector<Condition> sequence;
  int n_c1 = block.c1_trials, n_c2 = block.trials - block.c1_trials, run = 0;
  while (n_c1 + n_c2 > 0) {
    const bool first = sequence.empty();
    const auto run_with = [&](Condition next) {
      return first ? 1 : counter.run_with(next, sequence.back(), run);
    };
    const double c1_ways =
        n_c1 > 0 ? counter.count(n_c1 - 1, n_c2, Condition::C1, run_with(Condition::C1)) : 0;
    const double c2_ways =
        n_c2 > 0 ? counter.count(n_c1, n_c2 - 1, Condition::C2, run_with(Condition::C2)) : 0;
    const Condition drawn =
        stream.coin(c1_ways / (c1_ways + c2_ways)) ? Condition::C1 : Condition::C2;
    run = run_with(drawn);
    --(drawn == Condition::C1 ? n_c1 : n_c2);
    sequence.push_back(drawn);
  }
  return sequence;
}

TrialPlan plan_introduction(const IntroductionBlock& block, const TrialKey& key, int n_wrong) {
  TrialPlan plan = plan_of(key, block.name, Task::introduction, block.condition);
  plan.masses_g = block.masses_g;
  RandomStream stream = slot_stream(key);
  plan.n_reshuffles = block.wrong_answer == WrongAnswer::reshuffle ? n_wrong : 0;
  for (int i = 0; i <= plan.n_reshuffles; ++i) stream.shuffle(std::span(plan.masses_g));
  return plan;
}

TrialPlan plan_sorting(const SortingBlock& block, const TrialKey& key, int index) {
  const std::vector<Condition> conditions = draw_conditions(block, key.seed);
  const Condition condition = conditions.at(static_cast<std::size_t>(index));
  TrialPlan plan = plan_of(key, block.name, Task::sorting, condition);
  // A repeated attempt is drawn freely: its planned order has been seen.
  if (block.orders == SortingOrders::balanced && key.attempt == 1) {
    const auto nth = std::count(conditions.begin(), conditions.begin() + index, condition);
    plan.masses_g = balanced_order(block, key.seed, condition, static_cast<int>(nth));
  } else {
    plan.masses_g = block.masses_g;
    slot_stream(key).shuffle(std::span(plan.masses_g));
  }
  return plan;
}

Response response_to(const ComparisonBlock& block, const TrialRow& completed) {
  if (completed.outcome != Outcome::difference) return response_of(Choice::none);
  Response response =
      response_of(completed.chosen_slot == completed.plan.reference_slot ? Choice::reference
                                                                         : Choice::comparison);
  if (block.positive_answer == PositiveAnswer::correct_choice)
    response.positive = completed.choice_correct.value_or(false);
  return response;
}

ComparisonPlan plan_comparison(const ComparisonBlock& block, const TrialKey& key,
                               const std::vector<Procedure>& staircases,
                               std::optional<std::size_t> previous) {
  ComparisonPlan next{plan_of(key, block.name, Task::comparison, block.condition), std::nullopt};
  TrialPlan& plan = next.plan;
  RandomStream catch_stream = trial_stream(key, "catch");
  plan.is_catch = catch_stream.coin(block.catch_fraction);
  std::size_t reference_of = 0;
  if (plan.is_catch) {
    reference_of = drawn_unfinished(staircases, catch_stream);
    plan.level_g = 0;
  } else {
    RandomStream interleave_stream = trial_stream(key, "interleave");
    reference_of =
        next_staircase(staircases, block.interleaving, previous, interleave_stream).value();
    next.staircase = reference_of;
    plan.staircase = block.staircases[reference_of].staircase.name;
    plan.level_g = staircases[reference_of].next_level(level_stream(key.seed, plan.staircase));
  }
  const double reference_g = block.staircases[reference_of].reference_g;
  plan.reference_g = reference_g;
  plan.reference_slot = slot_stream(key).coin(0.5) ? 1 : 2;
  plan.masses_g = {reference_g, reference_g};
  plan.masses_g[plan.reference_slot == 1 ? 1 : 0] += *plan.level_g;
  return next;
}

}  // namespace heft
