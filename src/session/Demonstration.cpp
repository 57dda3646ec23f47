#include "session/Demonstration.h"

#include "base/Random.h"

namespace heft {

namespace {
constexpr double mass_g = 200;  // any: a coupled clone moves all alike

TrialPlan plan_of_demonstration() {
  TrialPlan plan;
  plan.block = "demonstration";
  plan.condition = Condition::C1;
  plan.masses_g = {mass_g, mass_g, mass_g};
  return plan;
}

std::unique_ptr<Responder> hand_for(std::uint64_t seed) {
  ResponderOptions options;
  options.seed = RandomStream(seed, "demonstration").bits();
  return responder_named("simulated").make(options);
}
}  // namespace

Demonstration::Demonstration(const Protocol& protocol, std::uint64_t seed)
    : step_s_(1 / protocol.display_rate_hz),
      hand_(hand_for(seed)),
      world_(protocol, plan_of_demonstration()) {
  hand_->begin_trial({0, 1, Task::sorting, stage_of(protocol, 3)});
}

ViewPicture Demonstration::at(double t_s) {
  for (; count_ * step_s_ <= t_s; ++count_) {
    const double picture_s = count_ * step_s_;
    const HandSample hand = hand_->hand(picture_s);
    const auto pose = hand.in_view ? std::optional(hand.pose) : std::nullopt;
    last_.frame = world_.advance(sample_of(picture_s, pose)).frame;
    // It looks again and again: what it would answer is not taken.
    ScreenState screen;
    screen.screen = Screen::trial;
    screen.labels.resize(3);
    hand_->see(last_.frame, screen);
  }
  return last_;
}

}  // namespace heft
