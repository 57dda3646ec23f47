#include "tasks/Introduction.h"

namespace heft {

namespace {
TrialPlan arranged(const Introduction::Block& block, const TrialKey& key, int n_shuffles) {
  TrialPlan plan = key.plan(block.name, Introduction::task.name, block.condition);
  plan.masses_g = block.masses_g;
  plan.n_reshuffles = n_shuffles;
  RandomStream stream = key.slots();
  for (int i = 0; i <= n_shuffles; ++i) stream.shuffle(std::span(plan.masses_g));
  return plan;
}
}  // namespace

TrialPlan Introduction::Run::plan(const TrialKey& key) const {
  return arranged(block_, key, 0);
}

void Introduction::Trial::take(const Action& action) {
  if (is_heaviest(*action.slot)) {
    choose(*action.slot);
    result_.outcome = "correct";
    return;
  }
  ++n_wrong_;
  if (block_.wrong_answer == WrongAnswer::reshuffle)
    plan_ = arranged(block_, {seed_, plan_.trial_number, plan_.attempt}, n_wrong_);
}

void Introduction::Trial::show(ScreenState& screen) const {
  screen.offer = Offer{};
  screen.try_again = n_wrong_ > 0;
}

std::string Introduction::Trial::answer() const {
  return result_.outcome ? "heaviest" : "other";
}

Answer Introduction::simulated(const Offer&, const Percepts& percepts, RandomStream&) {
  return {{{"select", heaviest_slot(percepts.remembered_mm, percepts.wrong_slots)}}};
}

Answer Introduction::blind(const Offer&, const WithoutPercepts& known, RandomStream&) {
  return {{{"select", 1 + static_cast<int>(known.wrong_slots.size()) % known.n_slots}}};
}

std::vector<ScreenState> Introduction::fullest_screens() {
  ScreenState screen{.n_slots = 2, .try_again = true};
  screen.offer = Offer{};
  return {screen};
}

}  // namespace heft
