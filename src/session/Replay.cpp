#include "session/Replay.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Build.h"
#include "base/Sha256.h"
#include "session/AttemptReplay.h"
#include "session/RunOptions.h"

namespace heft {

namespace {

constexpr double pose_tolerance_m = 1e-6;  // where another build wrote the log

// Adding 0 turns -0, which the log does not keep, into 0.
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

std::string text_of(const Event& event) {
  return fmt::format("{} {} slot {} at {} s{}", name_of(event.kind), event.detail,
                     text_of(event.slot), event.t_s,
                     event.value ? fmt::format(" value {}", *event.value) : "");
}

// Events that the world makes, as opposed to people and the engine.
bool made_by_world(const Event& event) {
  switch (event.kind) {
    case EventKind::cubes_shown:
    case EventKind::cube_contact:
    case EventKind::effector_lost:
    case EventKind::effector_found:
      return true;
    case EventKind::cubes_reset:
      return event.slot.has_value();
    default:
      return false;
  }
}

// Collects differences and keeps the earliest.
class Verifier {
 public:
  Verifier(const LogReader& reader, std::int64_t session_id)
      : reader_(reader), session_(reader.session(session_id)) {
    result.same_build = session_.header.build == build_name();
  }

  void run(const std::function<void(double)>& progress) {
    check_protocol();
    const RunOptions options = run_options_from_json(session_.header.run_options);
    virtual_clock_ = options.tracker == "hand";
    protocol_ = protocol_for(
        parse_protocol(session_.header.protocol_text, session_.header.protocol_name), options);
    const auto events = reader_.events(session_.session_id);
    fold_ = fold_session(protocol_, session_.header.seed, events);
    result.n_events = fold_.n_events;
    compare_rows();
    if (fold_.refused) {
      const auto& [logged, why] = *fold_.refused;
      differ(logged.attempt_index, logged.event.t_s, fmt::format("event {}", fold_.n_events + 1),
             text_of(logged.event), "refused: " + why);
    }
    compare_pictures(progress);
  }

  Verification result;

 private:
  void check_protocol() {
    const std::string sha256_of_text = sha256(session_.header.protocol_text);
    if (sha256_of_text != session_.header.protocol_sha256)
      differ(0, 0, "session.protocol_sha256", session_.header.protocol_sha256, sha256_of_text);
  }

  void compare_rows() {
    const auto logged = logged_rows(reader_, session_.session_id);
    result.n_rows = static_cast<int>(logged.size());
    for (const auto& [key, row] : logged)
      if (!fold_.rows.contains(key) && !fold_.refused) differ(row, key, "a row", "no such row");
    for (const auto& [key, row] : fold_.rows) {
      if (was_cut_short(row)) continue;
      const auto found = logged.find(key);
      if (found == logged.end()) {
        differ(row, key, "no such row", "a row");
        continue;
      }
      for (std::size_t i = 0; i < row.columns.size(); ++i) {
        const auto& [column, value] = row.columns[i];
        const std::string& logged_value = found->second.columns[i].second;
        if (value != logged_value) differ(row, key + ", " + column, logged_value, value);
      }
    }
    if (fold_.state != session_.state && !fold_.refused)
      differ(0, fold_.last_s, "session.state", std::string(name_of(session_.state)),
             std::string(name_of(fold_.state)));
  }

  // Where an event is refused the fold ends in the middle of an attempt, whose rows go on in the
  // log.
  bool was_cut_short(const RowText& row) const {
    const auto attempt = fold_.attempts.find(row.attempt_index);
    return fold_.refused && attempt != fold_.attempts.end() &&
           attempt->second.row.status == TrialStatus::open;
  }

  void compare_pictures(const std::function<void(double)>& progress) {
    result.n_attempts = static_cast<int>(fold_.attempts.size());
    std::vector<int> without;
    int done = 0;
    for (const auto& [index, attempt] : fold_.attempts) {
      progress(static_cast<double>(done++) / result.n_attempts);
      if (result.first && attempt.row.started_s > result.first->t_s) break;
      const auto frames = reader_.frames(session_.session_id, index);
      result.n_pictures += static_cast<int>(frames.size());
      if (frames.empty())
        without.push_back(index);
      else
        compare_attempt(index, attempt, frames);
    }
    progress(1);
    for (int index :
         without) {  // a log keeps pictures or it doesn't; a crash may lose the last ones
      const TrialRow& row = fold_.attempts[index].row;
      if (result.n_pictures > 0 && row.status == TrialStatus::completed)
        differ(index, row.started_s, "its pictures", "none", "at least one");
    }
  }

  void compare_attempt(int index, const AttemptFold& attempt, const std::vector<FrameRow>& frames) {
    AttemptReplay replay(*protocol_, attempt);
    for (const FrameRow& frame : frames)
      if (!compare_picture(attempt, frame, replay.advance(frame))) return;
    const bool completed = attempt.row.status == TrialStatus::completed;
    if (completed) {
      replay.finish(*attempt.row.ended_s);
      const double display_s = 1 / protocol_->display_rate_hz;
      if (virtual_clock_ && *attempt.row.ended_s - frames.back().t_s >= display_s)
        differ(index, frames.back().t_s, "pictures after this one", "none",
               fmt::format("some until {} s", *attempt.row.ended_s));
    }
    compare_events(index, attempt, replay.derived(), completed);
  }

