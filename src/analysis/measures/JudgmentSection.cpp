// Judgments: the answers to the question of a block, by the cubes that were shown. Numbers and
// points of scales have means, choices between words have shares.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"
#include "tasks/Judgment.h"

namespace heft {

namespace {
constexpr Measure mean_answer{
    "judgment_mean", "", "mean answer",
    "answer to the question of a judgment: mean over participants of each one's mean, Student's t "
    "interval; where the question takes only numbers above 0, geometric means, with the interval "
    "on logarithms"};
constexpr Measure share{"judgment_share", "%", "share of answers",
                        "share of judgments with this answer, of a question with choices; interval "
                        "over participants, of whom one with more trials counts more"};

using Cube = std::pair<double, std::optional<double>>;  // mass and own friction

struct Shown {
  std::string block, condition;
  std::optional<double> reference_g;  // of a procedure that compares with a cube
  std::vector<Cube> cubes;            // from light to heavy
  auto operator<=>(const Shown&) const = default;
};

// "100, 200", with their own friction "100 (0.2), 200 (0.8)"
Coordinate coordinate_of(const std::vector<Cube>& cubes) {
  std::string text;
  for (const auto& [mass_g, friction] : cubes) {
    text += fmt::format("{}{:g}", text.empty() ? "" : ", ", mass_g);
    if (friction) text += fmt::format(" ({:g})", *friction);
  }
  const bool is_one = cubes.size() == 1 && !cubes.front().second;
  return {"masses_g", text, is_one ? std::optional(cubes.front().first) : std::nullopt};
}

// The answers to a question by participant.
struct Answers {
  std::optional<FormQuestion> question;  // none: the log's texts lack it
  bool are_chosen = false;               // places among the choices
  // Instead of the question's choices: which cube was chosen, whatever its side.
  std::vector<std::pair<double, std::string>> cubes;
  std::map<std::string, std::vector<double>> people;

