// Introduction (paper, 5.1): one trial with two cubes, which ends when the heavier one is chosen.
#pragma once

#include <string>
#include <vector>

#include "base/Random.h"
#include "tasks/Task.h"
#include "tasks/TaskRun.h"
#include "tasks/blocks/BlockKeys.h"

namespace heft {

/// Arrangement of the cubes after a wrong answer.
enum class WrongAnswer { same_layout, reshuffle };
template <>
struct EnumNames<WrongAnswer> {
  static constexpr std::array<std::string_view, 2> names{"same_layout", "reshuffle"};
};

struct Introduction {
  static constexpr std::array actions{ActionSpec{.kind = "select", .slot = true}};
  static constexpr std::array<std::string_view, 1> outcomes{"correct"};
  static constexpr TaskDeclaration task{
      .name = "introduction",
      .about = "Which of two cubes of very different mass is heavier",
      .actions = actions,
      .outcomes = outcomes,
      .texts = "question try_again",
      .trial_s = 15};

  struct Block {
    using OfTask = Introduction;
    std::string name;
    std::vector<double> masses_g;              ///< two; shuffled
    std::string condition = spring_technique;  ///< name of the technique
    WrongAnswer wrong_answer = WrongAnswer::same_layout;

    template <typename Visit>
    void visit_keys(Visit&& visit) {
      visit(ConfigKey{"masses_g", "of the two cubes, in g", true}, masses_g, above_zero);
      visit(ConfigKey{"condition", "technique"}, ByTechnique{condition});
      visit(ConfigKey{"wrong_answer", "cubes after a wrong answer"}, wrong_answer);
    }
    ConfigMistakes check() const {
      return mistakes_in_cubes(masses_g, {}, 2, 2, "equal ones have no right answer");
    }
    std::vector<std::pair<std::string, std::string>> choices() const {
      return {{"wrong introduction answer", std::string(name_of(wrong_answer))}};
    }
    double expected_trials() const { return 1; }
    int most_cubes() const { return static_cast<int>(masses_g.size()); }
  };
  struct Offer {};

  class Run : public TaskRun {
   public:
    Run(const Block& block, std::uint64_t) : block_(block) {}
    TrialPlan plan(const TrialKey& key) const override;
    bool finished() const override { return finished_; }
    void complete(const TrialRow&, Changes&) override { finished_ = true; }

   private:
    Block block_;
    bool finished_ = false;
  };

  class Trial : public TaskTrial {
   public:
    Trial(const Block& block, const TrialPlan& plan, std::uint64_t seed)
        : TaskTrial(task, plan), block_(block), seed_(seed) {}
    bool ends(const Action& action) const override { return is_heaviest(*action.slot); }
    void take(const Action& action) override;
    void show(ScreenState& screen) const override;
    std::string answer() const override;
    std::optional<int> n_answers() const override { return 2; }

   private:
    Block block_;
    std::uint64_t seed_;
    int n_wrong_ = 0;
  };

  /// On the first try.
  static std::optional<bool> is_correct(const TrialRow& row) {
    return row.first_choice_s == row.validated_s;
  }

  static Answer simulated(const Offer&, const Percepts& percepts, RandomStream&);
  /// Chooses the cubes in turn, from the left.
  static Answer blind(const Offer&, const WithoutPercepts& known, RandomStream&);
  static std::vector<ScreenState> fullest_screens();
  /// Defined in view/screens/IntroductionScreen.cpp.
  static void screen(PageBuilder& builder, const Offer& offer);
};

}  // namespace heft
