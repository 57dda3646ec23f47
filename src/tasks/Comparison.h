// Comparison task (paper, 4.2): which of two cubes, a reference and a comparison, is heavier, or no
// difference. Other answers: tasks/blocks/Answers.h.
//
// The reference may be a real object beside the board. The participant lifts it, reports to have
// lifted it, and compares it with the only cube.
//
// Levels come from interleaved staircases. Catch trials have a difference of 0 and update no
// staircase. A fixed number of them is drawn in shuffled blocks, so that each participant gets the
// planned number for each reference, spread over the session.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/Random.h"
#include "psychophysics/ProcedureTypes.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/Answers.h"
#include "tasks/blocks/BlockKeys.h"
#include "tasks/blocks/Staircases.h"

namespace heft {

/// Which answers are positive, that is, move the staircase down.
enum class PositiveAnswer { any_choice, correct_choice };
template <>
struct EnumNames<PositiveAnswer> {
  static constexpr std::array<std::string_view, 2> names{"any_choice", "correct_choice"};
};

/// Side of the reference: random in each trial, or equally often left and right in every four
/// trials of a staircase (and of the catch trials), in random order.
enum class Sides { random, balanced };
template <>
struct EnumNames<Sides> {
  static constexpr std::array<std::string_view, 2> names{"random", "balanced"};
};

/// Number of catch trials with a reference.
struct ReferenceCatchTrials {
  double reference_g = 0;
  int trials = 0;
};

/// The keys of a block's catch trials.
template <typename Block>
struct CatchTrials {
  Block& block;
};
template <typename Block>
CatchTrials(Block&) -> CatchTrials<Block>;

struct Comparison {
  static constexpr std::array actions{
      ActionSpec{.kind = "select", .slot = true}, ActionSpec{.kind = "no_difference"},
      ActionSpec{.kind = "different"}, ActionSpec{.kind = "lifted", .is_step = true},
      ActionSpec{.kind = "select_object"}};
  static constexpr std::array<std::string_view, 2> outcomes{"difference", "no_difference"};
  /// Wordings with a real object, by ComparisonAnswers.
  static constexpr std::array<std::string_view, 3> real_wordings{"object", "object_heavier",
                                                                 "object_same_different"};
  static constexpr std::array wordings{
      Wording{name_of(ComparisonAnswers::heavier)},
      Wording{name_of(ComparisonAnswers::same_different), "question_same_different same different"},
      Wording{real_wordings[0], "question_object lift lifted cube"},
      Wording{real_wordings[1], "question_object lift lifted cube"},
      Wording{real_wordings[2], "question_object_same lift lifted same different"}};
  static constexpr TaskDeclaration task{
      .name = "comparison",
      .edition = 3,  // "different" was added, then "lifted" and "select_object"
      .about = "Which of two cubes is heavier, or is there no difference",
      .actions = actions,
      .outcomes = outcomes,
      .texts = "question no_difference",
      .trial_s = 10,
      .detects = true,
      .wordings = wordings};

