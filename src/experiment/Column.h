// Columns of the log, declared once. Each row type has visit_columns(row, visit), which calls
// visit(column, field) for every column in the log's order. Writing, reading, digests, replay's
// comparison, CSV and the data dictionary are visitors. Types follow from the field: an optional
// may be NULL, an enumeration is a closed list.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/Names.h"
#include "base/PoseTypes.h"

namespace heft {

/// Version of the log that this program writes, and the oldest that it reads.
inline constexpr int current_log_version = 9, oldest_log_version = 5;

struct LogColumn {
  std::string_view name;
  std::string_view unit;     ///< "s", "g"; empty: none
  std::string_view meaning;  ///< for the data dictionary
  /// Constraint on each value, as SQL after the column's name: ">= 0"; empty: none.
  std::string_view check = {};
};

/// The seven columns NAME_x_m ... NAME_qz of a pose; all NULL if there is none.
struct PoseColumns {
  std::string_view name, meaning;
};

/// The six columns NAME_vx_m_s ... NAME_wz_rad_s of a velocity.
struct VelocityColumns {
  std::string_view name, meaning;
};

/// A pose or velocity that the log keeps bit for bit, including -0.0: input of the physics.
template <typename Pose>
struct Exactly {
  Pose& value;
};
template <typename Pose>
Exactly(Pose&) -> Exactly<Pose>;

/// A value that is a text in the log, by to_text() and from_text() of its type.
template <typename Value>
struct AsText {
  Value& value;
};
template <typename Value>
AsText(Value&) -> AsText<Value>;

/// The same; an empty text is NULL in the log.
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

// @return false, leaving the value unchanged, if the text is no such value

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
  Value parsed{};
  const bool is_valid = text.empty() || from_text(text, parsed);
  if (is_valid) value = text.empty() ? std::nullopt : std::optional(std::move(parsed));
  return is_valid;
}

/// One of a row's poses by index; NULL if there are fewer.
template <typename Poses>
struct PoseAt {
  Poses& poses;
  std::size_t index;
};
template <typename Poses>
PoseAt(Poses&, std::size_t) -> PoseAt<Poses>;

/// A single column of a table: poses and velocities are split into their parts.
struct CellColumn {
  std::string_view name, suffix, unit, meaning;
  std::string_view check = {};
  bool exact = false;  ///< kept bit for bit, including -0.0

  std::string full_name() const { return std::string(name) + std::string(suffix); }
};

/// A visitor of columns that calls visit(CellColumn, value) for every single column. The value is a
/// bool, a number, a text, an enumeration, or an optional of one of these.
template <typename Visit>
class EachCell {
 public:
  explicit EachCell(Visit& visit) : visit_(visit) {}

  template <typename Field>
  void operator()(const LogColumn& column, const Field& field) {
    visit_(of(column), field);
  }
  template <typename Value>
  void operator()(const LogColumn& column, const NullIfEmpty<const Value>& field) {
    const std::string text = to_text(field.value);
    visit_(of(column), text.empty() ? std::nullopt : std::optional(text));
  }
  template <typename Value>
  void operator()(const LogColumn& column, const AsText<const Value>& field) {
    visit_(of(column), to_text(field.value));
  }
  void operator()(const PoseColumns& columns, const Exactly<const Pose>& pose) {
    const auto cells = cells_of(pose.value);
    for (std::size_t i = 0; i < pose_parts.size(); ++i)
      visit_(of(columns, pose_parts.at(i), true), cells.at(i));
  }
  void operator()(const VelocityColumns& columns, const Exactly<const Velocity>& velocity) {
    const auto &v = velocity.value.linear_m_s, &w = velocity.value.angular_rad_s;
    const std::array cells{v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
    for (std::size_t i = 0; i < velocity_parts.size(); ++i)
      visit_(of(columns, velocity_parts.at(i), true), cells.at(i));
  }
  void operator()(const PoseColumns& columns, const std::optional<Pose>& pose) {
    visit_pose(columns, pose ? &*pose : nullptr);
  }
  void operator()(const PoseColumns& columns, const PoseAt<const std::vector<Pose>>& at) {
    visit_pose(columns, at.index < at.poses.size() ? &at.poses[at.index] : nullptr);
  }

 private:
  struct Part {
    std::string_view suffix, unit;
  };
  static constexpr std::array pose_parts{Part{"_x_m", "m"}, Part{"_y_m", "m"}, Part{"_z_m", "m"},
                                         Part{"_qw", ""},   Part{"_qx", ""},   Part{"_qy", ""},
                                         Part{"_qz", ""}};
  static constexpr std::array velocity_parts{
      Part{"_vx_m_s", "m/s"},     Part{"_vy_m_s", "m/s"},     Part{"_vz_m_s", "m/s"},
      Part{"_wx_rad_s", "rad/s"}, Part{"_wy_rad_s", "rad/s"}, Part{"_wz_rad_s", "rad/s"}};

  static CellColumn of(const LogColumn& column) {
    return {column.name, {}, column.unit, column.meaning, column.check};
  }
  template <typename Columns>
  static CellColumn of(const Columns& columns, const Part& part, bool exact) {
    return {columns.name, part.suffix, part.unit, columns.meaning, {}, exact};
  }
  static std::array<double, 7> cells_of(const Pose& pose) {
    const auto& p = pose.position_m;
    const auto& q = pose.orientation;
    return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
  }
  void visit_pose(const PoseColumns& columns, const Pose* pose) {
    const auto cells = pose ? cells_of(*pose) : std::array<double, 7>{};
    for (std::size_t i = 0; i < pose_parts.size(); ++i)
      visit_(of(columns, pose_parts.at(i), false),
             pose ? std::optional(cells.at(i)) : std::nullopt);
  }

  Visit& visit_;
};

template <typename Row, typename Visit>
void visit_cells(const Row& row, Visit&& visit) {
  visit_columns(row, EachCell(visit));
}

}  // namespace heft
