#include "tasks/Estimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace heft {

namespace {
FormQuestion question_of(const Estimation::Block& block) {
  FormQuestion question = block.question.value_or(FormQuestion{});
  if (!block.question) question.kind = QuestionKind::slider;
  if (block.scale == "number") {
    question.kind = QuestionKind::number;
    question.least = block.low.value_or(0);
    question.most = block.high.value_or(0);
  }
  return question;
}

bool is_range_known(const Estimation::Block& block) {
  return block.question || !question_named(block.scale);
}

Answer estimated(double value) {
  return {{{"estimate", {}, {}, value}}};
}
}  // namespace

int Estimation::Block::n_trials() const {
  return static_cast<int>(masses_g.size()) * total_of(trials) + (modulus ? 1 : 0);
}

ConfigMistakes Estimation::Block::check() const {
  ConfigMistakes mistakes =
      mistakes_in_cubes(masses_g, table_friction, 1, most_trials,
                        "trials_per_mass sets the number of trials of each", true);
  const auto add = [&](std::string_view key, std::string what, std::string expected) {
    mistakes.push_back({{key}, std::move(what), std::move(expected)});
  };
  if (const int n = n_trials(); n < 1 || n > most_trials)
    mistakes.push_back({{"trials", "trials_per_mass", "masses_g"},
                        fmt::format("the block has {} trials", n),
                        fmt::format("1 to {}", most_trials)});
  if (scale != "number" && scale != "slider" && !question_named(scale)) {
    add("scale", fmt::format("scale is \"{}\"", scale),
        "\"number\", \"slider\" or a question of a questionnaire file, NAME.KEY");
  } else if (scale == "number") {
    if (!low || !high)
      add(low ? "high" : "low", "a scale of numbers without a range", "low and high");
    else if (*low < 0)
      add("low", fmt::format("low is {}", *low), "0 or more: a minus sign cannot be typed");
    else if (*high <= *low)
      add("high", fmt::format("high is {}", *high), fmt::format("more than low {}", *low));
    else if (modulus && (modulus->value < *low || modulus->value > *high))
      add("modulus", fmt::format("the modulus is {}", modulus->value),
          fmt::format("a number from low {} to high {}", *low, *high));
  } else {
    for (const auto& [key, there] : {std::pair("low", low.has_value()),
                                     {"high", high.has_value()},
                                     {"modulus", modulus.has_value()}})
      if (there)
        add(key, fmt::format("{} with scale = \"{}\"", key, scale), "only with scale = \"number\"");
  }
  return mistakes;
}

std::vector<std::pair<std::string, std::string>> Estimation::Block::choices() const {
  std::string text = scale;
  if (low && high) text += fmt::format(", {:g} to {:g}", *low, *high);
  if (modulus) text += fmt::format(", {:g} g is {:g}", modulus->mass_g, modulus->value);
  Choices choices{{"scale of " + name, text}};
  add_friction(choices, name, masses_g, table_friction);
  return choices;
}

std::optional<std::string> Estimation::Block::questionnaire() const {
  const auto names = question_named(scale);
  return names ? std::optional(names->first) : std::nullopt;
}

Estimation::Run::Run(const Block& block, std::uint64_t seed) : block_(block) {
  std::vector<CubeSet> single;
  for (std::size_t i = 0; i < block.masses_g.size(); ++i) {
    single.push_back({{block.masses_g[i]}});
    if (!block.table_friction.empty()) single.back().table_friction = {block.table_friction[i]};
  }
  order_ = shuffled(single, block.trials, RandomStream(seed, "estimation order/" + block.name));
}

TrialPlan Estimation::Run::plan(const TrialKey& key) const {
  const int n_before = block_.modulus ? n_completed_ - 1 : n_completed_;
  if (n_before < 0) {
    TrialPlan plan = key.plan(block_.name, task.name, block_.trials.front().technique);
    plan.masses_g = {block_.modulus->mass_g};
    plan.is_practice = true;
    return plan;
  }
  const auto& [cubes, technique] = order_.at(static_cast<std::size_t>(n_before));
  TrialPlan plan = key.plan(block_.name, task.name, technique);
  plan.masses_g = cubes.masses_g;
  plan.table_friction = cubes.table_friction;
  return plan;
}

Estimation::Trial::Trial(const Block& block, const TrialPlan& plan, std::uint64_t)
    : TaskTrial(task, plan),
      offer_{question_of(block), block.modulus, plan.is_practice},
      is_range_known_(is_range_known(block)) {}

std::optional<std::string> Estimation::Trial::refusal(const Action& action) const {
  const bool estimates = action.value.has_value();
  if (estimates == offer_.is_standard)
    return estimates ? "the standard is shown, not estimated" : "it has no number";
  if (!estimates) return std::nullopt;
  if (!std::isfinite(*action.value)) return "it is not a finite number";
  const AnswerScale scale = scale_of(offer_.question);
  if (is_range_known_ && !scale.takes(*action.value))
    return fmt::format("{} is not on the scale from {} to {}", *action.value, scale.low,
                       scale.high);
  return std::nullopt;
}

void Estimation::Trial::take(const Action& action) {
  result_.value = action.value;
  result_.outcome = action.value ? "estimated" : "shown";
}

std::string Estimation::Trial::answer() const {
  return result_.value ? fmt::format("{}", *result_.value) : std::string(*result_.outcome);
}

Answer Estimation::simulated(const Offer& offer, const Percepts& percepts, RandomStream&) {
  if (offer.is_standard) return {{{"validate"}}};
  const AnswerScale scale = scale_of(offer.question);
  const double remembered = std::max(0.0, percepts.remembered_mm.front());
  if (percepts.lapse) return estimated(scale.at(remembered));
  if (offer.modulus)
    return estimated(
        scale.nearest(remembered / mm_per_g / offer.modulus->mass_g * offer.modulus->value));
  return estimated(scale.at(felt_fraction(remembered)));
}

Answer Estimation::blind(const Offer& offer, const WithoutPercepts&, RandomStream& stream) {
  if (offer.is_standard) return {{{"validate"}}};
  return estimated(scale_of(offer.question).at(stream.uniform()));
}

std::vector<ScreenState> Estimation::fullest_screens() {
  const Modulus modulus{100, 10};
  ScreenState number{.n_slots = 1}, slider = number, standard = number;
  FormQuestion typed, slid;
  typed.kind = QuestionKind::number;
  typed.most = 1000;
  slid.kind = QuestionKind::slider;
  number.offer = Offer{typed, modulus};
  slider.offer = Offer{slid};
  standard.offer = Offer{typed, modulus, true};
  return {number, slider, standard};
}

}  // namespace heft
