#include "replay/FrameCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Error.h"
#include "record/schema/EventRow.h"
#include "replay/AttemptReplay.h"

namespace heft {

namespace {

constexpr double pose_tolerance_m = 1e-6;  // if another build wrote the log

// Adding 0 turns -0, which the log does not distinguish, into 0.
std::string text_of(const Pose& pose) {
  const Eigen::Vector3d p = pose.position_m + Eigen::Vector3d::Zero();
  const Eigen::Vector4d q = pose.orientation.coeffs() + Eigen::Vector4d::Zero();
  return fmt::format("x {} y {} z {} q {} {} {} {}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(),
                     q.z());
}

std::string text_of(const std::optional<Pose>& pose) {
  return pose ? text_of(*pose) : "NULL";
}

std::string text_of(const std::optional<int>& slot) {
  return slot ? fmt::format("{}", *slot) : "NULL";
}

std::optional<Pose> pose_at(const std::vector<Pose>& poses, std::size_t i) {
  return i < poses.size() ? std::optional(poses[i]) : std::nullopt;
}

// Events of the world, as opposed to those of people and the engine.
bool made_by_world(const Event& event) {
  const auto* reset = event.as<CubesReset>();
  return (reset && reset->slot) || event.as<CubesShown>() || event.as<CubeTouch>() ||
         event.as<EffectorLost>() || event.as<EffectorFound>();
}

}  // namespace

FrameCheck::FrameCheck(const Protocol& protocol, const ProjectedAttempt& attempt,
                       FrameCheckOptions options)
    : protocol_(protocol), attempt_(attempt), options_(std::move(options)) {}

void FrameCheck::run(const std::vector<FrameRow>& frames) {
  AttemptReplay replay(protocol_, attempt_);
  int n = 0;
  for (const FrameRow& frame : frames) {
    try {
      if (!check(frame, replay.advance(frame), n++)) return;
    } catch (const Error& error) {  // poses or times that no simulator accepts
      return options_.differ(frame.t_s, "frame", "effector pose and time", error.what());
    }
  }
  if (attempt_.row.status == TrialStatus::completed) {
    replay.finish(*attempt_.row.ended_s);
    check_end(frames.back());
  }
  if (options_.same_edition) check_events(replay.derived());
}

bool FrameCheck::check(const FrameRow& frame, const ShownFrame& shown, int n_before) {
  const auto number = [](double value) { return fmt::format("{}", value); };
  const double t_s = attempt_.row.started_s + log_time(frame.trial_t_s);
  if (!same(frame, "t_s", number(frame.t_s), number(t_s))) return false;
  if (options_.virtual_clock && !same(frame, "trial_t_s", number(frame.trial_t_s),
                                      number(n_before / protocol_.display_rate_hz)))
    return false;
  if (!options_.same_edition) {
    measure(frame, shown);
    return true;
  }
  if (!same(frame, "contact_slot", text_of(frame.contact_slot), text_of(shown.contact_slot)))
    return false;
  if (options_.equal_bits && !same(frame, "state_hash", frame.state_hash, shown.state_hash))
    return false;
  if (!same_pose(frame, "clone", frame.clone, shown.frame.clone)) return false;
  for (std::size_t i = 0; i < std::max(frame.cubes.size(), shown.frame.cubes.size()); ++i)
    if (!same_pose(frame, fmt::format("cube{}", i + 1), pose_at(frame.cubes, i),
                   pose_at(shown.frame.cubes, i)))
      return false;
  return true;
}

void FrameCheck::measure(const FrameRow& frame, const ShownFrame& shown) {
  const auto compare = [&](const std::optional<Pose>& logged, const std::optional<Pose>& replayed) {
    if (logged && replayed)
      largest_difference_m_ =
          std::max(largest_difference_m_, (logged->position_m - replayed->position_m).norm());
  };
  compare(frame.clone, shown.frame.clone);
  for (std::size_t i = 0; i < frame.cubes.size(); ++i)
    compare(frame.cubes[i], pose_at(shown.frame.cubes, i));
}

bool FrameCheck::same(const FrameRow& frame, const char* column, const std::string& logged,
                      const std::string& replayed) {
  if (logged == replayed) return true;
  options_.differ(frame.t_s, fmt::format("frame, {}", column), logged, replayed);
  return false;
}

bool FrameCheck::same_pose(const FrameRow& frame, const std::string& column,
                           const std::optional<Pose>& logged, const std::optional<Pose>& replayed) {
  if (!options_.equal_bits && logged && replayed) {
    const double difference_m = (logged->position_m - replayed->position_m).norm();
    largest_difference_m_ = std::max(largest_difference_m_, difference_m);
    if (difference_m <= pose_tolerance_m) return true;
  }
  return same(frame, column.c_str(), text_of(logged), text_of(replayed));
}

void FrameCheck::check_end(const FrameRow& last) {
  const double ended_s = *attempt_.row.ended_s;
  if (options_.virtual_clock && ended_s - last.t_s >= 1 / protocol_.display_rate_hz)
    options_.differ(last.t_s, "frames after this one", "none",
                    fmt::format("some until {} s", ended_s));
}

// Where bits may differ, the logged push is used.
void FrameCheck::take_over_push(Event& replayed, const Event& logged) {
  auto* touch = std::get_if<CubeTouch>(&replayed.what);
  const auto* logged_touch = logged.as<CubeTouch>();
  if (!touch || !logged_touch || options_.equal_bits) return;
  const auto differs = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a.has_value() != b.has_value() || (a && std::abs(*a - *b) > pose_tolerance_m);
  };
  if (differs(touch->max_push_displacement_m, logged_touch->max_push_displacement_m) ||
      differs(touch->peak_lag_m, logged_touch->peak_lag_m))
    return;
  touch->max_push_displacement_m = logged_touch->max_push_displacement_m;
  touch->peak_lag_m = logged_touch->peak_lag_m;
}

// An attempt that was cut short by a crash or a veto may lack its world's last events.
void FrameCheck::check_events(const std::vector<Event>& derived) {
  std::vector<AttemptEvent> logged;
  for (const AttemptEvent& folded : attempt_.events)
    if (made_by_world(folded.event)) logged.push_back(folded);
  const std::size_t n = std::min(logged.size(), derived.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Event& event = logged[i].event;
    Event replayed = derived[i];
    // Cubes are shown with the frame, and not before an event that was already logged.
    replayed.t_s =
        replayed.as<CubesShown>() ? event.t_s : std::max(replayed.t_s, logged[i].previous_s);
    take_over_push(replayed, event);
    if (event != replayed)
      return options_.differ(event.t_s, "event", text_of(event), text_of(replayed));
  }
  if (attempt_.row.status != TrialStatus::completed || logged.size() == derived.size()) return;
  if (logged.size() > n)
    options_.differ(logged[n].event.t_s, "event", text_of(logged[n].event), "no such event");
  else
    options_.differ(derived[n].t_s, "event", "no such event", text_of(derived[n]));
}

}  // namespace heft
