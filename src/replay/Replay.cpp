#include "replay/Replay.h"

#include <fmt/format.h>

#include <algorithm>

#include "apparatus/sources/PictureSource.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "base/Program.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "physics/DecouplingSimulator.h"
#include "record/schema/EventRow.h"
#include "replay/FrameCheck.h"
#include "replay/Projection.h"

namespace heft {

namespace {

// Compares a log with its fold and keeps the earliest difference.
class Verifier {
 public:
  Verifier(const LogReader& reader, std::int64_t session_id)
      : reader_(reader), session_id_(session_id) {}

  Verification rows() {
    std::string unreadable;
    try {
      if (reader_.session(session_id_).state == SessionState::withdrawn) return tombstone();
      compare_protocol();
      session_ = load_session(reader_, "", session_id_);
      fold();
      compare_rows();
      compare_state();
    } catch (const Error& error) {  // an unreadable row is a difference, too
      unreadable = error.what();
    }
    if (!unreadable.empty())
      differ(0, fold_.last_s, "the log", unreadable, "rows that can be read");
    compare_digests();
    return result_;
  }

  // Changed rows are not simulated: their cost is unknown.
  Verification all(const std::function<void(double)>& progress) {
    rows();
    if (result_.first || result_.withdrawn) return result_;
    try {
      compare_frames(progress);
    } catch (const OnlyForStudies&) {
      throw;  // needs another program to verify
    } catch (const Error& error) {
      differ(0, fold_.last_s, "the log", error.what(), "rows that can be read");
    }
    return result_;
  }

 private:
  Verification tombstone() {
    result_.ended = result_.withdrawn = true;
    if (!logged_rows(reader_, session_id_).empty() || !reader_.events(session_id_).empty())
      differ(0, 0, "the rows of a withdrawn session", "some", "none");
    compare_digests();
    return result_;
  }

  void compare_protocol() {
    const SessionHeader header = reader_.session(session_id_).header;
    const std::string sha256_of_text = sha256(header.protocol_text);
    if (sha256_of_text != header.protocol_sha256)
      differ(0, 0, "session.protocol_sha256", header.protocol_sha256, sha256_of_text);
  }

  void fold() {
    fold_ = fold_session(session_.protocol, session_.row.header.seed, reader_.events(session_id_));
    result_.n_events = fold_.n_events;
    result_.n_attempts = static_cast<int>(fold_.attempts.size());
    result_.ended = !is_unfinished(fold_.state);
  }

  void compare_rows() {
    const auto logged = logged_rows(reader_, session_id_);
    result_.n_rows = static_cast<int>(logged.size());
    for (const auto& [key, row] : logged)
      if (!fold_.rows.contains(key) && !fold_.refused) differ(row, key, "a row", "no such row");
    for (const auto& [key, row] : fold_.rows) {
      if (was_cut_short(row)) continue;
      const auto found = logged.find(key);
      if (found == logged.end())
        differ(row, key, "no such row", "a row");
      else
        compare_columns(key, found->second, row);
    }
  }

  void compare_columns(const std::string& key, const RowText& logged, const RowText& folded) {
    for (std::size_t i = 0; i < folded.columns.size(); ++i) {
      const auto& [column, value] = folded.columns[i];
      const std::string& logged_value = logged.columns[i].value;
      if (value != logged_value)
        differ(folded, fmt::format("{}, {}", key, column), logged_value, value);
    }
  }

  // If an event is refused, the fold ends inside an attempt that continues in the log.
  bool was_cut_short(const RowText& row) const {
    const auto attempt = fold_.attempts.find(row.attempt_index);
    return fold_.refused && attempt != fold_.attempts.end() &&
           attempt->second.row.status == TrialStatus::open;
  }

  void compare_state() {
    if (fold_.refused) {
      const auto& [logged, why] = *fold_.refused;
      differ(logged.attempt_index, logged.event.t_s, fmt::format("event {}", fold_.n_events + 1),
             text_of(logged.event), "refused: " + why);
    } else if (fold_.state != session_.row.state) {
      differ(0, fold_.last_s, "session.state", std::string(name_of(session_.row.state)),
             std::string(name_of(fold_.state)));
    }
  }

