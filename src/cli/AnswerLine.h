// One line of input to `heft procedure`: the answer to a trial, or that the trial is void.
#pragma once

#include <optional>
#include <string>

namespace heft::cli {

struct AnswerLine {
  bool is_void = false;
  bool positive = false;        ///< when not void
  std::optional<double> level;  ///< really shown, where it was not the trial's
};

/// Reads {"response":true|false}, with "level":X beside it or without, or {"void":true}.
/// @throws Error saying what was expected instead of this
AnswerLine parse_answer(const std::string& line);

}  // namespace heft::cli
