#include "tasks/Adjustment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace heft {

namespace {
// Sums of steps stay readable in the log.
double to_milligrams(double mass_g) {
  return std::round(1000 * mass_g) / 1000;
}

// From the largest decrease to the largest increase.
std::vector<double> changes_g(const Adjustment::Block& block) {
  const double coarse = block.steps_g.front(), fine = block.steps_g.back();
  return {-coarse, -fine, fine, coarse};
}

std::vector<CubeSet> references_of(const Adjustment::Block& block) {
  std::vector<CubeSet> sets;
  for (const double reference_g : block.reference_g.values) sets.push_back({{reference_g}});
  return sets;
}
}  // namespace

double Adjustment::Block::highest_g() const {
  return 2 * std::max(start_g.back(), std::ranges::max(reference_g.values));
}

ConfigMistakes Adjustment::Block::check() const {
  ConfigMistakes mistakes;
  const auto add = [&](std::vector<std::string_view> keys, std::string what, std::string expected,
                       std::optional<std::size_t> index = {}) {
    mistakes.push_back({std::move(keys), std::move(what), std::move(expected), index});
  };
  const std::vector<double>& references = reference_g.values;
  if (references.empty()) add({"reference_g"}, "reference_g has no masses", "at least one");
  for (std::size_t i = 0; i < references.size(); ++i)
    if (std::find(references.begin(), references.begin() + static_cast<std::ptrdiff_t>(i),
                  references[i]) != references.begin() + static_cast<std::ptrdiff_t>(i))
      add({"reference_g"}, fmt::format("reference_g has {:g} g twice", references[i]),
          "different masses; trials repeats each", i);
  if (start_g.size() != 2 || start_g[0] > start_g[1])
    add({"start_g"}, fmt::format("start_g is [{}]", fmt::join(start_g, ", ")),
        "a range: [the lightest, the heaviest] first mass");
  if (steps_g.size() != 2 || steps_g[0] <= steps_g[1])
    add({"steps_g"}, fmt::format("steps_g is [{}]", fmt::join(steps_g, ", ")),
        "two steps: [the coarse, the fine one]");
  if (const double n = expected_trials(); !references.empty() && (n < 1 || n > most_trials))
    add({"trials", "reference_g"}, fmt::format("the block has {:g} trials", n),
        fmt::format("1 to {}", most_trials));
  if (!mistakes.empty()) return mistakes;
  const double lightest_g = std::min(start_g[0], std::ranges::min(references));
  if (lowest_g() > lightest_g)
    add({"steps_g"}, fmt::format("the fine step is {:g} g", lowest_g()),
        fmt::format("at most {:g} g, the smallest mass of start_g and reference_g: the fine step "
                    "is the lightest mass that can be set",
                    lightest_g));
  return mistakes;
}

Choices Adjustment::Block::choices() const {
  return {{"first mass in " + name, fmt::format("{:g} to {:g} g", start_g[0], start_g[1])},
          {"steps in " + name, fmt::format("{:g} and {:g} g, from {:g} to {:g} g", steps_g[0],
                                           steps_g[1], lowest_g(), highest_g())}};
}

Adjustment::Run::Run(const Block& block, std::uint64_t seed)
    : block_(block),
      order_(shuffled(references_of(block), block.trials,
                      RandomStream(seed, "adjustment order/" + block.name))) {}

TrialPlan Adjustment::Run::plan(const TrialKey& key) const {
  const auto& [reference, technique] = order_.at(n_completed_);
  TrialPlan plan = key.plan(block_.name, task.name, technique);
  const double reference_g = reference.masses_g.front();
  const double start_g = to_milligrams(
      std::lerp(block_.start_g[0], block_.start_g[1], key.trial("adjustment start").uniform()));
  plan.reference_g = reference_g;
  plan.level_g = start_g - reference_g;
  plan.reference_slot = key.slots().coin(0.5) ? 1 : 2;
  plan.masses_g = {reference_g, start_g};
  if (plan.reference_slot == 2) std::swap(plan.masses_g[0], plan.masses_g[1]);
  return plan;
}

double Adjustment::Trial::after_g(double change_g) const {
  return to_milligrams(mass_g() + change_g);
}

bool Adjustment::Trial::is_possible(double change_g) const {
  const double mass_g = after_g(change_g);
  return mass_g >= block_.lowest_g() && mass_g <= block_.highest_g();
}

std::optional<std::string> Adjustment::Trial::refusal(const Action& action) const {
  if (action.kind != "adjust") return std::nullopt;
  if (action.slot != slot())
    return fmt::format("cube {} is the reference, whose mass does not change", *action.slot);
  const std::vector<double> changes = changes_g(block_);
  if (std::ranges::find(changes, *action.value) == changes.end())
    return fmt::format("{:g} g is none of the steps {:g} g", *action.value,
                       fmt::join(changes, ", "));
  if (is_possible(*action.value)) return std::nullopt;
  return fmt::format("the mass would be {:g} g, outside {:g} to {:g} g", after_g(*action.value),
                     block_.lowest_g(), block_.highest_g());
}

void Adjustment::Trial::take(const Action& action) {
  if (action.kind == "equal") {
    result_.outcome = "adjusted";
    result_.value = mass_g();
    return;
  }
  if (last_change_g_ * *action.value < 0) ++n_turns_;
  last_change_g_ = *action.value;
  plan_.masses_g[static_cast<std::size_t>(slot() - 1)] = after_g(*action.value);
  ++plan_.n_reshuffles;
}

void Adjustment::Trial::show(ScreenState& screen) const {
  Offer offer{slot(), {}, n_turns_};
  for (const double change_g : changes_g(block_))
    offer.steps.push_back({change_g, is_possible(change_g)});
  screen.offer = offer;
  screen.try_again = plan_.n_reshuffles > 0;
}

std::string Adjustment::Trial::answer() const {
  return fmt::format("{}", *result_.value);
}

Answer Adjustment::simulated(const Offer& offer, const Percepts& percepts, RandomStream& stream) {
  constexpr int most_turns = 3;
  const Answer equal{{{"equal"}}};
  const auto step = [&](double change_g) { return Answer{{{"adjust", offer.slot, {}, change_g}}}; };
  std::vector<double> possible;
  for (const Step& one : offer.steps)
    if (one.is_possible) possible.push_back(one.change_g);
  if (percepts.lapse) {
    const auto drawn = stream.below(possible.size() + 1);
    return drawn == possible.size() ? equal : step(possible[drawn]);
  }
  if (!percepts.differ || offer.n_turns >= most_turns) return equal;
  const int heaviest = heaviest_slot(percepts.remembered_mm, {});
  std::erase_if(possible,
                [&](double change_g) { return (change_g < 0) != (heaviest == offer.slot); });
  if (possible.empty()) return equal;
  const auto [finest, coarsest] =
      std::ranges::minmax(possible, {}, [](double change_g) { return std::abs(change_g); });
  return step(offer.n_turns == 0 ? coarsest : finest);
}

Answer Adjustment::blind(const Offer&, const WithoutPercepts&, RandomStream&) {
  return {{{"equal"}}};
}

std::vector<ScreenState> Adjustment::fullest_screens() {
  ScreenState screen{.n_slots = 2};
  screen.offer = Offer{2, {{-50}, {-10}, {10}, {50}}, 0};
  return {screen};
}

}  // namespace heft
