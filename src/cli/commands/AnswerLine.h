// One line of input to `heft procedure`: the answer to a trial, or a void trial.
#pragma once

#include <optional>
#include <string>

#include "psychophysics/ProcedureTypes.h"

namespace heft::cli {

struct AnswerLine {
  bool is_void = false;
  Response response;            ///< unless void
  std::optional<double> level;  ///< presented, if it differs from the trial's
};

/// Reads {"response":true|false} or {"answer":"comparison"|"reference"|"none"}, with or without
/// "level":X, or {"void":true}.
/// @throws Error naming what was expected
AnswerLine parse_answer(const std::string& line);

}  // namespace heft::cli
