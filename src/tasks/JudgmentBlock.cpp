// Blocks of judgments: their cubes, their checks, and what an answer responds to a procedure.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "base/Names.h"
#include "tasks/Judgment.h"

namespace heft {

namespace {
// Binomial coefficient: number of ways to take `taken` of n, if equal ones count as different.
double n_ways(std::size_t n, std::size_t taken) {
  double ways = 1;
  for (std::size_t i = 0; i < taken; ++i)
    ways *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  return ways;
}

bool has(const Meanings& responses, Meaning meaning) {
  return std::ranges::count(responses, meaning, &Meanings::value_type::second) > 0;
}

std::string in_words(const Meanings& responses) {
  std::string text;
  for (const auto& [value, meaning] : responses)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", value, name_of(meaning));
  return text;
}

}  // namespace

std::optional<Meaning> meaning_of(const Meanings& responses, const AnswerChoice* choice) {
  const auto found = choice
                         ? std::ranges::find(responses, choice->value, &Meanings::value_type::first)
                         : responses.end();
  return found == responses.end() ? std::nullopt : std::optional(found->second);
}

std::vector<CubeSet> Judgment::Block::sets() const {
  const std::size_t n = masses_g.size(), taken = static_cast<std::size_t>(most_cubes());
  if (!staircases.empty() || taken > n || n_ways(n, taken) > most_trials) return {};
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

int Judgment::Block::most_cubes() const {
  if (!staircases.empty()) return has_reference() ? 2 : 1;
  return cubes > 0 ? cubes : static_cast<int>(masses_g.size());
}

double Judgment::Block::expected_trials() const {
  if (!staircases.empty()) return heft::expected_trials(staircases, is_forced());
  return static_cast<double>(sets().size()) * total_of(trials);
}

bool Judgment::Block::is_forced() const {
  return has(responses, Meaning::left) && !has(responses, Meaning::none);
}

StaircaseRules Judgment::Block::staircase_rules() const {
  StaircaseRules rules{.reference = StaircaseRules::Reference::optional,
                       .either_sign = is_forced()};
  if (has(responses, Meaning::positive)) rules.no_cube = "responses without \"left\" and \"right\"";
  return rules;
}

ConfigMistakes Judgment::Block::mistakes_in_sets() const {
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
  return mistakes;
}

ConfigMistakes Judgment::Block::mistakes_in_responses() const {
  const auto mistake = [](std::vector<std::string_view> keys, std::string what,
                          std::string expected) -> ConfigMistakes {
    return {{std::move(keys), std::move(what), std::move(expected)}};
  };
  if (staircases.empty() && !responses.empty())
    return mistake({"responses"}, "responses without [[block.staircase]]",
                   "a staircase, to which the choices respond");
  if (staircases.empty()) return {};
  if (!masses_g.empty())
    return mistake({"masses_g"}, "masses_g together with [[block.staircase]]",
                   "only one of them: a staircase sets the masses");
  const auto n_of = [&](std::initializer_list<Meaning> meanings) {
    std::ptrdiff_t n = 0;
    for (const Meaning meaning : meanings)
      n += std::ranges::count(responses, meaning, &Meanings::value_type::second);
    return n;
  };
  const std::ptrdiff_t of_pair = n_of({Meaning::left, Meaning::right, Meaning::none});
  const bool are_of_pair = has(responses, Meaning::left) && has(responses, Meaning::right);
  const bool are_yes_no = has(responses, Meaning::positive) && has(responses, Meaning::negative);
  if (of_pair > 0 ? !are_of_pair || of_pair != std::ssize(responses) : !are_yes_no)
    return mistake({"responses"},
                   responses.empty() ? "lacks \"responses\""
                                     : fmt::format("responses has {}", in_words(responses)),
                   fmt::format("{}\"left\", \"right\" and perhaps \"none\", for the question's "
                               "choices: {}",
                               of_pair > 0 ? "" : "\"positive\" and \"negative\", or ",
                               of_pair > 0 ? "{ first = \"left\", second = \"right\" }"
                                           : "{ yes = \"positive\", no = \"negative\" }"));
  const auto n_with_reference = std::ranges::count_if(
      staircases, [](const ReferenceStaircase& one) { return one.reference_g > 0; });
  if (are_of_pair && n_with_reference < std::ssize(staircases))
    return mistake({"responses"}, "responses has \"left\" and \"right\", but there is one cube",
                   "a reference_g in each [[block.staircase]]");
  if (n_with_reference > 0 && n_with_reference < std::ssize(staircases))
    return mistake({"staircase"}, "one staircase has a reference_g, another has none",
                   "the same in all of them");
  return {};
}

ConfigMistakes Judgment::Block::check() const {
  ConfigMistakes mistakes = staircases.empty() ? mistakes_in_sets() : ConfigMistakes{};
  std::ranges::move(mistakes_in_responses(), std::back_inserter(mistakes));
  if (!question_named(asks))
    mistakes.push_back({{"question"},
                        fmt::format("question is \"{}\"", asks),
                        "a question of a questionnaire file, NAME.KEY"});
  return mistakes;
}

std::optional<std::string> Judgment::Block::mistake_in_question() const {
  if (!question || staircases.empty()) return std::nullopt;
  if (question->kind != QuestionKind::choice)
    return fmt::format(
        "the question {} is no choice, expected one: its choices respond to the "
        "staircases",
        asks);
  std::vector<std::string_view> choices;
  for (const AnswerChoice& choice : question->choices) choices.emplace_back(choice.value);
  for (const AnswerChoice& choice : question->choices)
    if (!meaning_of(responses, &choice))
      return fmt::format("responses has nothing for the choice \"{}\" of {}, expected {}",
                         choice.value, asks, quoted_list(choices));
  for (const auto& [value, meaning] : responses)
    if (std::ranges::count(question->choices, value, &AnswerChoice::value) == 0)
      return fmt::format("responses has \"{}\", which is no choice of {}, expected {}", value, asks,
                         quoted_list(choices));
  return std::nullopt;
}

Response Judgment::Block::response_in(const TrialRow& row) const {
  const AnswerChoice* choice = question && row.value ? choice_of(*question, *row.value) : nullptr;
  const Meaning meaning = meaning_of(responses, choice).value_or(Meaning::negative);
  if (meaning == Meaning::positive || meaning == Meaning::negative)
    return {meaning == Meaning::positive, {}};
  if (meaning == Meaning::none) return response_of(Choice::none);
  const bool is_reference = row.plan.reference_slot == (meaning == Meaning::left ? 1 : 2);
  Response response = response_of(is_reference ? Choice::reference : Choice::comparison);
  if (is_forced()) response.positive = !is_reference;
  return response;
}

std::vector<std::pair<std::string, std::string>> Judgment::Block::choices() const {
  Choices choices{{"question of " + name, asks}};
  add_friction(choices, name, masses_g, table_friction);
  if (staircases.empty()) return choices;
  choices.emplace_back("responses in " + name, in_words(responses));
  choices.emplace_back("interleaving in " + name, heft::in_words(interleaving));
  add_staircases(choices, staircases);
  return choices;
}

std::optional<std::string> Judgment::Block::questionnaire() const {
  const auto names = question_named(asks);
  return names ? std::optional(names->first) : std::nullopt;
}

}  // namespace heft
