// One line of input to `heft procedure`: the answer to a trial, or that the trial is void.
#pragma once

#include <optional>
#include <string>

#include "psychophysics/ProcedureTypes.h"

namespace heft::cli {

struct AnswerLine {
  bool is_void = false;
  Response response;            ///< when not void
  std::optional<double> level;  ///< really shown, where it was not the trial's
};

/// Reads {"response":true|false} or {"answer":"comparison"|"reference"|"none"}, with "level":X
/// beside it or without, or {"void":true}.
/// @throws Error saying what was expected instead of this
AnswerLine parse_answer(const std::string& line);

}  // namespace heft::cli
