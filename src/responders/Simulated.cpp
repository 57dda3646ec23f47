#include <numeric>
#include <optional>
#include <vector>

#include "responders/Responder.h"
#include "responders/ResponderParameters.h"
#include "responders/decision/Answering.h"
#include "responders/decision/Decision.h"
#include "responders/hand/Hand.h"
#include "responders/perception/Perception.h"

namespace heft {

namespace {
// By about this much, offsets of equal cubes differ from stroke to stroke.
constexpr double ideal_criterion_mm = 0.3, ideal_criterion_fraction = 0.03;

/// State of one trial.
struct SimulatedTrial {
  SimulatedTrial(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial)
      : hand(parameters, seed, trial),
        perception(parameters, seed, trial),
        decision(parameters, seed, trial),
        answering(seed, trial, parameters.tap_interval_s) {
    std::vector<int> all(trial.stage.slots_m.size());
    std::iota(all.begin(), all.end(), 0);
    hand.explore(all);
    cubes = all;
  }

  Hand hand;
  Perception perception;
  Decision decision;
  Answering answering;
  std::vector<int> cubes;
  bool looked_twice = false;  ///< at cubes that it had missed
  bool answered = false;      ///< since the last exploration began
};

class Simulated : public Responder {
 public:
  Simulated(std::uint64_t seed, const ResponderParameters& parameters)
      : seed_(seed), parameters_(parameters) {}

  void begin_trial(const TrialView& trial) override { trial_.emplace(parameters_, seed_, trial); }

  void see_rearranged(const TrialView& trial) override { trial_->decision.offer(trial.offer); }

  HandSample hand(double t_s) override { return {trial_->hand.at(t_s), true}; }

  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) override {
    SimulatedTrial& trial = *trial_;
    if (screen.screen == Screen::trial) {
      trial.perception.see(frame);
      trial.hand.see(frame);
      if (trial.answering.free() && trial.hand.done(frame.t_s)) look_again_or_answer(frame.t_s);
    }
    return trial.answering.see(frame, screen);
  }

  bool has_more(double t_s) const override { return !trial_->answering.gave_up(t_s); }

  std::optional<Answer> judge(const TrialView& trial, std::span<const DisplayedFrame> frames,
                              std::span<const int> wrong_slots) const override {
    Perception perception(parameters_, seed_, trial);
    for (const DisplayedFrame& frame : frames) perception.see(frame);
    return Decision(parameters_, seed_, trial).decide(perception.percepts_mm(), wrong_slots);
  }

  const ResponderParameters* hand_parameters() const override { return &parameters_; }

  std::optional<std::string> answer(const FormQuestion& question,
                                    const std::string& key) const override {
    return any_answer_to(question, seed_, key);
  }

 private:
  void look_again_or_answer(double t_s) {
    SimulatedTrial& trial = *trial_;
    if (trial.answered) return set_out_again();
    const std::vector<int> missed = trial.perception.not_looked_at();
    if (!missed.empty() && !trial.looked_twice) {
      trial.looked_twice = true;
      return trial.hand.explore(missed);
    }
    const auto percepts_mm = trial.perception.percepts_mm();
    const Answer answer = trial.decision.decide(percepts_mm, trial.answering.wrong_slots());
    trial.answering.give(answer, t_s + parameters_.think_s);
    trial.answered = true;
  }

  // The last answer was wrong or refused.
  void set_out_again() {
    SimulatedTrial& trial = *trial_;
    trial.perception.forget();
    trial.hand.explore(trial.cubes);
    trial.answered = false;
    trial.looked_twice = false;
  }

  std::uint64_t seed_;
  ResponderParameters parameters_;
  std::optional<SimulatedTrial> trial_;
};
}  // namespace

std::unique_ptr<Responder> make_simulated(const ResponderOptions& options) {
  return std::make_unique<Simulated>(options.seed,
                                     participant_parameters(options, simulated_parts));
}

std::unique_ptr<Responder> make_ideal(const ResponderOptions& options) {
  using P = ResponderParameters;
  ResponderParameters parameters = participant_parameters(options, ideal_parts);
  parameters.cue = Cue::sliding_offset;
  for (double P::*const none :
       {&P::moved_share, &P::just_visible_mm, &P::localization_noise_mm, &P::length_noise,
        &P::integration_s, &P::memory_noise, &P::haptic_noise_mm, &P::judgment_noise_mm,
        &P::guess_probability, &P::lapse_rate, &P::correction_probability})
    parameters.*none = 0;
  parameters.criterion_mm = ideal_criterion_mm;
  parameters.criterion_fraction = ideal_criterion_fraction;
  return std::make_unique<Simulated>(options.seed, parameters);
}

}  // namespace heft