  void compare_frames(const std::function<void(double)>& progress) {
    std::vector<int> without;
    int done = 0;
    for (const auto& [index, attempt] : fold_.attempts) {
      progress(static_cast<double>(done++) / result_.n_attempts);
      if (result_.first && attempt.row.started_s > result_.first->t_s) break;
      const auto frames = reader_.frames(session_id_, index);
      result_.n_frames += static_cast<int>(frames.size());
      if (frames.empty())
        without.push_back(index);
      else
        compare_attempt(index, attempt, frames);
    }
    progress(1);
    // A log has frames or has none; a crash may lose an attempt's last ones.
    for (int index : without) {
      const TrialRow& row = fold_.attempts[index].row;
      if (result_.n_frames > 0 && row.status == TrialStatus::completed)
        differ(index, row.started_s, "its frames", "none", "at least one");
    }
  }

  // Rows that are neither folded nor simulated (notes, participant_info) are protected by their
  // digest only. Compared last: of two differences at one time, the other is more specific.
  void compare_digests() {
    const auto broken = reader_.first_broken_digest(session_id_);
    if (!broken) return;
    // What is wrong with a seal's session is more specific.
    const double t_s = broken->table == "seal" ? fold_.last_s : broken->t_s;
    differ(
        broken->attempt_index, t_s, broken->row,
        broken->damage.empty() ? digest_or_counts(broken->logged) : broken->damage,
        broken->damage.empty() ? digest_or_counts(broken->recomputed) : "a row as it was written");
  }

  // "9 events and 30 frames" is no digest, and says what it is.
  static std::string digest_or_counts(const std::string& value) {
    return value.find(' ') == std::string::npos ? "digest " + value : value;
  }

  void compare_attempt(int index, const ProjectedAttempt& attempt,
                       const std::vector<FrameRow>& frames) {
    const SessionConfig& setup = session_.setup_of(attempt.row);
    const auto protocol = session_.protocol_of(attempt.row);
    FrameCheckOptions options;
    options.equal_bits = setup.build == build_name();
    options.same_edition =
        !setup.simulator_edition ||
        *setup.simulator_edition == simulator_named(protocol->simulator.name).edition;
    const TrackerEntry& tracker = tracker_named(setup.tracker.name);
    options.virtual_clock =
        tracker.what != TrackerWhat::source &&
        !runs_on_wall_clock(has_person(setup), tracker, view_named(setup.view.name));
    options.differ = [&](double t_s, const std::string& what, const std::string& logged,
                         const std::string& replayed) {
      differ(index, t_s, what, logged, replayed);
    };
    FrameCheck check(*protocol, attempt, options);
    check.run(frames);
    if (options.same_edition && options.equal_bits) return;
    auto& n = options.same_edition ? result_.n_other_build : result_.n_other_edition;
    double& largest_m =
        options.same_edition ? result_.largest_difference_m : result_.largest_of_other_edition_m;
    n += static_cast<int>(frames.size());
    largest_m = std::max(largest_m, check.largest_difference_m());
  }

  void differ(const RowText& row, const std::string& what, const std::string& logged,
              const std::string& replayed) {
    double t_s = row.t_s;
    if (t_s < 0) {
      // Such a row is final when its attempt ends; an estimate belongs to no attempt.
      const auto attempt = fold_.attempts.find(row.attempt_index);
      const bool known = attempt != fold_.attempts.end();
      t_s = known ? attempt->second.row.ended_s.value_or(fold_.last_s) : fold_.last_s;
    }
    differ(row.attempt_index, t_s, what, logged, replayed);
  }

  void differ(int attempt_index, double t_s, const std::string& what, const std::string& logged,
              const std::string& replayed) {
    if (result_.first && result_.first->t_s <= t_s) return;
    const auto attempt = fold_.attempts.find(attempt_index);
    const int trial_number =
        attempt == fold_.attempts.end() ? 0 : attempt->second.first_plan.trial_number;
    result_.first = {trial_number, t_s, what, logged, replayed};
  }

