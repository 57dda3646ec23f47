// Procedures as a dialog, one JSON object per line: trials out, answers in. `heft procedure --help`
// shows the lines.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "psychophysics/Interleaving.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft::cli {

/// One line of input: the answer to a trial, or a void trial.
struct AnswerLine {
  bool is_void = false;
  Response response;            ///< unless void
  std::optional<double> level;  ///< presented, if it differs from the trial's
};

/// Reads {"response":true|false} or {"answer":"comparison"|"reference"|"none"}, with or without
/// "level":X, or {"void":true}.
/// @throws Error naming what was expected
AnswerLine parse_answer(const std::string& line);

class ProcedureDialog {
 public:
  /// @param out every line is flushed
  /// @param with_posterior whether Bayesian kinds write their posterior after each answer, and the
  /// level that they recommend with each trial
  ProcedureDialog(InterleavedProcedures procedures, std::ostream& out, bool with_posterior = false);

  /// Runs the dialog until every staircase is finished or the input ends.
  /// @throws Error if a line cannot be written
  void run(std::istream& in);

 private:
  void take(const std::string& line, int line_number);
  void respond(const AnswerLine& answer);
  void write_trial();
  void write(const std::string& json);

  InterleavedRun run_;
  std::ostream& out_;
  bool with_posterior_;
};

}  // namespace heft::cli
