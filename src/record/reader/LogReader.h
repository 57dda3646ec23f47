// Reading a log back, row for row as it was written. Readers never block the writer.
// Whether a log is sound as a file: for doctor and replay.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "record/schema/SessionHeader.h"

namespace heft {

struct SessionRow {
  std::int64_t session_id = 0;
  SessionHeader header;
  SessionState state = SessionState::running;
};

/// Whether `heft resume` can go on with a session in this state.
inline bool is_unfinished(SessionState state) {
  return state == SessionState::running || state == SessionState::paused;
}

/// A logged event with the attempt it belongs to (0: none).
struct LoggedEvent {
  Event event;
  int attempt_index = 0;
};

/// The configuration in effect from an event on.
struct LoggedSetup {
  int setup_index = 0;  ///< from 1
  int from_event = 0;   ///< the session's event that logged it, from 1
  SessionConfig setup;
};

/// How well the effector was tracked.
struct FrameCounts {
  int n_frames = 0, n_tracked = 0, n_jumps = 0;
  std::optional<double> mean_quality;  ///< of the poses that tell theirs
};

/// The first row of a chain of digests whose own does not fit: it was changed, or rows directly
/// before it were changed together with their digests, taken out, put in or swapped.
struct BrokenDigest {
  std::string table;  ///< session (its header), event or frame
  std::int64_t row_id = 0;
  int attempt_index = 0;  ///< 0: outside of attempts, or of a trial that the session does not have
  double t_s = 0;         ///< the row's, as the file has it now; 0 for a session
  std::string logged, recomputed;
  std::string row;     ///< for a person: `the event "note" of attempt 2 at 12.500 s`
  std::string damage;  ///< where the row can't be one of ours at all: why; else empty
};

/// The log as it was when it was opened; what a writer adds later is not seen. An empty file, as a
/// crash while it is created leaves it, is a log without sessions. Every method throws Error naming
/// table, row and column where a value can't be one of ours, and Error where the file is damaged.
/// Numbers have the bits that were written, but -0.0 comes back as 0.0 except in a frame's
/// effector.
class LogReader {
 public:
  /// @throws Error when the file can't be read, is no heft log or newer than this program
  explicit LogReader(const std::string& path);
  LogReader(LogReader&&) noexcept;
  LogReader& operator=(LogReader&&) noexcept;
  ~LogReader();

  /// Oldest first, as all lists here: in the order of writing.
  std::vector<SessionRow> sessions() const;
  /// For those that would not be in memory all at once.
  std::vector<std::int64_t> session_ids() const;
  /// @throws Error when there is none of that id
  SessionRow session(std::int64_t session_id) const;
  std::vector<SessionRow> sessions_of(const std::string& participant,
                                      const std::string& protocol_name) const;
  std::optional<SessionRow> newest_unfinished_session() const;

  std::vector<LoggedEvent> events(std::int64_t session_id) const;
  /// Those of some kinds: a session's thousands of pushes and actions need not be built for a note.
  std::vector<LoggedEvent> events(std::int64_t session_id, std::span<const EventKind> kinds) const;
  /// With the contents of their files.
  std::vector<LoggedSetup> setups(std::int64_t session_id) const;
  std::vector<TrialRow> trials(std::int64_t session_id) const;  ///< masses from their cube rows
  std::vector<CubeRow> cubes(std::int64_t session_id) const;
  std::vector<AnswerRow> answers(std::int64_t session_id) const;
  std::vector<ReversalRow> reversals(std::int64_t session_id) const;
  std::vector<EstimateRow> estimates(std::int64_t session_id) const;
  std::vector<ParticipantParameterRow> participant_parameters(std::int64_t session_id) const;
  /// @param attempt_index 0: the frames outside of trials
  std::vector<FrameRow> frames(std::int64_t session_id, int attempt_index) const;

  /// Of the frames of its trials, counted where they lie.
  FrameCounts frame_counts(std::int64_t session_id) const;

  /// What the file holds that a log does not; see schema::foreign_objects.
  std::vector<std::string> foreign_objects() const;

  /// Whether the session's header, events and frames are as they were written: no column changed,
  /// no row taken out, put in or swapped. The header comes first, then the earliest row by t_s. A
  /// row that can't be one of ours is found, not thrown. Not seen: the
  /// session's state and the other tables, which the events tell, and a forger who computes all
  /// later digests anew.
  /// @throws Error when there is no such session, or pages of the file are damaged
  std::optional<BrokenDigest> first_broken_digest(std::int64_t session_id) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Pages, types, rules and references of the whole file, as SQLite checks them.
/// @return a sentence for each fault found; empty when the file is sound
/// @throws Error when it can't be read at all or is no heft log
std::vector<std::string> check_integrity(const std::string& path);

}  // namespace heft
