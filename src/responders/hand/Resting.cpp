#include <functional>
#include <optional>
#include <vector>

#include "base/Random.h"
#include "responders/Responder.h"
#include "responders/ResponderParameters.h"
#include "responders/decision/Answering.h"
#include "responders/decision/Decision.h"
#include "responders/decision/KnownPlan.h"
#include "responders/hand/Hand.h"

namespace heft {

namespace {
constexpr double hover_m = 0.005;
constexpr double tap_interval_s = 0.7;

/// Answers a trial.
/// @param wrong_slots incorrect choices so far, oldest first, if the task asks again
using DecisionModel = std::function<Answer(std::span<const int> wrong_slots)>;
/// Creates the decision model of one trial.
using MakeDecisionModel = std::function<DecisionModel(const TrialView& trial)>;

class Resting : public Responder {
 public:
  Resting(std::uint64_t seed, MakeDecisionModel make_model, bool knows_plan = false)
      : seed_(seed), make_model_(std::move(make_model)), knows_plan_(knows_plan) {}

  void begin_trial(const TrialView& trial) override {
    rest_ = resting_pose(trial.stage, hover_m);
    model_ = make_model_(trial);
    answering_.emplace(seed_, trial, tap_interval_s);
    delays_ = trial_stream(seed_, "delay", trial);
  }

  void see_rearranged(const TrialView& trial) override { model_ = make_model_(trial); }

  HandSample hand(double) override { return {rest_, true}; }

  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) override {
    const bool to_answer = answering_->free() && answering_->cubes_seen();
    if (to_answer && screen.screen == Screen::trial)
      answering_->give(model_(answering_->wrong_slots()), frame.t_s + 1 + delays_->uniform());
    return answering_->see(frame, screen);
  }

  bool has_more(double t_s) const override { return !answering_->gave_up(t_s); }

  bool knows_plan() const override { return knows_plan_; }

  std::optional<Answer> judge(const TrialView& trial, std::span<const DisplayedFrame>,
                              std::span<const int> wrong_slots) const override {
    return make_model_(trial)(wrong_slots);
  }

  std::optional<std::string> answer(const FormQuestion& question,
                                    const std::string& key) const override {
    return any_answer_to(question, seed_, key);
  }

 private:
  std::uint64_t seed_;
  MakeDecisionModel make_model_;
  bool knows_plan_;
  Pose rest_;
  DecisionModel model_;
  std::optional<Answering> answering_;
  std::optional<RandomStream> delays_;
};

// Finds a difference with a fixed probability.
std::unique_ptr<Responder> make_blind(std::uint64_t seed, double p_different) {
  return std::make_unique<Resting>(seed, [=](const TrialView& trial) -> DecisionModel {
    RandomStream stream = trial_stream(seed, "blind answer", trial);
    return [trial, p_different, stream](std::span<const int> wrong_slots) mutable {
      const bool differ = stream.coin(p_different);
      return blind_answer(trial, {trial.stage.n_slots(), differ, wrong_slots}, stream);
    };
  });
}

using PlanAnswer = Answer (*)(const ResponderParameters& parameters, const TrialView& trial,
                              std::span<const int> wrong_slots, RandomStream& stream);

std::unique_ptr<Responder> make_informed(std::uint64_t seed, const ResponderParameters& parameters,
                                         PlanAnswer answer) {
  return std::make_unique<Resting>(
      seed,
      [=](const TrialView& trial) -> DecisionModel {
        RandomStream stream = trial_stream(seed, "informed answer", trial);
        return [=](std::span<const int> wrong_slots) mutable {
          return answer(parameters, trial, wrong_slots, stream);
        };
      },
      true);
}
}  // namespace

std::unique_ptr<Responder> make_always_yes(const ResponderOptions& options) {
  return make_blind(options.seed, 1);
}

std::unique_ptr<Responder> make_always_no(const ResponderOptions& options) {
  return make_blind(options.seed, 0);
}

std::unique_ptr<Responder> make_coin(const ResponderOptions& options) {
  return make_blind(options.seed, participant_parameters(options, coin_parts).p);
}

std::unique_ptr<Responder> make_criterion_only(const ResponderOptions& options) {
  const auto parameters = participant_parameters(options, criterion_only_parts);
  return std::make_unique<Resting>(
      options.seed, [seed = options.seed, parameters](const TrialView& trial) -> DecisionModel {
        const std::vector<double> nothing(trial.stage.slots_m.size(), 0.0);
        return [decision = Decision(parameters, seed, trial),
                nothing](std::span<const int> wrong_slots) mutable {
          return decision.decide(nothing, wrong_slots);
        };
      });
}

std::unique_ptr<Responder> make_start_anchored(const ResponderOptions& options) {
  return make_informed(options.seed, participant_parameters(options, start_anchored_parts),
                       start_anchored_answer);
}

std::unique_ptr<Responder> make_weber(const ResponderOptions& options) {
  return make_informed(options.seed, participant_parameters(options, weber_parts), weber_answer);
}

}  // namespace heft
