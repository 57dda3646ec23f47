#include "tasks/Judgment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>

#include "base/files/TextFile.h"

namespace heft {

namespace {
Answer judged(double value) {
  return {{{"judge", {}, {}, value}}};
}

// The first choice with one of these meanings, the best first; none: there is none.
std::optional<Answer> meant(const Judgment::Offer& offer, std::initializer_list<Meaning> meanings) {
  for (const Meaning meaning : meanings)
    for (const double point : Judgment::scale(offer.question).points)
      if (meaning_of(offer.responses, Judgment::choice_of(offer.question, point)) == meaning)
        return judged(point);
  return std::nullopt;
}
}  // namespace

bool AnswerScale::takes(double value) const {
  if (!points.empty()) return std::ranges::find(points, value) != points.end();
  return value >= low && value <= high && (!whole || value == std::round(value));
}

double AnswerScale::nearest(double value) const {
  if (!points.empty())
    return *std::ranges::min_element(points, {},
                                     [&](double point) { return std::abs(point - value); });
  const double width = high - low;
  const double unit = whole ? 1 : std::pow(10, std::floor(std::log10(std::max(width, 1e-6))) - 2);
  return std::clamp(unit * std::round(value / unit), low, high);
}

double AnswerScale::any(double fraction) const {
  const auto place = [&](double n) { return std::min(std::floor(fraction * n), n - 1); };
  if (!points.empty())
    return points[static_cast<std::size_t>(place(static_cast<double>(points.size())))];
  return whole ? low + place(high - low + 1) : at(fraction);
}

AnswerScale scale_of(const FormQuestion& question) {
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

double felt_fraction(double lag_mm) {
  constexpr double least_mm = 5, most_mm = 100;
  return std::min(1.0,
                  std::log1p(std::max(0.0, lag_mm) / least_mm) / std::log1p(most_mm / least_mm));
}

std::optional<std::pair<std::string, std::string>> question_named(const std::string& name) {
  const auto point = name.find('.');
  if (point == std::string::npos || point == 0 || point + 1 == name.size()) return std::nullopt;
  return std::pair(name.substr(0, point), name.substr(point + 1));
}

std::optional<FormQuestion> find_question(
    const std::map<std::string, Questionnaire>& questionnaires, const std::string& name) {
  const auto names = question_named(name);
  const auto form = names ? questionnaires.find(names->first) : questionnaires.end();
  if (form != questionnaires.end())
    for (const FormQuestion& asked : form->second.questions)
      if (asked.key == names->second && asked.kind != QuestionKind::text) return asked;
  return std::nullopt;
}

std::vector<PlannedCubes> shuffled(const std::vector<CubeSet>& sets,
                                   const std::vector<TechniqueTrials>& trials,
                                   RandomStream stream) {
  std::vector<PlannedCubes> order;
  for (const CubeSet& cubes : sets)
    for (const TechniqueTrials& some : trials)
      order.insert(order.end(), static_cast<std::size_t>(some.trials), {cubes, some.technique});
  stream.shuffle(std::span(order));
  return order;
}

void Judgment::Run::complete(const TrialRow& row, Changes& changes) {
  ++n_completed_;
  staircases_.respond(row, block_.response_in(row), changes);
}

TrialPlan Judgment::Run::plan_of_staircase(const TrialKey& key) const {
  RandomStream stream = key.trial("interleave");
  const std::size_t index = staircases_.next(stream);
  const ReferenceStaircase& of_block = block_.staircases[index];
  TrialPlan plan = key.plan(block_.name, task.name,
                            of_block.condition.empty() ? block_.condition : of_block.condition);
  plan.staircase = of_block.staircase.name();
  plan.level_g = staircases_[index].next_level(level_stream(key.seed, plan.staircase));
  plan.masses_g = {of_block.reference_g + *plan.level_g};
  if (!block_.has_reference()) return plan;
  plan.reference_g = of_block.reference_g;
  plan.reference_slot = key.slots().coin(0.5) ? 1 : 2;
  plan.masses_g.insert(plan.reference_slot == 1 ? plan.masses_g.begin() : plan.masses_g.end(),
                       of_block.reference_g);
  return plan;
}

TrialPlan Judgment::Run::plan(const TrialKey& key) const {
  if (!block_.staircases.empty()) return plan_of_staircase(key);
  const auto& [shown, technique] = order_.at(n_completed_);
  TrialPlan plan = key.plan(block_.name, task.name, technique);
  std::vector<std::size_t> places(shown.masses_g.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  key.slots().shuffle(std::span(places));
  for (const std::size_t i : places) {
    plan.masses_g.push_back(shown.masses_g[i]);
    if (!shown.table_friction.empty()) plan.table_friction.push_back(shown.table_friction[i]);
  }
  return plan;
}

bool Judgment::asks_for_number(const FormQuestion& question) {
  std::set<double> values;
  for (const AnswerChoice& choice : question.choices)
    if (const auto number = number_in(choice.value)) values.insert(*number);
  return question.kind != QuestionKind::choice || values.size() == question.choices.size();
}

AnswerScale Judgment::scale(const FormQuestion& question) {
  AnswerScale scale = scale_of(question);
  if (question.kind != QuestionKind::choice) return scale;
  const bool are_numbers = asks_for_number(question);
  for (const AnswerChoice& choice : question.choices)
    scale.points.push_back(are_numbers ? *number_in(choice.value)
                                       : static_cast<double>(scale.points.size() + 1));
  if (scale.points.empty()) return scale;
  scale.low = std::ranges::min(scale.points);
  scale.high = std::ranges::max(scale.points);
  return scale;
}

const AnswerChoice* Judgment::choice_of(const FormQuestion& question, double value) {
  const auto points = scale(question).points;
  const auto place = static_cast<std::size_t>(std::ranges::find(points, value) - points.begin());
  return place < points.size() ? &question.choices[place] : nullptr;
}

double Judgment::number_of(const FormQuestion& question, const std::string& given) {
  if (question.kind != QuestionKind::choice) return std::strtod(given.c_str(), nullptr);
  const auto chosen = std::ranges::find(question.choices, given, &AnswerChoice::value);
  if (chosen == question.choices.end()) return 0;
  return scale(question).points[static_cast<std::size_t>(chosen - question.choices.begin())];
}

std::optional<std::string> Judgment::Trial::refusal(const Action& action) const {
  if (!std::isfinite(*action.value)) return "it is not a finite number";
  const AnswerScale its = scale(offer_.question);
  if (!is_known_ || its.takes(*action.value)) return std::nullopt;
  if (!its.points.empty())
    return fmt::format("{} is none of the choices {}", *action.value, fmt::join(its.points, ", "));
  return fmt::format("{} is not on the scale from {} to {}", *action.value, its.low, its.high);
}

void Judgment::Trial::take(const Action& action) {
  result_.value = action.value;
  result_.outcome = asks_for_number(offer_.question) ? "judged" : "chosen";
}

std::string Judgment::Trial::answer() const {
  const AnswerChoice* choice = choice_of(offer_.question, *result_.value);
  return choice ? choice->value : fmt::format("{}", *result_.value);
}

std::optional<int> Judgment::Trial::n_answers() const {
  const FormQuestion& question = offer_.question;
  if (question.kind == QuestionKind::likert) return question.to - question.from + 1;
  if (question.choices.empty()) return std::nullopt;
  return static_cast<int>(question.choices.size());
}

namespace {
std::optional<Answer> simulated_response(const Judgment::Offer& offer, const Percepts& percepts) {
  const std::vector<double>& felt_mm = percepts.remembered_mm;
  if (felt_mm.size() == 1)
    return meant(offer,
                 {felt_fraction(felt_mm.front()) > 0.5 ? Meaning::positive : Meaning::negative});
  const Meaning heavier = heaviest_slot(felt_mm, {}) == 1 ? Meaning::left : Meaning::right;
  return percepts.differ ? meant(offer, {Meaning::positive, heavier})
                         : meant(offer, {Meaning::negative, Meaning::none, heavier});
}
}  // namespace

Answer Judgment::simulated(const Offer& offer, const Percepts& percepts, RandomStream& stream) {
  const std::vector<double>& felt_mm = percepts.remembered_mm;
  const AnswerScale its = scale(offer.question);
  if (percepts.lapse) return judged(its.any(felt_mm.front()));
  const auto [smallest, largest] = std::ranges::minmax(felt_mm);
  if (const auto response = simulated_response(offer, percepts)) return *response;
  if (asks_for_number(offer.question))
    return judged(its.at(felt_fraction(felt_mm.size() > 1 ? largest - smallest : largest)));
  if (felt_mm.size() > 1 && offer.question.choices.size() == felt_mm.size())
    return judged(heaviest_slot(felt_mm, {}));
  return judged(its.any(stream.uniform()));
}

Answer Judgment::blind(const Offer& offer, const WithoutPercepts& known, RandomStream& stream) {
  const auto answer = known.differ ? meant(offer, {Meaning::positive})
                                   : meant(offer, {Meaning::negative, Meaning::none});
  if (answer) return *answer;
  return judged(scale(offer.question).any(stream.uniform()));
}

std::vector<ScreenState> Judgment::fullest_screens() {
  std::vector<ScreenState> screens;
  FormQuestion question;
  for (int i = 1; i <= 12; ++i) question.choices.push_back({std::to_string(i), std::to_string(i)});
  for (const QuestionKind kind :
       {QuestionKind::choice, QuestionKind::likert, QuestionKind::slider, QuestionKind::number}) {
    question.kind = kind;
    question.from = 0;
    question.to = 10;
    question.most = 1000;
    ScreenState& screen = screens.emplace_back(ScreenState{.n_slots = 2});
    screen.offer = Offer{question};
  }
  return screens;
}

}  // namespace heft
