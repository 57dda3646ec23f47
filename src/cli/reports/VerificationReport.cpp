// heft replay: whether each session agrees with its events.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/Names.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "replay/Replay.h"

namespace heft::cli {

namespace {
void print_divergence(const Divergence& divergence) {
  const std::string trial =
      divergence.trial_number > 0 ? fmt::format("trial {}", divergence.trial_number) : "no trial";
  print("  first divergence: {}, at {:.6f} s: {}\n    logged:   {}\n    replayed: {}\n", trial,
        divergence.t_s, divergence.what, divergence.logged, divergence.replayed);
}

std::string how_frames_were_checked(const Verification& found) {
  if (found.n_frames == 0) return "no frames logged, so the simulator was not checked";
  const int n_same_edition = found.n_frames - found.n_other_edition;
  std::vector<std::string> how;
  if (found.n_other_edition > 0)
    how.push_back(
        fmt::format("{} of them logged with an edition of the simulator that this heft lacks: "
                    "only measured, they differ by up to {:.3g} m",
                    found.n_other_edition, found.largest_of_other_edition_m));
  if (found.n_other_build > 0)
    how.push_back(fmt::format(
        "{}logged by another build: poses within 1e-6 m required, largest difference {:.3g} m",
        found.n_other_build == found.n_frames ? ""
                                              : fmt::format("{} of them ", found.n_other_build),
        found.largest_difference_m));
  if (const int n_same = n_same_edition - found.n_other_build; n_same > 0)
    how.push_back(n_same == found.n_frames
                      ? "equal bits required"
                      : fmt::format("of the other {} equal bits required", n_same));
  return fmt::format("{} simulated again, {}", counted(found.n_frames, "frame"),
                     fmt::join(how, "; "));
}

void print_verified(std::string_view sessions, std::string_view verdict,
                    const Verification& found) {
  print("{}: {}: {} events folded, {} rows in {} attempts compared; {}\n", sessions, verdict,
        found.n_events, found.n_rows, found.n_attempts, how_frames_were_checked(found));
}

// Finished sessions that agree with their events: a line for those that follow each other.
class VerifiedSessions {
 public:
  void add(std::int64_t session_id, const Verification& found) {
    if (n_++ == 0) first_ = session_id;
    last_ = session_id;
    sum_.n_events += found.n_events;
    sum_.n_rows += found.n_rows;
    sum_.n_attempts += found.n_attempts;
    sum_.n_frames += found.n_frames;
    sum_.n_other_edition += found.n_other_edition;
    sum_.n_other_build += found.n_other_build;
    sum_.largest_difference_m = std::max(sum_.largest_difference_m, found.largest_difference_m);
    sum_.largest_of_other_edition_m =
        std::max(sum_.largest_of_other_edition_m, found.largest_of_other_edition_m);
  }

  void print_line() {
    if (n_ > 0)
      print_verified(n_ == 1 ? fmt::format("session {}", first_)
                             : fmt::format("sessions {} to {}", first_, last_),
                     "verified", sum_);
    *this = {};
  }

 private:
  int n_ = 0;
  std::int64_t first_ = 0, last_ = 0;
  Verification sum_;
};

// @return whether the log agrees with its events
bool verify(const LogReader& reader, std::int64_t session_id, VerifiedSessions& verified) {
  Verification found;
  {
    ProgressBar bar(fmt::format("session {}", session_id));
    found = verify_session(reader, session_id, [&](double done) {
      bar.update(done, fmt::format("{:.0f} %", 100 * done));
    });
  }
  if (found.ended && !found.withdrawn && !found.first) {
    verified.add(session_id, found);
    return true;
  }
  verified.print_line();
  if (found.withdrawn && !found.first) {
    print("session {}: withdrawn: it has no data any more\n", session_id);
    return true;
  }
  print_verified(
      fmt::format("session {}", session_id),
      found.first ? "DIVERGED" : fmt::format("verified up to event {}, unfinished", found.n_events),
      found);
  if (found.first) print_divergence(*found.first);
  return !found.first;
}
}  // namespace

void print_verification(const LogReader& reader, const std::vector<std::int64_t>& ids, bool& same) {
  VerifiedSessions verified;
  try {
    for (const std::int64_t session_id : ids) same = verify(reader, session_id, verified) && same;
  } catch (...) {
    verified.print_line();
    throw;
  }
  verified.print_line();
}

}  // namespace heft::cli