  bool has_logarithms() const {
    return question && question->kind == QuestionKind::number && question->least > 0;
  }
  // Choices in the question's order; if it is unknown, those that were given.
  std::vector<std::pair<double, std::string>> choices() const {
    if (!cubes.empty()) return cubes;
    std::vector<std::pair<double, std::string>> all;
    if (question) {
      for (const AnswerChoice& choice : question->choices)
        all.emplace_back(static_cast<double>(all.size()) + 1, choice.value);
      return all;
    }
    std::set<double> given;
    for (const auto& [participant, values] : people) given.insert(values.begin(), values.end());
    for (const double value : given) all.emplace_back(value, fmt::format("{:g}", value));
    return all;
  }
};

// The answer to a procedure's pair of cubes, whose sides are random, as the cube that it chooses: 1
// the comparison, 2 the reference, 3 neither. None: answers of this question choose no cube.
std::optional<double> chosen_cube(const TrialRow& trial, const JudgmentOffer& asked) {
  if (!trial.plan.reference_g || !trial.plan.reference_slot) return std::nullopt;
  const auto meaning =
      meaning_of(asked.responses, Judgment::choice_of(asked.question, *trial.value));
  if (meaning == Meaning::none) return 3;
  if (meaning != Meaning::left && meaning != Meaning::right) return std::nullopt;
  return *trial.plan.reference_slot == (meaning == Meaning::left ? 1 : 2) ? 2 : 1;
}

std::vector<std::pair<double, std::string>> cubes_to_choose(const Meanings& responses) {
  std::vector<std::pair<double, std::string>> all{{1, "comparison"}, {2, "reference"}};
  for (const auto& [answer, meaning] : responses)
    if (meaning == Meaning::none && all.size() < 3) all.emplace_back(3, answer);
  return all;
}

std::string in_brackets(const StudyEstimate& one) {
  if (!one.low) return "";
  return one.measure == &share
             ? fmt::format(" [{:.0f}, {:.0f}]", *one.low, *one.high)
             : fmt::format(" [{}, {}]", in_digits(*one.low), in_digits(*one.high));
}

class JudgmentSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || trial.plan.task != "judgment" || !trial.value) continue;
      Shown shown{trial.plan.block, trial.plan.condition, trial.plan.reference_g, {}};
      for (const CubeRow& cube : attempt.cubes)
        shown.cubes.emplace_back(cube.mass_g, cube.table_friction);
      std::ranges::sort(shown.cubes);
      Answers& answers = by_shown_[shown];
      double value = *trial.value;
      if (const auto asked = data.judgments.find(shown.block); asked != data.judgments.end()) {
        answers.question = asked->second.question;
        if (const auto cube = chosen_cube(trial, asked->second)) {
          value = *cube;
          answers.cubes = cubes_to_choose(asked->second.responses);
        }
      }
      answers.are_chosen = trial.outcome == "chosen";
      answers.people[data.participant()].push_back(value);
      if (!trial.plan.staircase.empty() && !data.without_jnd.contains(trial.plan.staircase))
        have_thresholds_.insert(shown.block);
    }
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const auto& [shown, answers] : by_shown_)
      for (const auto& [participant, values] : answers.people) {
        if (answers.are_chosen) {
          for (const auto& [value, word] : answers.choices()) {
            const auto n = static_cast<int>(std::ranges::count(values, value));
            put_at(all, shown, answers,
                   own_share(share, participant, {n, static_cast<int>(values.size())}), &word);
          }
          continue;
        }
        put_at(all, shown, answers, own_mean(answers, participant, values));
      }
    return all;
  }

  void put(Summary& summary) override {
    for (const auto& [shown, answers] : by_shown_)
      if (answers.are_chosen)
        put_shares(summary.estimates, shown, answers);
      else
        put_mean(summary.estimates, shown, answers);
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::map<std::string, std::vector<std::string>> parts;  // by block
    for (const StudyEstimate& one : summary.estimates) {
      if ((one.measure != &mean_answer && one.measure != &share) || !one.value) continue;
      if (have_thresholds_.contains(one.text_at("block"))) continue;
      const std::string what =
          one.measure == &share ? fmt::format("{:.0f} % \"{}\"", *one.value, one.text_at("answer"))
                                : in_digits(*one.value);
      parts[one.text_at("block")].push_back(fmt::format("{}{} at {} g {}", what, in_brackets(one),
                                                        one.text_at("masses_g"),
                                                        in_condition(summary, one.condition)));
    }
    std::vector<std::string> sentences;
    for (const auto& [block, of_block] : parts)
      sentences.push_back(fmt::format("Judgment \"{}\": {}.", block, some_of(of_block, 4)));
    return sentences;
  }

  std::vector<EstimateTable> tables() const override {
    const std::vector<EstimateColumn> place{
        key_column("block", "block"), key_column("question", "question"),
        key_column("condition", "condition"), key_column("masses_g", "masses g")};
    EstimateTable means{"judgment",
                        "Judgments: mean answers by cubes",
                        place,
                        "over participants, each of whom counts once; geometric where the question "
                        "takes only numbers above 0",
                        TablePlace::results,
                        "judgment[]"};
    for (EstimateColumn& one :
         std::vector{column(mean_answer, Field::n, "n_participants", "n"),
                     column(mean_answer, Field::n_trials, "n_trials", "trials"),
                     column(mean_answer, Field::value, "mean", "mean", 2),
                     column(mean_answer, Field::sd, "sd", "SD", 2)})
      means.columns.push_back(std::move(one));
    add_interval(means.columns, mean_answer, "low", "high", 2);
    means.columns.push_back(column(mean_answer, Field::method, "method", "mean and interval"));

    EstimateTable shares{"judgment_choices",
                         "Judgments: chosen answers by cubes",
                         place,
                         "of all trials; of a procedure's two cubes, whose sides are random, "
                         "which one was chosen; 95 % intervals over participants",
                         TablePlace::results,
                         "judgment_choices[]"};
    shares.columns.push_back(key_column("reference_g", "reference g"));
    shares.columns.push_back(key_column("answer", "answer"));
    for (EstimateColumn& one : std::vector{column(share, Field::n, "n_participants", "n"),
                                           column(share, Field::n_trials, "n_trials", "trials"),
                                           column(share, Field::n_hits, "n_chosen", "chosen"),
                                           column(share, Field::value, "percent", "%")})
      shares.columns.push_back(std::move(one));
    add_interval(shares.columns, share, "low_percent", "high_percent");

    EstimateTable people{"judgment_by_participant", "Each participant's mean answers", place, "",
                         TablePlace::csv};
    people.participants = true;
    people.columns.push_back(key_column("participant", "participant"));
    people.columns.push_back(column(mean_answer, Field::value, "mean", "mean", 2));
    people.columns.push_back(column(mean_answer, Field::n_trials, "n_trials", "trials"));
    return {means, shares, people};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "judgment",
             .title = "Judgments: mean answers by cubes, 95 % intervals",
             .caption = "Mean over participants of the answers to the question about these cubes, "
                        "geometric where it takes only numbers above 0; small points: each "
                        "participant.",
             .csv = "judgment.csv",
             .importance = 39,
             .series = {{&mean_answer}},
             .x = "masses_g",
             .split = {"condition"},
             .panels = {"block"},
             .participants = true,
             .x_label = "masses (g)",
             .y_label = "answer"}};
  }

 private:
  static StudyEstimate own_mean(const Answers& answers, const std::string& participant,
                                std::vector<double> values) {
    StudyEstimate own{&mean_answer};
    own.participant = participant;
    own.n = 1;
    own.n_trials = static_cast<int>(values.size());
    if (answers.has_logarithms())
      for (double& value : values) value = std::log(value);
    own.value = mean(values);
    if (answers.has_logarithms()) own.value = std::exp(*own.value);
    return own;
  }

  static void put_at(Estimates& all, const Shown& shown, const Answers& answers,
                     StudyEstimate estimate, const std::string* answer = nullptr) {
    estimate.task = "judgment";
    estimate.condition = shown.condition;
    estimate.reference_g = shown.reference_g;
    estimate.by = {{"block", shown.block},
                   {"question", answers.question ? answers.question->key : ""},
                   coordinate_of(shown.cubes)};
    if (answer) estimate.by.push_back({"answer", *answer});
    all.push_back(std::move(estimate));
  }

  static void put_shares(Estimates& all, const Shown& shown, const Answers& answers) {
    for (const auto& [value, word] : answers.choices()) {
      Tallies tallies;
      for (const auto& [participant, values] : answers.people)
        tallies[participant] = {static_cast<int>(std::ranges::count(values, value)),
                                static_cast<int>(values.size())};
      put_at(all, shown, answers, rate_estimate(share, rate_of(tallies)), &word);
    }
  }

  static void put_mean(Estimates& all, const Shown& shown, const Answers& answers) {
    Estimates people;
    std::vector<const StudyEstimate*> each;
    for (const auto& [participant, values] : answers.people)
      each.push_back(&people.emplace_back(own_mean(answers, participant, values)));
    StudyEstimate over_people = mean_over_people(each, answers.has_logarithms());
    over_people.method =
        answers.has_logarithms() ? "geometric, Student's t" : "arithmetic, Student's t";
    put_at(all, shown, answers, std::move(over_people));
  }

  std::map<Shown, Answers> by_shown_;
  std::set<std::string> have_thresholds_;  // blocks whose result is the procedures' threshold
};
}  // namespace

std::shared_ptr<Section> judgment_section() {
  return std::make_shared<JudgmentSection>();
}

}  // namespace heft
