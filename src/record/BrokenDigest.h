// A row of a log that is not as it was written.
#pragma once

#include <cstdint>
#include <string>

namespace heft {

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

}  // namespace heft
