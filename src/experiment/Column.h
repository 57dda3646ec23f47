// What a column of the log is, told once. Each row type has visit_columns(row, visit), which calls
// visit(column, field) for every column in the log's order; writing, reading, digests, replay's
// comparison, CSV and the data dictionary are visitors. The field's type says the rest: an optional
// may be NULL, an enumeration is a closed list.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/Names.h"
#include "base/PoseTypes.h"

namespace heft {

/// The version of the log that this program writes, and the oldest that it reads.
inline constexpr int todays_log_version = 6, oldest_log_version = 5;

struct LogColumn {
  std::string_view name;
  std::string_view unit;  ///< "s", "g"; empty: none
  std::string_view meaning;
  /// What each value must be, as SQL over the column's name: ">= 0". Empty: anything.
  std::string_view check = {};
};

/// Seven columns, NAME_x_m ... NAME_qz, of a pose; NULL all seven where there is none.
struct PoseColumns {
  std::string_view name, meaning;
};

/// Six columns, NAME_vx_m_s ... NAME_wz_rad_s.
struct VelocityColumns {
  std::string_view name, meaning;
};

/// A pose that goes into the log with every bit, -0.0 too: what physics was given.
template <typename Pose>
struct Exactly {
  Pose& value;
};
template <typename Pose>
Exactly(Pose&) -> Exactly<Pose>;

/// A value that is a text in the log, by the to_text() and from_text() of its type.
template <typename Value>
struct AsText {
  Value& value;
};
template <typename Value>
AsText(Value&) -> AsText<Value>;

/// The same, NULL in the log where the text is empty.
template <typename Value>
struct NullIfEmpty {
  Value& value;
};
template <typename Value>
NullIfEmpty(Value&) -> NullIfEmpty<Value>;

inline std::string to_text(const std::string& text) {
  return text;
}
template <typename Enum>
requires std::is_enum_v<Enum> std::string to_text(Enum value) {
  return std::string(name_of(value));
}
template <typename Value>
std::string to_text(const std::optional<Value>& value) {
  return value ? to_text(*value) : "";
}

// What a text does not say stays. @return false: no text of such a value

inline bool from_text(std::string_view text, std::string& value) {
  value = text;
  return true;
}
template <typename Enum>
requires std::is_enum_v<Enum>
bool from_text(std::string_view text, Enum& value) {
  const auto found = named<Enum>(text);
  value = found.value_or(value);
  return found.has_value();
}
template <typename Value>
bool from_text(std::string_view text, std::optional<Value>& value) {
  value.reset();
  return text.empty() || from_text(text, value.emplace());
}

/// One of a row's poses by place, where there may be fewer.
template <typename Poses>
struct PoseAt {
  Poses& poses;
  std::size_t index;
};
template <typename Poses>
PoseAt(Poses&, std::size_t) -> PoseAt<Poses>;

}  // namespace heft
