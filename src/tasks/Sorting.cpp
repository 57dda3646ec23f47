#include "tasks/Sorting.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace heft {

namespace {
// Counts the sequences of techniques that can still follow, so that all are equally likely.
class SequenceCounter {
 public:
  /// @param max_run longest run; 0: no limit
  explicit SequenceCounter(int max_run) : max_run_(max_run) {}

  // Length of the run that ends with `next` after `run` trials of `last`. Without a limit the
  // length is always 1, which keeps the table small.
  int run_with(std::size_t next, std::size_t last, int run) const {
    return max_run_ > 0 && next == last ? run + 1 : 1;
  }

  // Number of orders of the remaining trials after `run` trials of `last`.
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

  // The same, starting with `next`, which makes a run of `run`.
  double ways_with(std::size_t next, std::vector<int> left, int run) {
    if (left[next] == 0) return 0;
    --left[next];
    return count(left, next, run);
  }

 private:
  int max_run_;
  std::map<std::tuple<std::vector<int>, std::size_t, int>, double> counts_;
};

// Balanced order of the masses in the n-th trial of a technique: rounds of all orders, each round
// shuffled.
std::vector<double> balanced_order(const Sorting::Block& block, std::uint64_t seed,
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

// Draws an index with probability proportional to its ways, one coin per index.
std::size_t drawn(const std::vector<double>& ways, RandomStream& stream) {
  for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
    const double after =
        std::accumulate(ways.begin() + static_cast<std::ptrdiff_t>(i) + 1, ways.end(), 0.0);
    if (stream.coin(ways[i] + after > 0 ? ways[i] / (ways[i] + after) : 0)) return i;
  }
  return ways.size() - 1;
}

Answer answer_of(std::span<const double> values, bool first_step_corrected) {
  Answer answer{{}, first_step_corrected};
  int slot = 0;
  for (const Label& label : labels_in_order(values))
    answer.actions.push_back({"label", ++slot, label});
  answer.actions.push_back({"validate"});
  return answer;
}

}  // namespace

ConfigMistakes Sorting::Block::check() const {
  auto mistakes = mistakes_in_cubes(masses_g, table_friction, 2, FrameRow::most_cubes,
                                    "equal ones have no right answer");
  if (const int n = n_trials(); n < 1 || n > most_trials)
    mistakes.push_back({{"trials"},
                        fmt::format("the block has {} trials", n),
                        fmt::format("1 to {}", most_trials)});
  // The longest run is shortest when the other trials separate those of the most frequent one.
  int commonest = 0;
  for (const TechniqueTrials& some : trials) commonest = std::max(commonest, some.trials);
  const int others = n_trials() - commonest;
  const int shortest = others < 0 ? 0 : (commonest + others) / (others + 1);
  if (max_run != 0 && max_run < shortest)
    mistakes.push_back(
        {{"max_run", "trials", "c1_trials"},
         fmt::format(
             "max_run is {}, but {} trials of one technique and {} of others need a longer run",
             max_run, commonest, others),
         fmt::format("at least {}, or 0 for no limit", shortest)});
  return mistakes;
}

std::vector<std::pair<std::string, std::string>> Sorting::Block::choices() const {
  std::string counts, names;
  for (const auto& [technique, n] : trials) {
    counts += fmt::format("{}{}", counts.empty() ? "" : " and ", n);
    names += (names.empty() ? "" : " and ") + technique;
  }
  Choices choices{{"sorting orders", std::string(name_of(orders))},
                  {names, fmt::format("{} shuffled, longest run {}", counts,
                                      max_run > 0 ? fmt::format("{}", max_run) : "any")}};
  add_friction(choices, name, masses_g, table_friction);
  return choices;
}

std::vector<double> Sorting::Block::friction_in(const std::vector<double>& order) const {
  std::vector<double> by_slot;
  for (const double mass_g : order)
    if (!table_friction.empty())
      by_slot.push_back(table_friction[static_cast<std::size_t>(
          std::ranges::find(masses_g, mass_g) - masses_g.begin())]);
  return by_slot;
}

std::span<const std::string_view> Sorting::labels_for(int n_cubes) {
  constexpr int n_words = 3;
  const std::span all(labels);
  if (n_cubes == n_words) return all.first(n_words);
  return all.subspan(n_words, static_cast<std::size_t>(n_cubes));
}

std::vector<std::string> draw_techniques(const std::vector<TechniqueTrials>& trials, int max_run,
                                         const std::string& block, std::uint64_t seed) {
  SequenceCounter counter(max_run);
  RandomStream stream(seed, "conditions/" + block);
  std::vector<int> left;
  for (const TechniqueTrials& some : trials) left.push_back(some.trials);
  std::vector<std::string> sequence;
  std::size_t last = left.size();  // none yet
  for (int n = total_of(trials), run = 0; n > 0; --n) {
    std::vector<double> ways;
    for (std::size_t next = 0; next < left.size(); ++next)
      ways.push_back(counter.ways_with(next, left, counter.run_with(next, last, run)));
    const std::size_t next = drawn(ways, stream);
    run = counter.run_with(next, last, run);
    last = next;
    --left[next];
    sequence.push_back(trials[next].technique);
  }
  return sequence;
}