  bool compare_picture(const AttemptFold& attempt, const FrameRow& frame,
                       const ShownPicture& shown) {
    const int before = n_differences_;
    const auto compare = [&](const char* column, const std::string& logged,
                             const std::string& came_out) {
      if (logged != came_out)
        differ(frame.attempt_index, frame.t_s, fmt::format("picture, {}", column), logged,
               came_out);
    };
    compare("t_s", fmt::format("{}", frame.t_s),
            fmt::format("{}", attempt.row.started_s + log_time(frame.trial_t_s)));
    compare("contact_slot", text_of(frame.contact_slot), text_of(shown.contact_slot));
    if (result.same_build) {
      compare("state_hash", frame.state_hash, shown.state_hash);
      compare("clone", text_of(frame.clone), text_of(shown.frame.clone));
    } else {
      compare_nearly("clone", frame, frame.clone, shown.frame.clone);
    }
    for (std::size_t i = 0; i < std::max(frame.cubes.size(), shown.frame.cubes.size()); ++i) {
      const auto logged = pose_at(frame.cubes, i), came_out = pose_at(shown.frame.cubes, i);
      const std::string column = fmt::format("cube{}", i + 1);
      if (result.same_build)
        compare(column.c_str(), text_of(logged), text_of(came_out));
      else
        compare_nearly(column, frame, logged, came_out);
    }
    return n_differences_ == before;
  }

  static std::optional<Pose> pose_at(const std::vector<Pose>& poses, std::size_t i) {
    return i < poses.size() ? std::optional(poses[i]) : std::nullopt;
  }

  void compare_nearly(const std::string& column, const FrameRow& frame,
                      const std::optional<Pose>& logged, const std::optional<Pose>& came_out) {
    if (!logged && !came_out) return;
    if (logged && came_out) {
      const double difference_m = (logged->position_m - came_out->position_m).norm();
      result.largest_difference_m = std::max(result.largest_difference_m, difference_m);
      if (difference_m <= pose_tolerance_m) return;
    }
    differ(frame.attempt_index, frame.t_s, "picture, " + column, text_of(logged),
           text_of(came_out));
  }

  // An attempt that a crash or a veto cut short may lack the last events of its world.
  void compare_events(int index, const AttemptFold& attempt, const std::vector<Event>& derived,
                      bool completed) {
    std::vector<Event> logged;
    for (const AttemptEvent& folded : attempt.events)
      if (made_by_world(folded.event)) logged.push_back(folded.event);
    const std::size_t n = std::min(logged.size(), derived.size());
    for (std::size_t i = 0; i < n; ++i) {
      Event came_out = derived[i];
      if (came_out.kind == EventKind::cubes_shown) came_out.t_s = logged[i].t_s;  // when presented
      if (logged[i] != came_out)
        return differ(index, logged[i].t_s, "event", text_of(logged[i]), text_of(came_out));
    }
    if (!completed || logged.size() == derived.size()) return;
    if (logged.size() > n)
      differ(index, logged[n].t_s, "event", text_of(logged[n]), "no such event");
    else
      differ(index, derived[n].t_s, "event", "no such event", text_of(derived[n]));
  }

  void differ(const RowText& row, const std::string& what, const std::string& logged,
              const std::string& came_out) {
    double t_s = row.t_s;
    if (t_s < 0) {
      const auto attempt = fold_.attempts.find(row.attempt_index);
      const bool known = attempt != fold_.attempts.end();  // an estimate belongs to no attempt
      // Such a row is settled when its attempt ends.
      t_s = known ? attempt->second.row.ended_s.value_or(fold_.last_s) : fold_.last_s;
    }
    differ(row.attempt_index, t_s, what, logged, came_out);
  }

  void differ(int attempt_index, double t_s, const std::string& what, const std::string& logged,
              const std::string& came_out) {
    ++n_differences_;
    if (result.first && result.first->t_s <= t_s) return;
    const auto attempt = fold_.attempts.find(attempt_index);
    const int trial_number =
        attempt == fold_.attempts.end() ? 0 : attempt->second.first_plan.trial_number;
    result.first = {trial_number, t_s, what, logged, came_out};
  }

  const LogReader& reader_;
  SessionRow session_;
  std::shared_ptr<const Protocol> protocol_;
  Projection fold_;
  bool virtual_clock_ = false;
  int n_differences_ = 0;
};

}  // namespace

Verification verify_session(const LogReader& reader, std::int64_t session_id,
                            const std::function<void(double)>& progress) {
  Verifier verifier(reader, session_id);
  verifier.run(progress);
  return verifier.result;
}

}  // namespace heft
