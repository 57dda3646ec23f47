#include "session/SurrogateAttempt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apparatus/TrialWorld.h"
#include "responders/ResponderParameters.h"
#include "session/AttemptRun.h"

namespace heft {

namespace {
constexpr double rising_m = 1e-9;

// The hand's pose on the middle line of a cube, square to it.
Pose squared(Pose hand, const Eigen::Quaterniond& straight, double middle_x_m) {
  hand.position_m.x() = middle_x_m;
  hand.orientation = straight;
  return hand;
}
}  // namespace

void SurrogateAttempt::run(const TrialPlan& plan) {
  journal_.emit_now(TrialStarted{});
  start_s_ = engine().last_s();
  now_s_ = 0;
  TrialView view = trial_view(parts_, plan);
  stage_ = view.stage;
  arrange(plan);
  log(now_s_, CubesShown{});
  std::optional<Hand> hand;
  std::vector<int> all(plan.masses_g.size());
  std::iota(all.begin(), all.end(), 0);
  if (const ResponderParameters* parameters = parts_.responder.hand_parameters()) {
    hand.emplace(*parameters, engine().seed(), view);
    think_s_ = parameters->think_s;
    tap_interval_s_ = parameters->tap_interval_s;
  }
  std::vector<int> wrong_slots;
  while (engine().next().kind == Next::Kind::act) {
    frames_.clear();
    if (hand) {
      hand->explore(all);
      explore(*hand);
    }
    const auto answer = parts_.responder.judge(view, frames_, wrong_slots);
    if (!answer)
      throw Error(fmt::format("trial {}: this responder answers only pictures; use --level hand",
                              plan.trial_number));
    const int n_reshuffles = engine().next().plan->n_reshuffles;
    act(*answer);
    const Next& next = engine().next();
    if (next.kind != Next::Kind::act) break;
    wrong_slots.push_back(answer->actions.back().slot.value_or(0));
    if (next.plan->n_reshuffles == n_reshuffles) continue;
    arrange(*next.plan);
    view = trial_view(parts_, *next.plan);
    log(now_s_, CubesShown{});
  }
}

void SurrogateAttempt::log(double t_s, EventPayload what) {
  journal_.emit({start_s_ + log_time(t_s), std::move(what)}, Durability::buffered);
}

void SurrogateAttempt::arrange(const TrialPlan& plan) {
  scene_ = scene_of(parts_.protocol, plan.condition, plan.masses_g, plan.table_friction);
  line_ = scene_;
  cubes_.clear();
  for (const Eigen::Vector3d& slot_m : stage_.slots_m)
    cubes_.push_back({slot_m, Eigen::Quaterniond::Identity()});
}

// Advances from one planned movement to the next, at the times of displayed frames.
void SurrogateAttempt::explore(Hand& hand) {
  const auto frame_at = [&](double t_s) {
    return std::ceil(t_s * stage_.display_rate_hz - 1e-9) / stage_.display_rate_hz;
  };
  DisplayedFrame frame;
  for (;;) {
    frame.t_s = now_s_ = frame_at(std::max(now_s_, hand.path().end_s()));
    if (hand.done(now_s_)) return;
    frame.cubes = cubes_;
    hand.see(frame);
    if (hand.stroke()) push(hand, frame);
  }
}

// Computes a push, from the last frame before the stroke until the hand leaves the line.
void SurrogateAttempt::push(Hand& hand, DisplayedFrame& frame) {
  const double period_s = 1 / stage_.display_rate_hz;
  const Hand::Stroke stroke = *hand.stroke();
  const std::size_t cube = static_cast<std::size_t>(stroke.cube);
  const double middle_x_m = cubes_[cube].position_m.x();
  const Eigen::Quaterniond straight = resting_pose(stage_, 0).orientation;
  line_.cubes = {scene_.cubes[cube]};
  line_.cubes.front().position_m = cubes_[cube].position_m;
  Drive drive(make_simulator(parts_.protocol.simulator.name), line_, stage_.display_rate_hz,
              parts_.protocol.simulator.input);
  double i = std::floor(stroke.begins_s * stage_.display_rate_hz);
  TargetSample last = sample_of(i * period_s, squared(stroke.start, straight, middle_x_m));
  drive.advance(last);
  touch_.reset();
  for (;; ++i) {
    const double t_s = (i + 1) * period_s;
    TargetSample sample = sample_of(t_s, squared(hand.at(t_s), straight, middle_x_m));
    if (t_s < stroke.begins_s) sample.pose = last.pose;
    if (std::abs(sample.pose.position_m.z() - stroke.start.position_m.z()) > rising_m) break;
    const WorldState& world = drive.advance(sample);
    cubes_[cube] = world.cubes.front().pose;
    frame.t_s = now_s_ = t_s;
    frame.effector = sample.pose;
    frame.clone = world.clone.pose;
    frame.cubes[cube] = cubes_[cube];
    frames_.push_back(frame);
    const double lag_m = (world.clone.pose.position_m - sample.pose.position_m).norm();
    if (!world.contacts.empty()) {
      if (!touch_) {
        touch_ = TouchFacts{t_s, t_s, 0, 0, sample.pose.position_m.y()};
        log(t_s, CubeTouch{stroke.cube + 1});
      }
      touch_->last_s = t_s;
      touch_->push_m = std::max(touch_->push_m, sample.pose.position_m.y() - touch_->from_y_m);
      touch_->lag_m = std::max(touch_->lag_m, lag_m);
    }
    hand.see(frame);
  }
  if (touch_) end_touch(stroke.cube, touch_->last_s + period_s, now_s_);
  return_cubes(now_s_);
}

void SurrogateAttempt::end_touch(int cube, double end_s, double now_s) {
  const double duration_s = log_time(end_s) - log_time(touch_->since_s);
  log(std::max(end_s, now_s), CubeTouch{cube + 1, duration_s, touch_->push_m, touch_->lag_m});
  touch_.reset();
}

void SurrogateAttempt::return_cubes(double t_s) {
  const OutOfArea rule = parts_.protocol.layout.out_of_area;
  const auto is_outside = [this](const Pose& cube) {
    return is_out(parts_.protocol.layout, cube.position_m);
  };
  const bool any_out = std::ranges::any_of(cubes_, is_outside);
  for (std::size_t i = 0; i < cubes_.size(); ++i) {
    const bool back = rule == OutOfArea::together
                          ? any_out
                          : rule == OutOfArea::give_back && is_outside(cubes_[i]);
    if (!back) continue;
    cubes_[i].position_m = stage_.slots_m[i];
    log(t_s, CubesReset{static_cast<int>(i) + 1});
  }
}

void SurrogateAttempt::act(const Answer& answer) {
  double t_s = now_s_ + think_s_;
  for (const Action& action : answer.actions) {
    const Admission admission = engine().admit({start_s_ + log_time(t_s), action});
    if (!admission.admitted)
      throw Error(fmt::format("the responder's \"{}\" is refused: {}", name_of(action.kind),
                              admission.refusal));
    if (const std::string why = journal_.emit(*admission.admitted, Durability::acknowledged);
        !why.empty())
      throw Error(why);
    now_s_ = t_s;
    t_s += tap_interval_s_;
  }
}

}  // namespace heft
