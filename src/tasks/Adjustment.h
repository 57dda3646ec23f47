// Method of adjustment (Fechner 1860): the participant makes a comparison as heavy as the reference
// beside it, by steps, and confirms that both are equal.
//
// A step puts both cubes back to their places, the comparison with its new mass. Cubes appear only
// where the effector is clear of them (apparatus/TrialWorld), so that no mass changes while it is
// touched. Each step is an action; the cubes of the log are those shown last.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/Judgment.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/BlockKeys.h"

namespace heft {

struct Adjustment {
  static constexpr std::array actions{
      ActionSpec{.kind = "adjust", .slot = true, .value = true, .is_step = true},
      ActionSpec{.kind = "equal"}};
  static constexpr std::array<std::string_view, 1> outcomes{"adjusted"};
  static constexpr TaskDeclaration task{
      .name = "adjustment",
      .about = "A cube made as heavy as another one, by steps",
      .actions = actions,
      .outcomes = outcomes,
      .texts = "question much_lighter lighter heavier much_heavier equal",
      .trial_s = 60};

  struct Block {
    using OfTask = Adjustment;
    std::string name;
    ValueGrid reference_g;
    std::vector<double> start_g;  ///< the range from which the comparison's first mass is drawn
    std::vector<double> steps_g;  ///< the coarse and the fine step
    std::vector<TechniqueTrials> trials{{spring_technique, 1}};  ///< of each reference

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"reference_g", "one or more references, in g", true}, reference_g,
            above_zero);
      visit(ConfigKey{"start_g", "range of the comparison's first mass, in g", true}, start_g,
            above_zero);
      visit(ConfigKey{"steps_g", "the coarse and the fine step, in g", true}, steps_g, above_zero);
      visit(ConfigKey{"trials", "of each reference"}, TrialsOfEach{trials, "trials"});
    }
    /// The fine step, and twice the largest mass that the protocol names.
    double lowest_g() const { return steps_g.back(); }
    double highest_g() const;
    double expected_trials() const {
      return static_cast<double>(reference_g.values.size()) * total_of(trials);
    }
    int most_cubes() const { return 2; }
    ConfigMistakes check() const;
    Choices choices() const;
  };

  struct Step {
    double change_g = 0;
    bool is_possible = true;  ///< false: the mass would leave its limits
  };
  struct Offer {
    int slot = 2;             ///< of the comparison
    std::vector<Step> steps;  ///< from the largest decrease to the largest increase
    int n_turns = 0;          ///< how often the steps have changed direction
  };

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t seed);
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override { return n_completed_ >= order_.size(); }
    void complete(const TrialRow&, Changes&) override { ++n_completed_; }

   private:
    Block block_;
    std::vector<PlannedCubes> order_;  // of each trial its reference
    std::size_t n_completed_ = 0;
  };

  class Trial : public TaskTrial {
   public:
    Trial(const Block& block, const TrialPlan& plan, std::uint64_t)
        : TaskTrial(task, plan), block_(block) {}
    std::optional<std::string> refusal(const Action& action) const override;
    void take(const Action& action) override;
    void show(ScreenState& screen) const override;
    std::string answer() const override;

   private:
    int slot() const { return plan_.reference_slot == 1 ? 2 : 1; }
    double mass_g() const { return plan_.masses_g[static_cast<std::size_t>(slot() - 1)]; }
    double after_g(double change_g) const;
    bool is_possible(double change_g) const;

    Block block_;
    double last_change_g_ = 0;  // 0: none yet
    int n_turns_ = 0;
  };

  /// Steps towards equality as long as the percepts differ, with the coarse step until the
  /// direction changes for the first time. Where steps skip the equal masses, it confirms after the
  /// third change of direction. A lapse is one of the possible actions at random.
  static Answer simulated(const Offer& offer, const Percepts& percepts, RandomStream& stream);
  /// Confirms the first mass.
  static Answer blind(const Offer&, const WithoutPercepts&, RandomStream&);
  static std::vector<ScreenState> fullest_screens();
  /// Defined in view/screens/AdjustmentScreen.cpp.
  static void screen(PageBuilder& builder, const Offer& offer);
};

}  // namespace heft
