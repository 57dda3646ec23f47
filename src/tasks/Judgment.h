// Judgment: a task as data. A trial shows the cubes that the protocol gives and asks one question
// of a questionnaire file; the answer is logged as a number.
//
// The cubes are sets of given masses, or a procedure sets the mass: of a single cube, or of a
// comparison beside a reference. Then the choices of the question are its responses.
//
// Magnitude estimation (tasks/Estimation.h) is the case of one cube, with the scales and the
// modulus that the program brings along. What both share is declared here.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/Random.h"
#include "experiment/ScreenTexts.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/Answers.h"
#include "tasks/blocks/BlockKeys.h"
#include "tasks/blocks/Staircases.h"

namespace heft {

/// The valid answers to a question, as numbers.
struct AnswerScale {
  double low = 0, high = 100;
  bool whole = true;
  std::vector<double> points = {};  ///< the only valid ones, in the question's order; empty: all

  bool takes(double value) const;
  /// The nearest valid answer; numbers that need not be whole get three digits of the range.
  double nearest(double value) const;
  /// The value at a fraction of the scale, from low to high.
  double at(double fraction) const { return nearest(low + fraction * (high - low)); }
  /// The same with all points, or all whole numbers, equally likely for fractions in [0, 1).
  double any(double fraction) const;
};

/// The scale of a question; choices are numbered from 1.
AnswerScale scale_of(const FormQuestion& question);

/// How far up a scale a lag is felt: the logarithm of 5 mm plus the lag (Fechner's law), with the
/// end of the scale at 100 mm.
double felt_fraction(double lag_mm);

/// Questionnaire and key of "NAME.KEY"; none: it names no question.
std::optional<std::pair<std::string, std::string>> question_named(const std::string& name);

/// The question that "NAME.KEY" names; none: there is none, or it is not answered on the screen.
std::optional<FormQuestion> find_question(
    const std::map<std::string, Questionnaire>& questionnaires, const std::string& name);

/// The cubes of a trial.
struct CubeSet {
  std::vector<double> masses_g;
  std::vector<double> table_friction = {};  ///< of each; empty: the protocol's
};

struct PlannedCubes {
  CubeSet cubes;
  std::string technique;
};

/// Each set with each technique as often as it has trials, in one random order.
std::vector<PlannedCubes> shuffled(const std::vector<CubeSet>& sets,
                                   const std::vector<TechniqueTrials>& trials, RandomStream stream);

struct Judgment {
  static constexpr std::array actions{ActionSpec{.kind = "judge", .value = true}};
  /// "chosen": the value is a place among the choices, from 1.
  static constexpr std::array<std::string_view, 2> outcomes{"judged", "chosen"};
  static constexpr TaskDeclaration task{
      .name = "judgment",
      .about = "A question of a questionnaire file about one to six cubes",
      .actions = actions,
      .outcomes = outcomes,
      .texts = "validate",
      .trial_s = 15};

