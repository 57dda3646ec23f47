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
// How many ways there are to take so many of n, if equal ones count as different.
double n_ways(std::size_t n, std::size_t taken) {
  double ways = 1;
  for (std::size_t i = 0; i < taken; ++i)
    ways *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  return ways;
}

Answer judged(double value) {
  return {{{"judge", {}, {}, value}}};
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

std::vector<CubeSet> Judgment::Block::sets() const {
  const std::size_t n = masses_g.size(), taken = static_cast<std::size_t>(most_cubes());
  if (taken > n || n_ways(n, taken) > most_trials) return {};
  std::vector<CubeSet> sets;
  std::set<std::vector<std::pair<double, double>>> known;
  std::vector<char> is_taken(n, 0);
  std::fill_n(is_taken.begin(), taken, 1);
  do {
    CubeSet one;
    std::vector<std::pair<double, double>> sorted;
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_taken[i]) continue;
      one.masses_g.push_back(masses_g[i]);
      if (i < table_friction.size()) one.table_friction.push_back(table_friction[i]);
      sorted.emplace_back(masses_g[i], i < table_friction.size() ? table_friction[i] : 0);
    }
    std::ranges::sort(sorted);
    if (known.insert(std::move(sorted)).second) sets.push_back(std::move(one));
  } while (std::prev_permutation(is_taken.begin(), is_taken.end()));
  return sets;
}

ConfigMistakes Judgment::Block::check() const {
  const std::size_t n = masses_g.size(), taken = static_cast<std::size_t>(most_cubes());
  const std::size_t most = cubes > 0 ? std::size_t{most_trials} : FrameRow::most_cubes;
  ConfigMistakes mistakes = mistakes_in_number_of_cubes(masses_g, table_friction, 1, most);
  const auto add = [&](std::vector<std::string_view> keys, std::string what, std::string expected) {
    mistakes.push_back({std::move(keys), std::move(what), std::move(expected)});
  };
  if (n > 0 && taken > n)
    add({"cubes"}, fmt::format("cubes is {} of {} masses", taken, n), fmt::format("at most {}", n));
  else if (const double ways = n > 0 ? n_ways(n, taken) : 0; ways > most_trials)
    add({"cubes", "masses_g"}, fmt::format("there are {:.0f} sets of {} cubes", ways, taken),
        fmt::format("at most {}", most_trials));
  else if (const double trials_in_all = expected_trials();
           n > 0 && (trials_in_all < 1 || trials_in_all > most_trials))
    add({"trials", "masses_g"}, fmt::format("the block has {:g} trials", trials_in_all),
        fmt::format("1 to {}", most_trials));
  if (!question_named(asks))
    add({"question"}, fmt::format("question is \"{}\"", asks),
        "a question of a questionnaire file, NAME.KEY");
  return mistakes;
}

std::vector<std::pair<std::string, std::string>> Judgment::Block::choices() const {
  Choices choices{{"question of " + name, asks}};
  add_friction(choices, name, masses_g, table_friction);
  return choices;
}

std::optional<std::string> Judgment::Block::questionnaire() const {
  const auto names = question_named(asks);
  return names ? std::optional(names->first) : std::nullopt;
}

TrialPlan Judgment::Run::plan(const TrialKey& key) const {
  const auto& [shown, technique] = order_.at(n_completed_);
  TrialPlan plan = key.plan(name_, task.name, technique);
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
  const auto& choices = offer_.question.choices;
  const auto points = scale(offer_.question).points;
  const auto place = std::ranges::find(points, *result_.value) - points.begin();
  return place < std::ssize(points) ? choices[static_cast<std::size_t>(place)].value
                                    : fmt::format("{}", *result_.value);
}

std::optional<int> Judgment::Trial::n_answers() const {
  const FormQuestion& question = offer_.question;
  if (question.kind == QuestionKind::likert) return question.to - question.from + 1;
  if (question.choices.empty()) return std::nullopt;
  return static_cast<int>(question.choices.size());
}

Answer Judgment::simulated(const Offer& offer, const Percepts& percepts, RandomStream& stream) {
  const std::vector<double>& felt_mm = percepts.remembered_mm;
  const AnswerScale its = scale(offer.question);
  if (percepts.lapse) return judged(its.any(felt_mm.front()));
  const auto [smallest, largest] = std::ranges::minmax(felt_mm);
  if (asks_for_number(offer.question))
    return judged(its.at(felt_fraction(felt_mm.size() > 1 ? largest - smallest : largest)));
  if (felt_mm.size() > 1 && offer.question.choices.size() == felt_mm.size())
    return judged(heaviest_slot(felt_mm, {}));
  return judged(its.any(stream.uniform()));
}

Answer Judgment::blind(const Offer& offer, const WithoutPercepts&, RandomStream& stream) {
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
