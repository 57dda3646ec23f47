// What a row's description gives as SQL: its columns' names, and how a table declares them. Private
// to this room.
#pragma once

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/Rows.h"
#include "record/ClosedLists.h"

namespace heft {

inline constexpr std::array pose_suffixes{"_x_m", "_y_m", "_z_m", "_qw", "_qx", "_qy", "_qz"};
inline constexpr std::array velocity_suffixes{"_vx_m_s",   "_vy_m_s",   "_vz_m_s",
                                              "_wx_rad_s", "_wy_rad_s", "_wz_rad_s"};

/// Each column's name and declaration, those of versions up to `version`.
class ColumnSql {
 public:
  explicit ColumnSql(int version) : version_(version) {}

  template <typename Field>
  void operator()(const LogColumn& column, const Field&) {
    if (column.since > version_) return;
    add(std::string(column.name), declared<Field>(column), column.since);
  }
  void operator()(const PoseColumns& columns, const Exactly<const Pose>&) {
    for (const char* suffix : pose_suffixes) add_exact(columns, suffix);
  }
  void operator()(const VelocityColumns& columns, const Exactly<const Velocity>&) {
    for (const char* suffix : velocity_suffixes) add_exact(columns, suffix);
  }
  template <typename Pose>
  void operator()(const PoseColumns& columns, const Pose&) {
    if (columns.since > version_) return;
    for (const char* suffix : pose_suffixes)
      add(fmt::format("{}{}", columns.name, suffix), "REAL", columns.since);
  }

  std::vector<std::string> names, declarations;
  std::vector<int> since;  ///< versions

 private:
  void add(std::string name, const std::string& type, int first_version) {
    since.push_back(first_version);
    declarations.push_back(fmt::format("{} {}", name, type));
    names.push_back(std::move(name));
  }
  // A REAL column forgets the sign of -0.0, and physics makes other bits of it.
  template <typename Columns>
  void add_exact(const Columns& columns, const char* suffix) {
    const std::string name = fmt::format("{}{}", columns.name, suffix);
    add(name, fmt::format("ANY NOT NULL CHECK (typeof({}) IN ('real', 'integer'))", name),
        columns.since);
  }

  template <typename Field>
  static std::string declared(const LogColumn& column) {
    if constexpr (requires { typename Field::value_type; } && !std::same_as<Field, std::string>)
      return type_of<typename Field::value_type>() + checked<typename Field::value_type>(column);
    else if constexpr (requires(Field field) { field.value; })
      return "TEXT" + checked<std::string>(column);
    else
      return type_of<Field>() + " NOT NULL" + checked<Field>(column);
  }
  template <typename Value>
  static std::string type_of() {
    if constexpr (std::is_enum_v<Value> || std::same_as<Value, std::string>)
      return "TEXT";
    else if constexpr (std::floating_point<Value>)
      return "REAL";
    else
      return "INTEGER";
  }
  template <typename Value>
  static std::string checked(const LogColumn& column) {
    if constexpr (std::is_enum_v<Value>)
      return fmt::format(" REFERENCES {}", closed_list<Value>);
    else if constexpr (std::same_as<Value, bool>)
      return fmt::format(" CHECK ({} IN (0, 1))", column.name);
    else
      return column.check.empty() ? "" : fmt::format(" CHECK ({} {})", column.name, column.check);
  }

  int version_;
};

/// @param version of the log; later columns are left out
template <typename Row>
ColumnSql sql_of(int version = std::numeric_limits<int>::max()) {
  ColumnSql sql(version);
  const Row row{};
  visit_columns(row, sql);
  return sql;
}

/// "t_s, kind, slot"
template <typename Row>
std::string columns_of(int version = std::numeric_limits<int>::max()) {
  return fmt::format("{}", fmt::join(sql_of<Row>(version).names, ", "));
}

}  // namespace heft
