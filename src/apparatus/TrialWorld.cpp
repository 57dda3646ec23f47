#include "apparatus/TrialWorld.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/math/Geometry.h"

namespace heft {

namespace {
// A contact interrupted for less than this is one push.
constexpr double push_gap_s = 0.2;

int slot_of(std::size_t cube) {
  return static_cast<int>(cube) + 1;
}
}  // namespace

bool is_out(const Layout& layout, const Eigen::Vector3d& center_m) {
  const Eigen::Vector2d reach_m = layout.area_m / 2;
  return std::abs(center_m.x()) > reach_m.x() || std::abs(center_m.y()) > reach_m.y() ||
         center_m.z() < 0;
}

TrialWorld::TrialWorld(const Protocol& protocol, const TrialPlan& plan)
    : protocol_(protocol), stage_(stage_of(protocol, plan.n_slots())) {
  rearrange(plan);
}

void TrialWorld::rearrange(const TrialPlan& plan) {
  scene_ = scene_of(protocol_, plan.condition, plan.masses_g, plan.table_friction);
  contacts_.assign(plan.masses_g.size(), {});
  drive_.reset();
  reset_requested_ = false;
}

// A simulator of a single stroke refuses other movements sooner or later.
void TrialWorld::advance_drive(const TargetSample& sample) {
  try {
    drive_->advance(sample);
  } catch (const OutsideModel& outside) {
    throw Error(
        fmt::format("simulator \"{}\", {:.2f} s into the trial: {}; use \"boxes\", or "
                    "\"auto\", which chooses a suitable simulator",
                    protocol_.simulator.name, sample.t_capture_s, outside.what()));
  }
}

ShownFrame TrialWorld::advance(const TargetSample& sample) {
  ShownFrame shown;
  note_view(sample, shown);
  const SimulatorChoice& simulator = protocol_.simulator;
  const Pose seen_at = predicted(sample, simulator.input.predict_s);
  if (!drive_ && sample.tracked && clear_of_all(seen_at)) {
    drive_.emplace(make_simulator(simulator.name), scene_, simulator.rate_hz, simulator.input);
    shown.events.push_back({log_time(sample.t_capture_s), CubesShown{}});
  }
  WorldState world;
  if (drive_) {
    advance_drive(sample);
    return_cubes(sample.t_capture_s, shown);
    note_contacts(sample, shown);
    world = drive_->state();
  } else {
    world.clone_present = sample.tracked;
    world.clone = {seen_at, sample.velocity};
  }
  last_s_ = sample.t_capture_s;
  shown.state_hash = state_hash(world);
  shown.frame.t_s = sample.t_capture_s;
  shown.frame.tracked = sample.tracked;
  shown.frame.effector = sample.pose;
  if (world.clone_present) shown.frame.clone = world.clone.pose;
  for (const BodyState& cube : world.cubes) shown.frame.cubes.push_back(cube.pose);
  return shown;
}

void TrialWorld::note_view(const TargetSample& sample, ShownFrame& shown) {
  if (sample.tracked == tracked_) return;
  tracked_ = sample.tracked;
  const double t_s = log_time(sample.t_capture_s);
  if (tracked_)
    shown.events.push_back({t_s, EffectorFound{}});
  else
    shown.events.push_back({t_s, EffectorLost{}});
}

void TrialWorld::note_contacts(const TargetSample& sample, ShownFrame& shown) {
  const std::vector<CubeContact>& touching = drive_->state().contacts;
  const auto hardest = std::ranges::max_element(
      touching, {}, [](const CubeContact& contact) { return contact.force_n.norm(); });
  if (hardest != touching.end()) shown.contact_slot = hardest->cube + 1;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const bool is_touched = std::ranges::any_of(
        touching, [&](const CubeContact& c) { return c.cube == static_cast<int>(i); });
    if (is_touched)
      touch(i, sample, shown.events);
    else if (contacts_[i].since_s)
      leave(i, sample.t_capture_s, shown.events);
  }
}

