#include "tasks/Estimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace heft {

namespace {
constexpr double slider_most = 100;

// Questionnaire and key of a scale "NAME.KEY"; none: the scale names no question.
std::optional<std::pair<std::string, std::string>> question_in(const std::string& scale) {
  const auto point = scale.find('.');
  if (point == std::string::npos || point == 0 || point + 1 == scale.size()) return std::nullopt;
  return std::pair(scale.substr(0, point), scale.substr(point + 1));
}

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
  return block.question || !question_in(block.scale);
}

// Range of valid answers, and whether they are whole numbers.
struct Scale {
  double least = 0, most = slider_most;
  bool whole = true;
};
Scale scale_of(const FormQuestion& question) {
  switch (question.kind) {
    case QuestionKind::choice:
      return {1, static_cast<double>(question.choices.size())};
    case QuestionKind::likert:
      return {static_cast<double>(question.from), static_cast<double>(question.to)};
    case QuestionKind::number:
      return {question.least, question.most, false};
    case QuestionKind::slider:
    case QuestionKind::text:
      break;
  }
  return {};
}

// The nearest valid value; numbers are rounded to three digits of their range.
Answer answer_near(const Scale& scale, double value) {
  const double width = scale.most - scale.least;
  const double unit =
      scale.whole ? 1 : std::pow(10, std::floor(std::log10(std::max(width, 1e-6))) - 2);
  value = std::clamp(unit * std::round(value / unit), scale.least, scale.most);
  return {{{"estimate", {}, {}, value}}};
}

// At a fraction of the way up the scale.
Answer answer_at(const Scale& scale, double fraction) {
  return answer_near(scale, scale.least + fraction * (scale.most - scale.least));
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
  if (scale != "number" && scale != "slider" && !question_in(scale)) {
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
  const auto names = question_in(scale);
  return names ? std::optional(names->first) : std::nullopt;
}

void Estimation::Block::read_question(const std::map<std::string, Questionnaire>& questionnaires) {
  const auto names = question_in(scale);
  if (!names) return;
  const auto form = questionnaires.find(names->first);
  if (form != questionnaires.end())
    for (const FormQuestion& asked : form->second.questions)
      if (asked.key == names->second && asked.kind != QuestionKind::text) question = asked;
}

Estimation::Run::Run(const Block& block, std::uint64_t seed) : block_(block) {
  for (std::size_t i = 0; i < block.masses_g.size(); ++i) {
    std::vector<double> friction;
    if (!block.table_friction.empty()) friction = {block.table_friction[i]};
    for (const TechniqueTrials& some : block.trials)
      order_.insert(order_.end(), static_cast<std::size_t>(some.trials),
                    {block.masses_g[i], friction, some.technique});
  }
  RandomStream(seed, "estimation order/" + block.name).shuffle(std::span(order_));
}

TrialPlan Estimation::Run::plan(const TrialKey& key) const {
  const int n_before = block_.modulus ? n_completed_ - 1 : n_completed_;
  if (n_before < 0) {
    TrialPlan plan = key.plan(block_.name, task.name, block_.trials.front().technique);
    plan.masses_g = {block_.modulus->mass_g};
    plan.is_practice = true;
    return plan;
  }
  const Stimulus& stimulus = order_.at(static_cast<std::size_t>(n_before));
  TrialPlan plan = key.plan(block_.name, task.name, stimulus.technique);
  plan.masses_g = {stimulus.mass_g};
  plan.table_friction = stimulus.table_friction;
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
  const Scale scale = scale_of(offer_.question);
  const bool on_scale = *action.value >= scale.least && *action.value <= scale.most &&
                        (!scale.whole || *action.value == std::round(*action.value));
  if (is_range_known_ && !on_scale)
    return fmt::format("{} is not on the scale from {} to {}", *action.value, scale.least,
                       scale.most);
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
  constexpr double least_mm = 5, most_mm = 100;
  // Friction 0.8 times gravity over 50 N/m (paper, 4.2).
  constexpr double mm_per_g = 0.8 * 9.81 / 50;
  if (offer.is_standard) return {{{"validate"}}};
  const Scale scale = scale_of(offer.question);
  const double remembered = std::max(0.0, percepts.remembered_mm.front());
  if (percepts.lapse) return answer_at(scale, remembered);
  if (offer.modulus)
    return answer_near(scale, remembered / mm_per_g / offer.modulus->mass_g * offer.modulus->value);
  return answer_at(
      scale, std::min(1.0, std::log1p(remembered / least_mm) / std::log1p(most_mm / least_mm)));
}

Answer Estimation::blind(const Offer& offer, const WithoutPercepts&, RandomStream& stream) {
  if (offer.is_standard) return {{{"validate"}}};
  return answer_at(scale_of(offer.question), stream.uniform());
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