  const LogReader& reader_;
  std::int64_t session_id_;
  LoggedSession session_;
  Projection fold_;
  Verification result_;
};

}  // namespace

Verification verify_session(const LogReader& reader, std::int64_t session_id,
                            const std::function<void(double)>& progress) {
  reader.session(session_id);  // throws if it is missing
  return Verifier(reader, session_id).all(progress);
}

Verification verify_rows(const LogReader& reader, std::int64_t session_id) {
  return Verifier(reader, session_id).rows();
}

std::optional<std::string> fault_of_structure(const LogReader& reader) {
  if (const auto foreign = reader.foreign_objects(); !foreign.empty())
    return "the file's schema is not that of a log: " + foreign.front();
  const auto broken = reader.first_broken_seal();
  if (!broken) return std::nullopt;
  if (!broken->damage.empty()) return fmt::format("{} is {}", broken->row, broken->damage);
  return fmt::format(
      "{} does not follow: sessions were removed, added, renumbered or swapped "
      "(logged: {}, found: {})",
      broken->row, broken->logged, broken->recomputed);
}

std::vector<std::string> faults_of_file(const LogReader& reader, const std::string& db) {
  std::vector<std::string> faults;
  for (const std::string& fault : check_integrity(db))
    faults.push_back("the file is damaged: " + fault);
  if (const auto fault = fault_of_structure(reader)) faults.push_back(*fault);
  return faults;
}

namespace {
// Verifies sessions in several threads, each with a reader. @return the fault of the first session
std::optional<std::string> fault_of_sessions(const std::string& db,
                                             const std::vector<std::int64_t>& ids,
                                             const std::function<void(double)>& progress) {
  constexpr std::size_t sessions_at_once = 8;
  std::vector<std::string> faults(ids.size());
  in_parallel(ids.size(), sessions_at_once, [&](std::size_t first, std::size_t last) {
    const LogReader reader(db);
    for (std::size_t i = first; i < last; ++i) {
      if (first == 0) progress(static_cast<double>(i) / static_cast<double>(last));
      const Verification found = verify_rows(reader, ids[i]);
      if (!found.first) continue;
      faults[i] = fmt::format("session {}, at {:.3f} s: {} is {}, but its events give {}", ids[i],
                              found.first->t_s, found.first->what, found.first->logged,
                              found.first->replayed);
      return;
    }
  });
  const auto fault = std::ranges::find_if_not(faults, &std::string::empty);
  return fault == faults.end() ? std::nullopt : std::optional(*fault);
}
}  // namespace

std::optional<std::string> fault_of_log(const LogReader& reader, const std::string& db,
                                        const std::vector<std::int64_t>& session_ids,
                                        const std::function<void(double)>& progress) {
  if (const auto faults = faults_of_file(reader, db); !faults.empty()) return faults.front();
  const auto ids = session_ids.empty() ? reader.session_ids() : session_ids;
  auto fault = fault_of_sessions(db, ids, progress);
  if (!fault) progress(1);
  return fault;
}

std::string require_verified(const std::string& db, const std::vector<std::int64_t>& session_ids,
                             const std::function<void(double)>& progress,
                             std::string_view unverified) {
  const LogReader reader(db);
  if (const auto fault = fault_of_log(reader, db, session_ids, progress))
    throw Error(fmt::format("{} is not verified: {}. Inspect it with heft replay --db {}; "
                            "--unverified {}",
                            db, *fault, shell_quoted(db), unverified),
                ExitCode::diverged);
  return reader.head();
}

Witness find_witness(const LogReader& reader, const std::string& head) {
  constexpr std::size_t fewest = 8, most = 64;
  if (head.size() < fewest || head.size() > most ||
      head.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw Error(fmt::format("--witness {}: expected a head, as a session prints it at its end: {} "
                            "to {} characters of 0-9 and a-f",
                            head, fewest, most),
                ExitCode::usage);
  const auto seals = reader.seals();
  const auto found =
      std::ranges::find_if(seals, [&](const Seal& seal) { return seal.head.starts_with(head); });
  if (found == seals.end())
    throw Error(fmt::format("no session of this log ended with the head {}: it is another log, or "
                            "sessions were removed or changed since",
                            head),
                ExitCode::diverged);
  return {*found, static_cast<int>(seals.end() - found) - 1};
}

}  // namespace heft
