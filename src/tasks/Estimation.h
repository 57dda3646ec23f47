// Magnitude estimation: one cube a trial, and a number for how heavy it feels. The number is typed,
// set on a slider, or the answer to a question of a questionnaire file.
//
// With a modulus (Stevens 1956, Am. J. Psychol. 69: "the standard and its number") the block begins
// with one trial that shows the standard's cube and its number and asks for nothing; it counts as
// practice. The number is named on the screen of every later trial.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/Random.h"
#include "experiment/ScreenTexts.h"
#include "tasks/BlockKeys.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"

namespace heft {

struct Estimation {
  static constexpr std::array actions{ActionSpec{.kind = "estimate", .value = true},
                                      ActionSpec{.kind = "validate"}};
  static constexpr std::array<std::string_view, 2> outcomes{"estimated", "shown"};
  static constexpr TaskDeclaration task{
      .name = "estimation",
      .about = "A number for how heavy a cube feels",
      .actions = actions,
      .outcomes = outcomes,
      .texts = "question standard standard_was lightest heaviest validate",
      .trial_s = 12};

  /// The standard, and the number that stands for it.
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
    std::vector<double> masses_g;                                ///< different, in random order
    std::vector<TechniqueTrials> trials{{spring_technique, 1}};  ///< of each mass
    std::string scale = "number";     ///< "number", "slider" (0 to 100) or QUESTIONNAIRE.QUESTION
    std::optional<double> low, high;  ///< number: the range that can be typed
    std::optional<Modulus> modulus;   ///< number: shown first, with the first technique
    /// The question that `scale` names, in the words of the session's language; none: not yet
    /// known.
    std::optional<FormQuestion> question;

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"masses_g", "one a trial, in g", true}, masses_g, above_zero);
      visit(ConfigKey{"trials", "of each mass"}, TrialsOfEachMass{trials});
      visit(ConfigKey{"scale", "number, slider or NAME.KEY", true}, scale);
      visit(ConfigKey{"low", "least number"}, low, any_number);
      visit(ConfigKey{"high", "largest number"}, high, any_number);
      visit(ConfigKey{"modulus", "the standard"}, modulus);
    }
    int n_trials() const;
    double expected_trials() const { return n_trials(); }
    int most_cubes() const { return 1; }
    ConfigMistakes check() const;
    std::vector<std::pair<std::string, std::string>> choices() const;
    /// The questionnaire that it asks of; none: it asks of none.
    std::optional<std::string> questionnaire() const;
    /// Takes the question that `scale` names, where it is there and is answered on the screen.
    void read_question(const std::map<std::string, Questionnaire>& questionnaires);
  };

  struct Offer {
    FormQuestion question;  ///< what is asked; without words: those of the trial's page
    std::optional<Modulus> modulus = {};
    bool is_standard = false;  ///< the standard is shown, nothing is asked
  };

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t seed);
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override { return n_completed_ >= block_.n_trials(); }
    void complete(const TrialRow&, Changes&) override { ++n_completed_; }

   private:
    struct Stimulus {
      double mass_g = 0;
      std::string technique;
    };
    Block block_;
    std::vector<Stimulus> order_;  // without the standard
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

  /// With a modulus: the mass that the remembered lag is of under the paper's spring and friction
  /// (4.2), over the modulus' mass, times its value. Without: equal ratios of 5 mm plus the lag are
  /// equal steps on the scale (Fechner's law), which ends at 100 mm. Noise is that of the percept
  /// alone; a lapse is any place on the scale.
  static Answer simulated(const Offer& offer, const Percepts& percepts, RandomStream&);
  /// Any place on the scale.
  static Answer blind(const Offer& offer, const WithoutPercepts&, RandomStream& stream);
  static std::vector<ScreenState> fullest_screens();
  /// The participant's (view/screens/EstimationScreen.cpp).
  static void screen(PageBuilder& builder, const Offer& offer);
};

}  // namespace heft
