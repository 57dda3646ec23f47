// Reading a log back, row for row as it was written. Readers never block the writer.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/Event.h"
#include "experiment/Rows.h"
#include "record/SessionLog.h"

namespace heft {

struct SessionRow {
  std::int64_t session_id = 0;
  SessionHeader header;
  SessionState state = SessionState::running;
};

/// A logged event with the attempt it belongs to (0: none).
struct LoggedEvent {
  Event event;
  int attempt_index = 0;
};

class LogReader {
 public:
  /// @throws Error when the file can't be read, is no heft log or newer than this program
  explicit LogReader(const std::string& path);
  LogReader(LogReader&&) noexcept;
  ~LogReader();

  std::vector<SessionRow> sessions() const;
  /// @throws Error when there is none of that id
  SessionRow session(std::int64_t session_id) const;

  // Each in the order of writing.
  std::vector<LoggedEvent> events(std::int64_t session_id) const;
  std::vector<TrialRow> trials(std::int64_t session_id) const;
  std::vector<CubeRow> cubes(std::int64_t session_id) const;
  std::vector<AnswerRow> answers(std::int64_t session_id) const;
  std::vector<ReversalRow> reversals(std::int64_t session_id) const;
  std::vector<EstimateRow> estimates(std::int64_t session_id) const;
  std::vector<FrameRow> frames(std::int64_t session_id, int attempt_index) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
