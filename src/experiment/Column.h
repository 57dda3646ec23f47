// What a column of the log is, told once. Each row type has visit_columns(row, visit), which calls
// visit(column, field) for every column in the log's order; writing, reading, digests, replay's
// comparison, CSV and the data dictionary are visitors. The field's type says the rest: an optional
// may be NULL, an enumeration is a closed list.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

/// The version of the log that this program writes.
inline constexpr int todays_log_version = 6;

struct LogColumn {
  std::string_view name;
  std::string_view unit;  ///< "s", "g"; empty: none
  std::string_view meaning;
  int since = 1;  ///< the version of the log that first has it
  /// What each value must be, as SQL over the column's name: ">= 0". Empty: anything.
  std::string_view check = {};
};

/// Seven columns, NAME_x_m ... NAME_qz, of a pose; NULL all seven where there is none.
struct PoseColumns {
  std::string_view name, meaning;
  int since = 1;
};

/// Six columns, NAME_vx_m_s ... NAME_wz_rad_s.
struct VelocityColumns {
  std::string_view name, meaning;
  int since = 1;
};

/// A pose that goes into the log with every bit, -0.0 too: what physics was given.
template <typename Pose>
struct Exactly {
  Pose& value;
};
template <typename Pose>
Exactly(Pose&) -> Exactly<Pose>;

/// A text that is NULL in the log where it is empty.
template <typename Text>
struct NullIfEmpty {
  Text& value;
};
template <typename Text>
NullIfEmpty(Text&) -> NullIfEmpty<Text>;

/// One of a row's poses by place, where there may be fewer.
template <typename Poses>
struct PoseAt {
  Poses& poses;
  std::size_t index;
};
template <typename Poses>
PoseAt(Poses&, std::size_t) -> PoseAt<Poses>;

}  // namespace heft
