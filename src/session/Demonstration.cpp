#include "session/Demonstration.h"

#include <cmath>
#include <numbers>

#include "base/Random.h"
#include "base/SimulationChoices.h"
#include "tasks/Sorting.h"
#include "view/scene/Viewpoint.h"

namespace heft {

namespace {
constexpr double mass_g = 200;  // arbitrary: a coupled clone moves all masses alike

// Rolled about its long axis, the effector shows the camera two of its faces, which a good pose
// needs. This is how participants should hold it.
constexpr double roll_rad = 40 * std::numbers::pi / 180;

TrialPlan plan_of_demonstration() {
  TrialPlan plan;
  plan.block = "demonstration";
  plan.condition = coupled_technique;
  plan.masses_g = {mass_g, mass_g, mass_g};
  return plan;
}

std::unique_ptr<Responder> hand_for(std::uint64_t seed) {
  ResponderOptions options;
  options.seed = RandomStream(seed, "demonstration").bits();
  return responder_named("simulated").make(options);
}

// A model holds it upright; its lower edge keeps the height of its lower face.
Pose as_people_hold_it(const Pose& upright, const Eigen::Vector3d& size_m) {
  Pose held = upright;
  held.orientation = held.orientation * Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
  const double height_m = std::cos(roll_rad) * size_m.z() + std::sin(roll_rad) * size_m.y();
  held.position_m.z() += (height_m - size_m.z()) / 2;
  return held;
}

// The viewpoint that is also used without a camera.
SyntheticSettings camera_settings(bool left_hand) {
  SyntheticSettings settings;
  settings.left_hand = left_hand;
  settings.camera_from_board = default_camera_from_board();
  return settings;
}
}  // namespace

Demonstration::Demonstration(const Protocol& protocol, const Apparatus& apparatus,
                             std::uint64_t seed, bool left_hand)
    : step_s_(1 / protocol.display_rate_hz),
      effector_size_m_(protocol.effector_size_m),
      hand_(hand_for(seed)),
      world_(protocol, plan_of_demonstration()) {
  hand_->begin_trial({0, 1, Sorting::task.name, stage_of(protocol, 3)});
  if (apparatus.board.tags.empty()) return;
  const SyntheticSettings settings = camera_settings(left_hand);
  camera_.emplace(apparatus, settings, seed);
  last_.camera_from_board = settings.camera_from_board;
}

ViewFrame Demonstration::at(double t_s) {
  const std::uint64_t before = count_;
  while (static_cast<double>(count_) * step_s_ <= t_s) advance();
  if (camera_ && count_ > before) film();
  return last_;
}

void Demonstration::advance() {
  const double frame_s = static_cast<double>(count_++) * step_s_;
  const HandSample hand = hand_->hand(frame_s);
  const auto pose =
      hand.in_view ? std::optional(as_people_hold_it(hand.pose, effector_size_m_)) : std::nullopt;
  last_.frame = world_.advance(sample_of(frame_s, pose)).frame;
  // The model keeps looking: its answers are ignored.
  ScreenState screen;
  screen.screen = Screen::trial;
  hand_->see(last_.frame, screen);
}

// Draws cubes behind the hand, whose position is known here.
void Demonstration::film() {
  const DisplayedFrame& frame = last_.frame;
  const auto held = [&](double) {
    return frame.tracked ? std::optional(frame.effector) : std::nullopt;
  };
  last_.camera = std::make_shared<const Image>(camera_->picture(held, frame.t_s, count_));
  last_.in_front = frame.tracked
                       ? std::make_shared<const Image>(camera_->hand_in_picture(frame.effector))
                       : nullptr;
}

}  // namespace heft
