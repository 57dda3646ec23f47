// Runs a responder through whole trials of the fake world, with a fake screen that records every
// action it does not allow.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "FakeWorld.h"
#include "experiment/EventPayloads.h"
#include "experiment/ScreenState.h"
#include "responders/Responder.h"
#include "tasks/Offers.h"

namespace heft::fake {

struct TrialSetup {
  Task task = "sorting";
  std::string condition = "C2";
  std::vector<double> masses_g{15, 200, 800};
  int trial_number = 1;
  int attempt = 1;
  double rate_hz = 15;
  bool clone_drawn = true;
  double paused_from_s = 0, paused_to_s = 0;
  bool takes_answers = true;  ///< false: the screen ignores every action
  double at_most_s = 300;
  std::optional<bool> last_differed = {};
  std::optional<double> level_g = {}, start_g = {};  ///< for responders that know the plan
};

struct Result {
  std::vector<TimedAction> actions;
  std::vector<Pose> hand;  ///< at each picture
  bool ended = false;
  double end_s = 0;
  bool correct = false;
  bool answered = false;  ///< not "no difference" or "I don't know"
  int n_side_hits = 0, n_returned = 0;
  std::vector<int> n_pushes;
  std::vector<std::string> not_allowed;
};

/// The actions as texts, without their times.
inline std::vector<std::string> said(const Result& result) {
  std::vector<std::string> all;
  for (const TimedAction& action : result.actions)
    all.push_back(fmt::format("{} {} {}", name_of(action.kind), action.slot.value_or(0),
                              action.label ? name_of(*action.label) : ""));
  return all;
}

class Trial {
 public:
  Trial(Responder& responder, const TrialSetup& setup)
      : responder_(responder),
        setup_(setup),
        stage_(row_of(static_cast<int>(setup.masses_g.size()), setup.rate_hz)),
        world_(stage_, setup.condition, setup.masses_g, setup.clone_drawn) {
    screen_.screen = Screen::trial;
    screen_.task = setup.task;
    if (setup.task == "sorting") labels_on(screen_).resize(setup.masses_g.size());
    TrialView view{setup.trial_number, setup.attempt, setup.task, stage_, {}, setup.last_differed};
    if (responder.knows_plan())
      view.truth = TrialTruth{setup.masses_g, setup.level_g, setup.start_g};
    responder.begin_trial(view);
  }

  Result run() {
    const int between = 16;  // hand poses a picture
    for (int i = 0;; ++i) {
      const double t_s = i / setup_.rate_hz;
      for (int k = between - 1; k >= 0; --k)
        world_.move_effector(
            responder_.hand(std::max(0.0, t_s - k / (between * setup_.rate_hz))).pose);
      if (i == 2) world_.show_cubes();
      result_.hand.push_back(world_.picture(t_s).effector);
      see(t_s);
      if (result_.ended || !responder_.has_more(t_s) || t_s > setup_.at_most_s) break;
    }
    result_.n_side_hits = world_.n_side_hits();
    result_.n_returned = world_.n_returned();
    result_.n_pushes = world_.n_pushes();
    return result_;
  }

 private:
  void see(double t_s) {
    const bool paused = t_s >= setup_.paused_from_s && t_s < setup_.paused_to_s;
    screen_.screen = paused ? Screen::paused : Screen::trial;
    const ScreenState shown = screen_;
    for (const TimedAction& action : responder_.see(world_.picture(t_s), shown)) {
      check(action, t_s, shown);
      result_.actions.push_back(action);
      if (setup_.takes_answers) take(action);
    }
    result_.end_s = t_s;
  }

  void check(const TimedAction& action, double t_s, const ScreenState& shown) {
    const auto refuse = [&](const char* why) {
      result_.not_allowed.push_back(fmt::format("{} at {}: {}", name_of(action.kind), t_s, why));
    };
    if (result_.ended) refuse("after the end");
    if (shown.screen != Screen::trial) refuse("while paused");
    if (action.t_s < t_s || action.t_s >= t_s + 1 / setup_.rate_hz) refuse("outside the picture");
    if (action.kind == "validate" && !shown.can_validate) refuse("not offered");
    if (!result_.actions.empty() && action.t_s < result_.actions.back().t_s + 0.299)
      refuse("too soon after the last one");
    const bool chooses = action.kind == "select";
    const bool none = action.kind == "no_difference";
    if (setup_.task == "sorting" ? (chooses || none) : !(chooses || none)) refuse("other task");
    if (setup_.task == "introduction" && none) refuse("other task");
  }

  void take(const TimedAction& action) {
    if (action.kind == "select") return select(*action.slot);
    if (action.kind == "validate") return end(true, sorted());
    if (action.kind != "label") return end(false, false);
    ++screen_.n_choices;
    for (auto& label : labels_on(screen_))
      if (label == action.label) label.reset();
    labels_on(screen_)[static_cast<std::size_t>(*action.slot - 1)] = action.label;
    screen_.can_validate =
        std::ranges::all_of(labels_on(screen_), [](const auto& l) { return l.has_value(); });
  }

  void select(int slot) {
    ++screen_.n_choices;
    const auto heaviest = std::ranges::max_element(setup_.masses_g) - setup_.masses_g.begin();
    const bool right = slot == heaviest + 1;
    screen_.try_again = setup_.task == "introduction" && !right;
    if (!screen_.try_again) end(true, right);
  }

  bool sorted() const {
    const auto labels = labels_on(screen_);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto lighter = std::ranges::count_if(
          setup_.masses_g, [&](double mass_g) { return mass_g < setup_.masses_g[i]; });
      if (labels[i] != Sorting::labels[static_cast<std::size_t>(lighter)]) return false;
    }
    return true;
  }

  void end(bool answered, bool correct) {
    result_.ended = true;
    result_.answered = answered;
    result_.correct = correct;
  }

  Responder& responder_;
  TrialSetup setup_;
  Stage stage_;
  World world_;
  ScreenState screen_;
  Result result_;
};

inline Result run_trial(Responder& responder, const TrialSetup& setup) {
  return Trial(responder, setup).run();
}

inline std::unique_ptr<Responder> make(std::string_view name, std::uint64_t seed,
                                       std::vector<Parameter> parameters = {}) {
  return responder_named(name).make({seed, std::move(parameters), ""});
}

}  // namespace heft::fake
