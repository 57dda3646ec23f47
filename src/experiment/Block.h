// The parts of a session that are no trials, and when trials may begin. Blocks of trials are the
// tasks' own (src/tasks).
#pragma once

#include <string>

namespace heft {

struct DemonstrationBlock {
  std::string name;
  double duration_s = 20;
};

struct BreakBlock {
  std::string name;
  double least_duration_s = 60;
};

/// When a trial may begin and be answered: the second tap of two must meet nothing that it could
/// answer. The values in effect are recorded in the session's setup.
struct Onset {
  double gap_s = 0.6;         ///< from a trial's end to the next one's start
  double min_answer_s = 0.5;  ///< from a trial's cubes to the first answer that is taken
};

}  // namespace heft