Sorting::Run::Run(const Block& block, std::uint64_t seed)
    : block_(block), techniques_(draw_techniques(block.trials, block.max_run, block.name, seed)) {}

TrialPlan Sorting::Run::plan(const TrialKey& key) const {
  const std::string& technique = techniques_.at(static_cast<std::size_t>(n_completed_));
  TrialPlan plan = key.plan(block_.name, task.name, technique);
  // A repeated attempt is drawn freely, because its planned order was already seen.
  if (block_.orders == SortingOrders::balanced && key.attempt == 1) {
    const auto nth = std::count(techniques_.begin(), techniques_.begin() + n_completed_, technique);
    plan.masses_g = balanced_order(block_, key.seed, technique, static_cast<int>(nth));
  } else {
    plan.masses_g = block_.masses_g;
    key.slots().shuffle(std::span(plan.masses_g));
  }
  plan.table_friction = block_.friction_in(plan.masses_g);
  return plan;
}

bool Sorting::Trial::all_labeled() const {
  return std::ranges::all_of(labels_, [](const auto& label) { return label.has_value(); });
}

// Whether labels and masses have the same order.
bool Sorting::Trial::labels_are_right() const {
  std::vector<std::size_t> by_mass(labels_.size());
  std::iota(by_mass.begin(), by_mass.end(), 0);
  std::ranges::sort(by_mass, {}, [&](std::size_t i) { return plan_.masses_g[i]; });
  const auto expected = labels_for(plan_.n_slots());
  for (std::size_t rank = 0; rank < by_mass.size(); ++rank)
    if (labels_[by_mass[rank]] != expected[rank]) return false;
  return true;
}

std::optional<std::string> Sorting::Trial::refusal(const Action& action) const {
  const auto offered = labels_for(plan_.n_slots());
  if (action.label && std::ranges::count(offered, std::string_view(*action.label)) == 0)
    return fmt::format("a trial with {} cubes has no label \"{}\"", offered.size(), *action.label);
  if (action.kind == "unlabel" && !labels_[static_cast<std::size_t>(*action.slot - 1)])
    return fmt::format("cube {} has no label", *action.slot);
  if (action.kind == "validate" && !all_labeled()) return "not all cubes have a label";
  return std::nullopt;
}

void Sorting::Trial::take(const Action& action) {
  if (action.slot) {
    // Assigning a used label moves it.
    if (action.label) std::ranges::replace(labels_, action.label, std::optional<Label>());
    labels_[static_cast<std::size_t>(*action.slot - 1)] = action.label;
  } else if (action.kind == "validate") {
    result_.outcome = labels_are_right() ? "correct" : "incorrect";
  } else {
    result_.outcome = "dont_know";
  }
}

void Sorting::Trial::show(ScreenState& screen) const {
  screen.offer = Offer{labels_};
  screen.can_validate = screen.can_answer && all_labeled();
}

// "I don't know" discards the labels that were assigned before.
std::vector<std::string> Sorting::Trial::labels() const {
  std::vector<std::string> names;
  for (const auto& label : labels_)
    names.push_back(label && result_.outcome != "dont_know" ? std::string(*label) : "none");
  return names;
}

std::optional<int> Sorting::Trial::n_answers() const {
  int n_orders = 1;
  for (int i = 2; i <= plan_.n_slots(); ++i) n_orders *= i;
  return n_orders + 1;
}

Answer Sorting::simulated(const Offer&, const Percepts& percepts, RandomStream& stream) {
  const bool guess = stream.coin(percepts.guess_probability);
  const bool corrected = stream.coin(percepts.correction_probability);
  if (!percepts.lapse && !guess && !percepts.differ) return {{{"dont_know"}}};
  return answer_of(percepts.remembered_mm, corrected);
}

Answer Sorting::blind(const Offer&, const WithoutPercepts& known, RandomStream& stream) {
  if (!known.differ) return {{{"dont_know"}}};
  std::vector<double> values;
  for (int i = 0; i < known.n_slots; ++i) values.push_back(stream.uniform());
  return answer_of(values, false);
}

std::vector<ScreenState> Sorting::fullest_screens() {
  ScreenState screen{.n_slots = 3};
  screen.offer = Offer{{"lightest", "intermediate", "heaviest"}};
  return {screen};
}

std::vector<Label> labels_in_order(std::span<const double> values) {
  std::vector<std::size_t> from_lightest(values.size());
  std::iota(from_lightest.begin(), from_lightest.end(), std::size_t{0});
  std::ranges::stable_sort(from_lightest, {}, [&](std::size_t i) { return values[i]; });
  const auto words = Sorting::labels_for(static_cast<int>(values.size()));
  std::vector<Label> labels(values.size());
  for (std::size_t rank = 0; rank < labels.size(); ++rank)
    labels[from_lightest[rank]] = words[rank];
  return labels;
}

}  // namespace heft