  struct Block {
    using OfTask = Judgment;
    std::string name;
    std::vector<double> masses_g;        ///< equal ones are allowed
    std::vector<double> table_friction;  ///< of each; empty: the protocol's friction
    int cubes = 0;                       ///< of a trial; 0: all
    std::vector<TechniqueTrials> trials{{spring_technique, 1}};  ///< of each set of cubes
    std::string condition = spring_technique;                    ///< of staircases
    InterleaveConfig interleaving;
    /// Instead of masses_g: all with a reference, or all of single cubes, whose levels are masses.
    std::vector<ReferenceStaircase> staircases;
    Meanings responses;  ///< responses to the staircases, by choice of the question
    std::string asks;    ///< QUESTIONNAIRE.QUESTION
    /// The question that `asks` names, in the session's language; none: not read yet.
    std::optional<FormQuestion> question;

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"question", "NAME.KEY", true}, asks);
      visit(ConfigKey{"responses", "of its choices to the staircases"}, responses);
      visit(ConfigKey{"staircase", "a procedure, with a reference or without"},
            StaircasesOf{*this});
      visit(ConfigKey{"masses_g", "of the cubes, in g", staircases.empty()}, masses_g, above_zero);
      if (staircases.empty()) return visit_sets(visit);
      visit(ConfigKey{"condition", "technique"}, ByTechnique{condition});
      visit(ConfigKey{"interleave", "order of staircases"}, interleaving);
    }
    template <typename Visit>
    void visit_sets(Visit&& visit) {
      visit(table_friction_key, table_friction, zero_or_more);
      visit(ConfigKey{"cubes", "of a trial: all sets of so many; default: all cubes"}, cubes,
            WholeRange{1, FrameRow::most_cubes});
      visit(ConfigKey{"trials", "of each set of cubes"}, TrialsOfEach{trials, "trials"});
    }
    /// The different sets of `cubes` cubes; none if there are more than a block has trials.
    std::vector<CubeSet> sets() const;
    double expected_trials() const;
    bool depends_on_answers() const { return depend_on_answers(staircases); }
    bool has_reference() const { return !staircases.empty() && staircases[0].reference_g > 0; }
    int most_cubes() const;
    /// Whether every choice is one of two cubes.
    bool is_forced() const;
    StaircaseRules staircase_rules() const;
    /// The response of a completed trial to its staircase.
    Response response_in(const TrialRow& row) const;
    ConfigMistakes check() const;
    std::vector<std::pair<std::string, std::string>> choices() const;
    std::optional<std::string> questionnaire() const;
    void read_question(const std::map<std::string, Questionnaire>& questionnaires) {
      question = find_question(questionnaires, asks);
    }
    /// Why the question does not suit the block; none: it does, or is not read yet.
    std::optional<std::string> mistake_in_question() const;

   private:
    ConfigMistakes mistakes_in_sets() const;
    ConfigMistakes mistakes_in_responses() const;
  };

  using Offer = JudgmentOffer;

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t seed)
        : block_(block),
          order_(shuffled(block.sets(), block.trials,
                          RandomStream(seed, "judgment order/" + block.name))),
          staircases_(block.staircases, block.interleaving) {}
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override {
      return n_completed_ >= order_.size() && staircases_.finished();
    }
    void complete(const TrialRow& row, Changes& changes) override;
    std::optional<std::string> unfinished_staircase() const override {
      return staircases_.unfinished_staircase();
    }

   private:
    TrialPlan plan_of_staircase(const TrialKey& key) const;

    Block block_;
    std::vector<PlannedCubes> order_;  // empty with staircases
    RunningStaircases staircases_;
    std::size_t n_completed_ = 0;
  };

  class Trial : public TaskTrial {
   public:
    Trial(const Block& block, const TrialPlan& plan, std::uint64_t)
        : TaskTrial(task, plan),
          offer_{block.question.value_or(FormQuestion{}), block.responses},
          is_known_(block.question.has_value()) {}
    std::optional<std::string> refusal(const Action& action) const override;
    void take(const Action& action) override;
    void show(ScreenState& screen) const override { screen.offer = offer_; }
    std::string answer() const override;
    std::optional<int> n_answers() const override;

   private:
    Offer offer_;
    bool is_known_;
  };

  /// Whether the answers are numbers: all but choices whose values are not different numbers.
  static bool asks_for_number(const FormQuestion& question);
  /// The scale of its answers: choices have their values as numbers, otherwise their places.
  static AnswerScale scale(const FormQuestion& question);
  /// The choice of an answer; null: it is none.
  static const AnswerChoice* choice_of(const FormQuestion& question, double value);
  /// The number of an answer as the screen gives it.
  static double number_of(const FormQuestion& question, const std::string& given);

  /// A number, or a point of a scale, is the heaviness of one cube, or the difference between the
  /// lightest and the heaviest, both by felt_fraction(). A choice with one answer for each cube is
  /// the heaviest cube; of other choices one is random. Where choices are responses, "left" and
  /// "right" are the heavier cube, "none" and "negative" that two cubes do not differ; a single
  /// cube is "positive" in the upper half of felt_fraction().
  static Answer simulated(const Offer& offer, const Percepts& percepts, RandomStream& stream);
  static Answer blind(const Offer& offer, const WithoutPercepts&, RandomStream& stream);
  static std::vector<ScreenState> fullest_screens();
  /// Defined in view/screens/JudgmentScreen.cpp.
  static void screen(PageBuilder& builder, const Offer& offer);
};

}  // namespace heft
