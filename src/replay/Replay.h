// Verifies a log against its events (replay), and displays a logged session: its frames as they
// were shown, optionally with the clone of a what-if simulation beside the logged one.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/LoggedSession.h"
#include "record/reader/LogReader.h"
#include "replay/AttemptReplay.h"
#include "view/ArView.h"

namespace heft {

/// The first difference between a log and its replay.
struct Divergence {
  int trial_number = 0;  ///< 0: none
  double t_s = 0;        ///< session time
  std::string what;      ///< table and row, or frame
  std::string logged, replayed;
};

struct Verification {
  int n_events = 0, n_rows = 0, n_attempts = 0, n_frames = 0;
  bool withdrawn = false;  ///< the session has no data any more
  bool ended = false;  ///< whether the session has ended; otherwise its part so far was verified
  /// Frames of a simulator edition that this program lacks: verified except for their poses.
  int n_other_edition = 0;
  int n_other_build = 0;                  ///< frames whose poses must agree within 1e-6 m
  double largest_difference_m = 0;        ///< of any of their poses
  double largest_of_other_edition_m = 0;  ///< of any pose that is only measured
  std::optional<Divergence> first;
};

/// @param progress called with the fraction of frames done, 0...1
Verification verify_session(const LogReader& reader, std::int64_t session_id,
                            const std::function<void(double)>& progress);

/// Everything except the simulation of frames.
Verification verify_rows(const LogReader& reader, std::int64_t session_id);

/// The first fault of the schema or the chain of seals, in words. It takes milliseconds.
std::optional<std::string> fault_of_structure(const LogReader& reader);

/// A log as a whole: pages, constraints, references, schema and the chain of seals.
/// @return a message for each fault
std::vector<std::string> faults_of_file(const LogReader& reader, const std::string& db);

/// The first fault of a log and its sessions, in words. Frames are not simulated.
/// @param session_ids empty: all  @param progress called with the fraction of sessions, 0...1
std::optional<std::string> fault_of_log(const LogReader& reader, const std::string& db,
                                        const std::vector<std::int64_t>& session_ids,
                                        const std::function<void(double)>& progress);

/// Verifies sessions without simulating frames, one at a time, before their figures are printed.
/// @param session_ids empty: all
/// @param unverified what the option of that name does, for the message
/// @return the log's head; empty for a log without sealed sessions
/// @throws Error (diverged) naming the first row that differs
std::string require_verified(
    const std::string& db, const std::vector<std::int64_t>& session_ids,
    const std::function<void(double)>& progress,
    std::string_view unverified = "prints its figures nevertheless, with a mark");

/// A witness: a head, or its first characters, that was noted when a session ended.
struct Witness {
  Seal seal;        ///< the one that the head is of
  int n_since = 0;  ///< sealed since then
};

/// @throws Error (usage) for a text that is no head; Error (diverged) if no seal of the log has it
Witness find_witness(const LogReader& reader, const std::string& head);

struct ReplayViewOptions {
  const Protocol* what_if = nullptr;  ///< whose clone is drawn, too; null: none
  bool in_real_time = false;          ///< at the frames' times; otherwise as fast as possible
  const std::atomic<bool>* stop = nullptr;
};

/// Lines of each frame's captions: the trial with its masses and time, the answers so far, the
/// colors.
inline constexpr int replay_captions = 3;

/// Presents every logged frame of the session's attempts, with captions.
/// @return number of frames
int show_session(const LogReader& reader, const LoggedSession& session, ArView& view,
                 const ReplayViewOptions& showing);

}  // namespace heft
