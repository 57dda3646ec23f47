// Reading a log and checking its integrity. Rows are returned as they were written; readers never
// block the writer.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "record/integrity/Integrity.h"
#include "record/schema/SessionHeader.h"

namespace heft {

struct SessionRow {
  std::int64_t session_id = 0;
  SessionHeader header;
  SessionState state = SessionState::running;
};

/// Whether a session in this state can be resumed.
inline bool is_unfinished(SessionState state) {
  return state == SessionState::running || state == SessionState::paused;
}

/// A logged event and its attempt (0: none).
struct LoggedEvent {
  Event event;
  int attempt_index = 0;
};

/// A configuration and the event from which it is in effect.
struct LoggedSetup {
  int setup_index = 0;  ///< from 1
  int from_event = 0;   ///< number of its event in the session, from 1
  SessionConfig setup;
};

/// Counts of frames in trials.
struct FrameCounts {
  int n_frames = 0, n_tracked = 0, n_jumps = 0;
  std::optional<double> mean_quality;  ///< of poses with a quality
};

/// A snapshot of the log at the time of opening. An empty file, as a crash during creation leaves
/// it, is a log without sessions. All methods throw Error naming table, row and column of an
/// invalid value, and Error if the file is damaged. Numbers keep their bits, except that -0.0 is
/// read as 0.0 outside a frame's effector columns.
class LogReader {
 public:
  /// @throws Error if the file cannot be read, is no heft log or is of a newer version
  explicit LogReader(const std::string& path);
  LogReader(LogReader&&) noexcept;
  LogReader& operator=(LogReader&&) noexcept;
  ~LogReader();

  /// In the order of writing, as all lists of this class.
  std::vector<SessionRow> sessions() const;
  /// For logs whose sessions do not fit into memory together.
  std::vector<std::int64_t> session_ids() const;
  /// @throws Error if there is no such session
  SessionRow session(std::int64_t session_id) const;
  std::vector<SessionRow> sessions_of(const std::string& participant,
                                      const std::string& protocol_name) const;
  std::optional<SessionRow> newest_unfinished_session() const;

  std::vector<LoggedEvent> events(std::int64_t session_id) const;
  /// Events of some kinds only, which is faster.
  std::vector<LoggedEvent> events(std::int64_t session_id, std::span<const EventKind> kinds) const;
  /// Configurations, with the contents of files.
  std::vector<LoggedSetup> setups(std::int64_t session_id) const;
  std::vector<TrialRow> trials(std::int64_t session_id) const;  ///< masses are those of their cubes
  std::vector<CubeRow> cubes(std::int64_t session_id) const;
  std::vector<AnswerRow> answers(std::int64_t session_id) const;
  std::vector<ReversalRow> reversals(std::int64_t session_id) const;
  std::vector<EstimateRow> estimates(std::int64_t session_id) const;
  std::vector<ParticipantParameterRow> participant_parameters(std::int64_t session_id) const;
  /// @param attempt_index 0: frames outside trials
  std::vector<FrameRow> frames(std::int64_t session_id, int attempt_index) const;

  FrameCounts frame_counts(std::int64_t session_id) const;
  /// Largest turn of the clone against the effector while it touched a cube (v_frame), either way,
  /// by attempt index and slot; only where frames were kept.
  std::map<std::pair<int, int>, double> clone_yaw_deg(std::int64_t session_id) const;

  /// In the order of sealing; the last one has the log's head.
  std::vector<Seal> seals() const;
  /// The log's head; empty if no session was sealed.
  std::string head() const;
  /// The head when a session was last sealed; empty: never.
  std::string head_of(std::int64_t session_id) const;

  /// The first fault in the chain of seals: a session that was removed, added, renumbered or
  /// swapped. The session's own contents are compared by first_broken_digest().
  std::optional<BrokenDigest> first_broken_seal() const;

  /// Differences of the file from a log; see schema::foreign_objects.
  std::vector<std::string> foreign_objects() const;

  /// Checks the digests of the session's header, participant's answers, events and frames, in that
  /// order, events and frames by time, then its seals. Changed, removed, inserted, swapped and
  /// invalid rows are found. Not found: changes of the session's state and of the other tables,
  /// which follow from the events, and edits with all later digests recomputed.
  /// @throws Error if there is no such session or pages of the file are damaged
  std::optional<BrokenDigest> first_broken_digest(std::int64_t session_id) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Checks pages, types, constraints and references of the whole file with SQLite.
/// @return a message for each fault
/// @throws Error if the file cannot be read or is no heft log
std::vector<std::string> check_integrity(const std::string& path);

}  // namespace heft
