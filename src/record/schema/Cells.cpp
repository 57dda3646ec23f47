#include "record/schema/Cells.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

namespace heft {

namespace {
std::string shown(const SQLite::Column& cell) {
  if (cell.isNull()) return "nothing (NULL)";
  return fmt::format("\"{}\"", cell.getString());
}
}  // namespace

Cells::Cells(SQLite::Statement& query, std::string_view file, std::string_view table)
    : query_(query), file_(file), table_(table), id_(query.getColumn(0).getInt64()) {}

SQLite::Column Cells::next(int type, std::string_view expected) {
  const SQLite::Column cell = query_.getColumn(++column_);
  if (cell.getType() != type) refuse(shown(cell), expected);
  return cell;
}

std::int64_t Cells::long_integer() {
  return next(SQLITE_INTEGER, "a whole number").getInt64();
}

int Cells::integer() {
  const std::int64_t value = long_integer();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    refuse(std::to_string(value), "a 32-bit whole number");
  return static_cast<int>(value);
}

bool Cells::flag() {
  const std::int64_t value = long_integer();
  if (value != 0 && value != 1) refuse(std::to_string(value), "0 or 1");
  return value == 1;
}

double Cells::real() {
  return next(SQLITE_FLOAT, "a number").getDouble();
}

std::string Cells::text() {
  return next(SQLITE_TEXT, "a text").getString();
}

Eigen::Vector3d Cells::vector() {
  const double x = real(), y = real(), z = real();
  return {x, y, z};
}

Pose Cells::pose() {
  Pose pose;
  pose.position_m = vector();
  const double w = real(), x = real(), y = real(), z = real();
  pose.orientation = Eigen::Quaterniond(w, x, y, z);
  return pose;
}

bool Cells::next_is_null() const {
  return query_.getColumn(column_ + 1).isNull();
}

bool Cells::skip_null() {
  if (!next_is_null()) return false;
  ++column_;
  return true;
}

std::optional<std::string> Cells::text_or_none() {
  if (skip_null()) return std::nullopt;
  return text();
}

std::optional<Pose> Cells::pose_or_none() {
  constexpr int pose_columns = 7;
  if (!next_is_null()) return pose();
  for (int i = 0; i < pose_columns; ++i)
    if (!skip_null()) {
      ++column_;
      refuse(shown(query_.getColumn(column_)), "nothing (NULL), as in the pose's first column");
    }
  return std::nullopt;
}

void Cells::refuse(const std::string& found, std::string_view expected) const {
  throw Error(fmt::format(
      "{}, table {}, row {}, column {}: expected {}, found {}. The file is damaged or was changed "
      "by another program. Check it with heft doctor, or use a backup.",
      file_, table_, id_, query_.getColumnName(column_), expected, found));
}

void Cells::refuse_name(const std::string& found, const std::string& names) const {
  refuse(fmt::format("\"{}\"", found), names);
}

}  // namespace heft
