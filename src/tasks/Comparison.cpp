#include "tasks/Comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace heft {

namespace {
int n_planned(const Comparison::Block& block) {
  int n = 0;
  for (const ReferenceCatchTrials& some : block.catch_trials) n += some.trials;
  return n;
}

// Rounds of all references with catch trials left, each round in random order.
std::vector<double> catch_references(const Comparison::Block& block, std::uint64_t seed) {
  std::vector<double> references_g;
  for (int round = 0; static_cast<int>(references_g.size()) < n_planned(block); ++round) {
    std::vector<double> of_round;
    for (const ReferenceCatchTrials& some : block.catch_trials)
      if (some.trials > round) of_round.push_back(some.reference_g);
    RandomStream stream(seed, "catch order/" + block.name, static_cast<std::uint64_t>(round));
    stream.shuffle(std::span(of_round));
    references_g.insert(references_g.end(), of_round.begin(), of_round.end());
  }
  return references_g;
}

std::size_t n_characters(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

// The second slot may be a real object, which is lifted first.
Answer answered(const Comparison::Offer& offer, Action action) {
  if (offer.object.empty()) return {{std::move(action)}};
  if (action.slot == 2) action = {"select_object"};
  return {{{"lifted"}, std::move(action)}};
}

std::string catch_text(const Comparison::Block& block) {
  if (block.catch_trials.empty()) return fmt::format("{:g} %", 100 * block.catch_fraction);
  std::string text;
  for (const auto& [reference_g, trials] : block.catch_trials)
    text += fmt::format("{}{} at {:g} g", text.empty() ? "" : ", ", trials, reference_g);
  return text + fmt::format(", one in every {} trials", block.catch_every);
}
}  // namespace

ConfigMistakes Comparison::Block::check() const {
  if (reference && sides == Sides::balanced)
    return {{{"sides"}, "sides together with a real reference", "without it: there is one cube"}};
  if (const std::size_t n = reference ? n_characters(reference->name) : 1;
      n < 1 || n > RealObject::longest_name)
    return {{{"reference"},
             fmt::format("the name of the object has {} characters", n),
             fmt::format("1 to {}: it is written on a button", RealObject::longest_name)}};
  if (!has_three_answers() && positive_answer != PositiveAnswer::any_choice)
    return {{{"positive_answer"},
             fmt::format(R"(positive_answer together with answers = "{}")", name_of(answers)),
             is_forced()
                 ? "without it: in a forced choice choosing the comparison is the positive answer"
                 : "without it: \"different\" is the positive answer"}};
  if (catch_trials.empty() || catch_fraction == 0) return {};
  return {{{"catch_fraction"},
           "catch_fraction together with catch_trials",
           "only one of them: a random fraction or fixed numbers"}};
}

std::vector<std::pair<std::string, std::string>> Comparison::Block::choices() const {
  std::vector<std::pair<std::string, std::string>> choices{
      {"interleaving", in_words(interleaving)},
      {"catch trials", catch_text(*this)},
      {"sides of the reference", std::string(name_of(sides))},
      {"moves a staircase down", is_forced()           ? "choice of the comparison"
                                 : has_three_answers() ? std::string(name_of(positive_answer))
                                                       : "answer \"different\""}};
  if (!is_forced() && !has_three_answers()) choices.emplace_back("answers", "same or different");
  if (is_forced()) choices.emplace_back("answers", "forced choice, without \"no difference\"");
  if (reference)
    choices.emplace_back("reference in " + name, fmt::format("a real object: {}, {:g} g",
                                                             reference->name, reference->mass_g));
  add_staircases(choices, staircases);
  return choices;
}

StaircaseRules Comparison::Block::staircase_rules() const {
  StaircaseRules rules{.either_sign = is_forced()};
  if (reference) rules.object_g = reference->mass_g;
  if (answers == ComparisonAnswers::same_different) rules.no_cube = "answers = \"same_different\"";
  return rules;
}

double Comparison::Block::expected_staircase_trials() const {
  return heft::expected_trials(staircases, is_forced());
}

double Comparison::Block::expected_trials() const {
  return expected_staircase_trials() / (1 - catch_fraction) + n_planned(*this);
}

Comparison::Block Comparison::Block::for_practice() const {
  Block block = *this;
  block.catch_fraction = 0;
  block.catch_trials.clear();
  block.sides = Sides::random;
  return block;
}

Comparison::Run::Run(const Block& block, std::uint64_t)
    : block_(block), staircases_(block.staircases, block.interleaving) {}

bool Comparison::Run::finished() const {
  return staircases_.finished() && n_caught_ >= n_planned(block_);
}

// One catch trial in each block of `catch_every` trials, at a random position.
std::optional<double> Comparison::Run::catch_reference_g(std::uint64_t seed) const {
  constexpr int first_without = 3;
  if (n_caught_ >= n_planned(block_)) return std::nullopt;
  const int block = n_completed_ / block_.catch_every, place = n_completed_ % block_.catch_every;
  const int first = block == 0 ? first_without : 0;
  RandomStream stream(seed, "catch place/" + block_.name, static_cast<std::uint64_t>(block));
  const int drawn =
      first +
      static_cast<int>(stream.below(static_cast<std::uint64_t>(block_.catch_every - first)));
  if (place != drawn && !staircases_.finished()) return std::nullopt;
  return catch_references(block_, seed).at(static_cast<std::size_t>(n_caught_));
}

// A catch trial uses the technique of one of its reference's staircases.
std::size_t Comparison::Run::staircase_of(double reference_g, RandomStream& stream) const {
  std::vector<std::size_t> its;
  for (std::size_t i = 0; i < block_.staircases.size(); ++i)
    if (block_.staircases[i].reference_g == reference_g) its.push_back(i);
  return its.at(stream.below(its.size()));
}

// A repeated attempt is drawn freely, because its planned side was already seen.
int Comparison::Run::reference_slot(const TrialKey& key, const TrialPlan& plan,
                                    int n_before) const {
  if (block_.sides == Sides::random || key.attempt > 1) return key.slots().coin(0.5) ? 1 : 2;
  std::array sides{1, 1, 2, 2};
  RandomStream stream(key.seed, "sides/" + block_.name + "/" + plan.staircase,
                      static_cast<std::uint64_t>(n_before) / sides.size());
  stream.shuffle(std::span<int>(sides));
  return sides[static_cast<std::size_t>(n_before) % sides.size()];
}

TrialPlan Comparison::Run::plan(const TrialKey& key) const {
  RandomStream catch_stream = key.trial("catch");
  const std::optional<double> caught_g = catch_reference_g(key.seed);
  const bool is_catch = caught_g || catch_stream.coin(block_.catch_fraction);
  RandomStream interleave_stream = key.trial("interleave");
  const std::size_t index = caught_g   ? staircase_of(*caught_g, catch_stream)
                            : is_catch ? staircases_.drawn_unfinished(catch_stream)
                                       : staircases_.next(interleave_stream);
  const ReferenceStaircase& reference = block_.staircases[index];
  TrialPlan plan = key.plan(block_.name, task.name,
                            reference.condition.empty() ? block_.condition : reference.condition);
  plan.is_catch = is_catch;
  if (!is_catch) plan.staircase = reference.staircase.name();
  plan.level_g =
      is_catch ? 0 : staircases_[index].next_level(level_stream(key.seed, plan.staircase));
  plan.reference_g = reference.reference_g;
  if (block_.reference) {
    plan.masses_g = {reference.reference_g + *plan.level_g};
    plan.reference_slot = 2;
    return plan;
  }
  plan.reference_slot =
      reference_slot(key, plan, is_catch ? n_caught_ : staircases_[index].n_trials());
  plan.masses_g = {reference.reference_g, reference.reference_g};
  plan.masses_g[plan.reference_slot == 1 ? 1 : 0] += *plan.level_g;
  return plan;
}

void Comparison::Run::complete(const TrialRow& row, Changes& changes) {
  ++n_completed_;
  if (row.plan.is_catch) ++n_caught_;
  staircases_.respond(row, response_in(row, block_.positive_answer, block_.answers), changes);
}

Response Comparison::response_in(const TrialRow& row, PositiveAnswer positive_answer,
                                 ComparisonAnswers answers) {
  if (answers == ComparisonAnswers::same_different) return {row.outcome == "difference", {}};
  if (row.outcome != "difference") return response_of(Choice::none);
  Response response = response_of(row.chosen_slot == row.plan.reference_slot ? Choice::reference
                                                                             : Choice::comparison);
  if (answers == ComparisonAnswers::heavier)
    response.positive = response.choice == Choice::comparison;
  else if (positive_answer == PositiveAnswer::correct_choice)
    response.positive = row.choice_correct.value_or(false);
  return response;
}

std::optional<bool> Comparison::is_correct(const TrialRow& row) {
  if (row.plan.level_g == 0) return std::nullopt;
  return row.chosen_slot ? row.choice_correct : row.outcome == "difference";
}

std::optional<std::string> Comparison::Trial::refusal(const Action& action) const {
  if (!has_object() && (action.kind == "lifted" || action.kind == "select_object"))
    return "there is no real object in this trial";
  if (action.kind == "lifted") return std::nullopt;
  if (has_object() && !was_lifted_) return "the real object has not been lifted yet";
  const bool names_one = action.slot || action.kind == "select_object";
  if (answers_ == ComparisonAnswers::heavier && !names_one)
    return "a forced choice: one of the two cubes is the answer";
  if (answers_ == ComparisonAnswers::same_different && names_one)
    return "the answer is whether the cubes are the same, not a cube";
  if (answers_ == ComparisonAnswers::heavier_or_none && action.kind == "different")
    return "the answer is a cube or no difference";
  return std::nullopt;
}

// The cube or the real object, of which `choose` knows nothing.
void Comparison::Trial::choose_of_two(int slot) {
  result_.chosen_slot = slot;
  if (plan_.level_g.value_or(0) != 0)
    result_.choice_correct = (slot == plan_.reference_slot) == (*plan_.level_g < 0);
}

void Comparison::Trial::show(ScreenState& screen) const {
  screen.offer = Offer{answers_, object_, was_lifted_};
  if (has_object()) screen.can_validate = was_lifted_;
}

void Comparison::Trial::take(const Action& action) {
  if (action.kind == "lifted") {
    was_lifted_ = true;
    return;
  }
  if (has_object() && (action.slot || action.kind == "select_object"))
    choose_of_two(action.slot.value_or(2));
  else if (action.slot)
    choose(*action.slot);
  result_.outcome = action.kind == "no_difference" ? "no_difference" : "difference";
}

std::string Comparison::Trial::answer() const {
  if (!result_.chosen_slot) return result_.outcome == "difference" ? "different" : "none";
  return result_.chosen_slot == plan_.reference_slot ? "reference" : "comparison";
}

// A lapse: all answers are equally likely. A forced choice has no criterion.
Answer Comparison::simulated(const Offer& offer, const Percepts& percepts, RandomStream& stream) {
  if (offer.answers == ComparisonAnswers::heavier)
    return answered(offer, {"select", heaviest_slot(percepts.remembered_mm, {})});
  const bool names_cube = offer.answers == ComparisonAnswers::heavier_or_none;
  const std::size_t n_different = names_cube ? percepts.remembered_mm.size() : 1;
  const bool different = percepts.lapse ? stream.below(n_different + 1) > 0 : percepts.differ;
  if (!different) return answered(offer, {"no_difference"});
  if (!names_cube) return answered(offer, {"different"});
  return answered(offer, {"select", heaviest_slot(percepts.remembered_mm, {})});
}

Answer Comparison::blind(const Offer& offer, const WithoutPercepts& known, RandomStream& stream) {
  if (!known.differ && offer.answers != ComparisonAnswers::heavier)
    return answered(offer, {"no_difference"});
  if (offer.answers == ComparisonAnswers::same_different) return answered(offer, {"different"});
  const auto n = static_cast<std::uint64_t>(offer.object.empty() ? known.n_slots : 2);
  return answered(offer, {"select", 1 + static_cast<int>(stream.below(n))});
}

std::vector<ScreenState> Comparison::fullest_screens() {
  ScreenState screen{.n_slots = 2}, same_different = screen;
  screen.offer = Offer{};
  same_different.offer = Offer{ComparisonAnswers::same_different};
  std::vector<ScreenState> screens{screen, same_different};
  const std::string longest = "Mass of brass, labeled B2";
  for (const ComparisonAnswers answers :
       {ComparisonAnswers::heavier_or_none, ComparisonAnswers::same_different})
    for (const bool was_lifted : {false, true}) {
      ScreenState& real = screens.emplace_back(ScreenState{.n_slots = 1});
      real.offer = Offer{answers, longest.substr(0, RealObject::longest_name), was_lifted};
      real.can_validate = was_lifted;
    }
  return screens;
}

}  // namespace heft