  struct Block {
    using OfTask = Comparison;
    std::string name;
    std::string condition = spring_technique;  ///< name of the technique
    ComparisonAnswers answers = ComparisonAnswers::heavier_or_none;
    // Catch trials: either a random fraction of trials, or fixed numbers, one in every
    // `catch_every` trials and none among the first three; the rest after the last staircase.
    double catch_fraction = 0;
    std::vector<ReferenceCatchTrials> catch_trials;
    int catch_every = 7;
    Sides sides = Sides::random;
    PositiveAnswer positive_answer = PositiveAnswer::any_choice;
    std::optional<RealObject> reference;  ///< none: a cube
    InterleaveConfig interleaving;
    std::vector<ReferenceStaircase> staircases;

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"condition", "technique"}, ByTechnique{condition});
      visit(ConfigKey{"answers", "what may be answered"}, answers);
      visit(ConfigKey{"positive_answer", "answers that move a staircase down"}, positive_answer);
      visit(ConfigKey{"sides", "of the reference"}, sides);
      visit(ConfigKey{"reference", "a real object that is lifted"}, reference);
      visit(ConfigKey{"interleave", "order of staircases"}, interleaving);
      visit(ConfigKey{"staircase", "a procedure and its reference", true}, StaircasesOf{*this});
      visit(ConfigKey{"catch_fraction", "random fraction of trials"}, catch_fraction,
            Range{0, 1, false, true});
      visit(ConfigKey{"catch_trials", "fixed numbers of trials"}, CatchTrials{*this});
    }
    ConfigMistakes check() const;
    std::vector<std::pair<std::string, std::string>> choices() const;
    StaircaseRules staircase_rules() const;
    double expected_staircase_trials() const;  ///< without catch trials
    double expected_trials() const;
    bool depends_on_answers() const { return depend_on_answers(staircases); }
    int most_cubes() const { return reference ? 1 : 2; }
    double trial_s() const { return reference ? 15 : task.trial_s; }
    /// The block without catch trials and with random sides: staircases do not advance in practice.
    Block for_practice() const;
    bool is_forced() const { return answers == ComparisonAnswers::heavier; }
    bool has_three_answers() const { return answers == ComparisonAnswers::heavier_or_none; }
    std::string_view wording() const {
      if (reference) return real_wordings[static_cast<std::size_t>(answers)];
      return has_three_answers() ? std::string_view() : name_of(answers);
    }
  };
  struct Offer {
    ComparisonAnswers answers = ComparisonAnswers::heavier_or_none;
    std::string object = {};  ///< name of the real object; empty: there is none
    bool was_lifted = false;
  };

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t seed);
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override;
    void complete(const TrialRow& row, Changes& changes) override;
    std::optional<std::string> unfinished_staircase() const override {
      return staircases_.unfinished_staircase();
    }

   private:
    std::optional<double> catch_reference_g(std::uint64_t seed) const;
    std::size_t staircase_of(double reference_g, RandomStream& stream) const;
    int reference_slot(const TrialKey& key, const TrialPlan& plan, int n_before) const;

    Block block_;
    RunningStaircases staircases_;
    int n_completed_ = 0, n_caught_ = 0;  // trials, and catch trials among them
  };

  class Trial : public TaskTrial {
   public:
    Trial(const Block& block, const TrialPlan& plan, std::uint64_t)
        : TaskTrial(task, plan),
          answers_(block.answers),
          object_(block.reference ? block.reference->name : "") {}
    std::optional<std::string> refusal(const Action& action) const override;
    void take(const Action& action) override;
    void show(ScreenState& screen) const override;
    std::string answer() const override;
    std::optional<int> n_answers() const override {
      return answers_ == ComparisonAnswers::heavier_or_none ? 3 : 2;
    }
    bool detects() const override { return answers_ != ComparisonAnswers::heavier; }
    std::optional<bool> answered_different() const override {
      return detects() ? std::optional(result_.outcome == "difference") : std::nullopt;
    }

   private:
    bool has_object() const { return !object_.empty(); }
    void choose_of_two(int slot);

    ComparisonAnswers answers_;
    std::string object_;  // empty: none
    bool was_lifted_ = false;
  };

  /// The response that a completed trial gives to its procedure.
  static Response response_in(const TrialRow& row, PositiveAnswer positive_answer,
                              ComparisonAnswers answers = ComparisonAnswers::heavier_or_none);

  /// None for equal masses.
  static std::optional<bool> is_correct(const TrialRow& row);

  /// A real object is lifted before the answer.
  static Answer simulated(const Offer&, const Percepts& percepts, RandomStream& stream);
  static Answer blind(const Offer&, const WithoutPercepts& known, RandomStream& stream);
  static std::vector<ScreenState> fullest_screens();
  /// Defined in view/screens/ComparisonScreen.cpp.
  static void screen(PageBuilder& builder, const Offer& offer);
};

}  // namespace heft