void TrialWorld::touch(std::size_t cube, const TargetSample& sample, std::vector<Event>& events) {
  Contact& contact = contacts_[cube];
  const Eigen::Vector3d& effector_m = sample.pose.position_m;
  const double lag_m = (drive_->state().clone.pose.position_m - effector_m).norm();
  contact.left_s.reset();
  const bool begins = !contact.since_s;
  if (begins) contact.from_m = effector_m;
  contact.max_push_displacement_m =
      std::max(contact.max_push_displacement_m, (effector_m - contact.from_m).norm());
  contact.peak_lag_m = std::max(contact.peak_lag_m, lag_m);
  if (!begins) return;
  contact.since_s = sample.t_capture_s;
  events.push_back({log_time(sample.t_capture_s), CubeTouch{slot_of(cube)}});
}

// The cube was touched before and is not now.
void TrialWorld::leave(std::size_t cube, double t_s, std::vector<Event>& events) {
  Contact& contact = contacts_[cube];
  const bool was_interrupted = protocol_.gaps_end_contacts && t_s - last_s_ > longest_gap_s;
  if (!contact.left_s) contact.left_s = was_interrupted ? last_s_ : t_s;
  if (t_s - *contact.left_s >= push_gap_s) end_contact(cube, *contact.left_s, t_s, events);
}

void TrialWorld::end_contact(std::size_t cube, double end_s, double now_s,
                             std::vector<Event>& events) {
  const Contact& contact = contacts_[cube];
  const double duration_s = log_time(end_s) - log_time(*contact.since_s);
  events.push_back(
      {log_time(now_s),
       CubeTouch{slot_of(cube), duration_s, contact.max_push_displacement_m, contact.peak_lag_m}});
  contacts_[cube] = {};
}

std::vector<Event> TrialWorld::end_contacts(double t_s) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].since_s) end_contact(i, contacts_[i].left_s.value_or(t_s), t_s, events);
  return events;
}

void TrialWorld::return_cubes(double t_s, ShownFrame& shown) {
  const WorldState& world = drive_->state();
  const auto is_clear = [&] { return !world.clone_present || clear_of_all(world.clone.pose); };
  const bool reset = reset_requested_ && is_clear();
  if (reset) reset_requested_ = false;
  const bool all_back = go_back_together() && is_clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const bool back = protocol_.layout.out_of_area == OutOfArea::give_back && is_out(i) &&
                      !contacts_[i].since_s && place_is_free(i);
    if (!reset && !back && !all_back) continue;
    drive_->return_cube(static_cast<int>(i));
    if (!reset) shown.events.push_back({log_time(t_s), CubesReset{slot_of(i)}});
  }
}

bool TrialWorld::go_back_together() const {
  if (protocol_.layout.out_of_area != OutOfArea::together) return false;
  bool any_out = false, any_touched = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    any_out = any_out || is_out(i);
    any_touched = any_touched || contacts_[i].since_s;
  }
  return any_out && !any_touched;
}

bool TrialWorld::place_is_free(std::size_t cube) const {
  const WorldState& world = drive_->state();
  if (world.clone_present && !clear_of(stage_.slots_m[cube], world.clone.pose)) return false;
  const Pose place{stage_.slots_m[cube], Eigen::Quaterniond::Identity()};
  for (std::size_t other = 0; other < world.cubes.size(); ++other)
    if (other != cube && boxes_overlap(place, scene_.cubes[cube].size_m, world.cubes[other].pose,
                                       scene_.cubes[other].size_m))
      return false;
  return true;
}

bool TrialWorld::clear_of(const Eigen::Vector3d& slot_m, const Pose& effector) const {
  const Pose place{slot_m, Eigen::Quaterniond::Identity()};
  const double reach_m = stage_.cube_size_m + 2 * protocol_.layout.clear_m;
  return !boxes_overlap(place, Eigen::Vector3d::Constant(reach_m), effector,
                        stage_.effector_size_m);
}

bool TrialWorld::clear_of_all(const Pose& effector) const {
  return std::ranges::all_of(stage_.slots_m,
                             [&](const auto& slot_m) { return clear_of(slot_m, effector); });
}

}  // namespace heft
