// Sorting task (paper, 4.1): two to six cubes, each given a label, then validated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/Random.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/BlockKeys.h"

namespace heft {

enum class SortingOrders { random, balanced };
template <>
struct EnumNames<SortingOrders> {
  static constexpr std::array<std::string_view, 2> names{"random", "balanced"};
};

struct Sorting {
  static constexpr std::array actions{
      ActionSpec{.kind = "label", .slot = true, .label = true, .is_step = true},
      ActionSpec{.kind = "unlabel", .slot = true, .is_step = true},
      ActionSpec{.kind = "validate", .after_steps = true}, ActionSpec{.kind = "dont_know"}};
  static constexpr std::array<std::string_view, 9> labels{
      "lightest", "intermediate", "heaviest", "1", "2", "3", "4", "5", "6"};
  static constexpr std::array<std::string_view, 3> outcomes{"correct", "incorrect", "dont_know"};
  static constexpr TaskDeclaration task{
      .name = "sorting",
      .about = "Which cube is lightest, and so on to the heaviest",
      .actions = actions,
      .labels = labels,
      .outcomes = outcomes,
      .texts = "question tap_a_cube lightest intermediate heaviest validate dont_know",
      .trial_s = 25};

  struct Block {
    using OfTask = Sorting;
    std::string name;
    std::vector<double> masses_g;  ///< two to six
    std::vector<TechniqueTrials> trials{{coupled_technique, 5}, {spring_technique, 5}};
    int max_run = 0;  ///< longest run of one technique; 0: no limit
    SortingOrders orders = SortingOrders::random;
    std::vector<double> table_friction{};  ///< of the cube of each mass; empty: the protocol's

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"masses_g", "of a trial's cubes, in g", true}, masses_g, above_zero);
      visit(table_friction_key, table_friction, zero_or_more);
      visit(ConfigKey{"trials", "of each technique"}, trials);
      visit(ConfigKey{"max_run", "longest run of one technique; 0: no limit"}, max_run,
            WholeRange{});
      visit(ConfigKey{"orders", "orders of the cubes"}, orders);
    }
    ConfigMistakes check() const;
    std::vector<std::pair<std::string, std::string>> choices() const;
    double expected_trials() const { return total_of(trials); }
    int n_trials() const { return total_of(trials); }
    int most_cubes() const { return static_cast<int>(masses_g.size()); }
    /// Friction on the table by slot. @param order the block's masses, by slot
    std::vector<double> friction_in(const std::vector<double>& order) const;
  };
  struct Offer {
    std::vector<std::optional<Label>> labels;  ///< assigned so far, by slot
  };

  /// The labels of a trial, lightest first: words for three cubes, otherwise ranks from 1.
  static std::span<const std::string_view> labels_for(int n_cubes);

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t seed);
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override { return n_completed_ >= block_.n_trials(); }
    void complete(const TrialRow&, Changes&) override { ++n_completed_; }

   private:
    Block block_;
    std::vector<std::string> techniques_;  // of each trial
    int n_completed_ = 0;
  };

  class Trial : public TaskTrial {
   public:
    Trial(const Block&, const TrialPlan& plan, std::uint64_t)
        : TaskTrial(task, plan), labels_(plan.masses_g.size()) {}
    std::optional<std::string> refusal(const Action& action) const override;
    void take(const Action& action) override;
    void show(ScreenState& screen) const override;
    std::string answer() const override { return *result_.outcome; }
    std::vector<std::string> labels() const override;
    /// Every order of the cubes, and "I don't know".
    std::optional<int> n_answers() const override;

   private:
    bool all_labeled() const;
    bool labels_are_right() const;

    std::vector<std::optional<Label>> labels_;  // by slot
  };

  static std::optional<bool> is_correct(const TrialRow& row) { return row.outcome == "correct"; }

  static Answer simulated(const Offer&, const Percepts& percepts, RandomStream& stream);
  static Answer blind(const Offer&, const WithoutPercepts& known, RandomStream& stream);
  static std::vector<ScreenState> fullest_screens();
  /// Defined in view/screens/SortingScreen.cpp.
  static void screen(PageBuilder& builder, const Offer& offer);
};

/// Technique of each trial of a block: uniform over all sequences with the given counts and no run
/// longer than max_run (0: no limit).
std::vector<std::string> draw_techniques(const std::vector<TechniqueTrials>& trials, int max_run,
                                         const std::string& block, std::uint64_t seed);

/// Labels by slot that sort the values.
std::vector<Label> labels_in_order(std::span<const double> values);

}  // namespace heft
