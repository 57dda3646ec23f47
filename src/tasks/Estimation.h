// Magnitude estimation: one cube per trial, and a number for its felt weight, typed, set on a
// slider or given as the answer to a question of a questionnaire file.
//
// With a modulus (Stevens 1956, Am. J. Psychol. 69) the block starts with a practice trial that
// shows the standard and its number without a question; later trials repeat the number.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/Random.h"
#include "experiment/ScreenTexts.h"
#include "tasks/Judgment.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/BlockKeys.h"

namespace heft {

struct Estimation {
  static constexpr std::array actions{ActionSpec{.kind = "estimate", .value = true},
                                      ActionSpec{.kind = "validate"}};
  static constexpr std::array<std::string_view, 2> outcomes{"estimated", "shown"};
  static constexpr TaskDeclaration task{
      .name = "estimation",
      .about = "How heavy a cube feels, as a number",
      .actions = actions,
      .outcomes = outcomes,
      .texts = "question standard standard_was lightest heaviest validate",
      .trial_s = 12};

  /// The standard and its number.
  struct Modulus {
    double mass_g = 0;
    double value = 0;

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"mass_g", "of the standard", true}, mass_g, above_zero);
      visit(ConfigKey{"value", "its number", true}, value, any_number);
    }
  };

  struct Block {
    using OfTask = Estimation;
    std::string name;
    std::vector<double> masses_g;        ///< shown in random order; equal ones differ in friction
    std::vector<double> table_friction;  ///< of each; empty: the protocol's friction
    std::vector<TechniqueTrials> trials{{spring_technique, 1}};  ///< per mass
    std::string scale = "number";     ///< "number", "slider" (0 to 100) or QUESTIONNAIRE.QUESTION
    std::optional<double> low, high;  ///< number: range of valid answers
    std::optional<Modulus> modulus;   ///< number: shown first, with the first technique
    /// The question that `scale` names, in the session's language; none: not read yet.
    std::optional<FormQuestion> question;

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"masses_g", "one per trial, in g", true}, masses_g, above_zero);
      visit(table_friction_key, table_friction, zero_or_more);
      visit(ConfigKey{"trials", "per mass"}, TrialsOfEach{trials, "trials_per_mass"});
      visit(ConfigKey{"scale", "number, slider or NAME.KEY", true}, scale);
      visit(ConfigKey{"low", "smallest number"}, low, any_number);
      visit(ConfigKey{"high", "largest number"}, high, any_number);
      visit(ConfigKey{"modulus", "the standard"}, modulus);
    }
    int n_trials() const;
    double expected_trials() const { return n_trials(); }
    int most_cubes() const { return 1; }
    ConfigMistakes check() const;
    std::vector<std::pair<std::string, std::string>> choices() const;
    /// The questionnaire that `scale` names, if any.
    std::optional<std::string> questionnaire() const;
    /// Copies the question that `scale` names, if present and answered on the screen.
    void read_question(const std::map<std::string, Questionnaire>& questionnaires) {
      if (auto found = find_question(questionnaires, scale)) question = std::move(found);
    }
  };

  struct Offer {
    FormQuestion question;  ///< empty texts: use those of the trial's page
    std::optional<Modulus> modulus = {};
    bool is_standard = false;  ///< the standard is shown without a question
  };

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t seed);
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override { return n_completed_ >= block_.n_trials(); }
    void complete(const TrialRow&, Changes&) override { ++n_completed_; }

   private:
    Block block_;
    std::vector<PlannedCubes> order_;  // without the standard
    int n_completed_ = 0;
  };

  class Trial : public TaskTrial {
   public:
    Trial(const Block& block, const TrialPlan& plan, std::uint64_t);
    std::optional<std::string> refusal(const Action& action) const override;
    void take(const Action& action) override;
    void show(ScreenState& screen) const override { screen.offer = offer_; }
    std::string answer() const override;

   private:
    Offer offer_;
    bool is_range_known_;
  };

  /// With a modulus: its value times the ratio of the mass that causes the remembered lag with the
  /// paper's spring and friction (4.2) to the modulus' mass. Without: by felt_fraction(). The
  /// percept is the only noise; a lapse is uniform on the scale.
  static Answer simulated(const Offer& offer, const Percepts& percepts, RandomStream&);
  static Answer blind(const Offer& offer, const WithoutPercepts&, RandomStream& stream);
  static std::vector<ScreenState> fullest_screens();
  /// Defined in view/screens/EstimationScreen.cpp.
  static void screen(PageBuilder& builder, const Offer& offer);
};

}  // namespace heft
