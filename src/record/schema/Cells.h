// The cells of a row that is read, in order. An invalid value is an Error naming table, row and
// column. Private to record.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "base/Error.h"
#include "base/Names.h"
#include "base/PoseTypes.h"
#include "experiment/Rows.h"
#include "tasks/Task.h"

namespace SQLite {
class Column;
class Statement;
}  // namespace SQLite

namespace heft {

class Cells {
 public:
  /// @param query is at a row whose first column is its id
  Cells(SQLite::Statement& query, std::string_view file, std::string_view table);

  std::int64_t id() const { return id_; }

  std::int64_t long_integer();
  int integer();
  bool flag();
  double real();
  std::string text();
  Eigen::Vector3d vector();
  Pose pose();

  std::optional<std::string> text_or_none();
  std::optional<Pose> pose_or_none();

  void read(int& value) { value = integer(); }
  void read(std::uint64_t& value) { value = static_cast<std::uint64_t>(long_integer()); }
  void read(bool& value) { value = flag(); }
  void read(double& value) { value = real(); }
  void read(std::string& value) { value = text(); }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void read(Enum& value) { value = name<Enum>(); }
  template <typename List>
  void read(Word<List>& word) {
    word = text();
    if (const auto words = words_of<Word<List>>();
        std::ranges::find(words, std::string_view(word)) == words.end())
      refuse_name(word, quoted_list(words));
  }
  template <typename Value>
  void read(std::optional<Value>& value) {
    value.reset();
    if (!skip_null()) read(value.emplace());
  }

  /// Converts the text of the last cell.
  template <typename Value>
  void read_as(Value& value, const std::string& text) {
    if (!from_text(text, value)) refuse_name(text, "a valid text");
  }

  template <typename Enum>
  Enum name() {
    const std::string written = text();
    if (const auto value = named<Enum>(written)) return *value;
    refuse_name(written, quoted_list(EnumNames<Enum>::names));
  }

 private:
  bool next_is_null() const;
  bool skip_null();
  SQLite::Column next(int type, std::string_view expected);
  [[noreturn]] void refuse(const std::string& found, std::string_view expected) const;
  [[noreturn]] void refuse_name(const std::string& found, const std::string& names) const;

  SQLite::Statement& query_;
  std::string_view file_, table_;
  int column_ = 0;  ///< index of the last cell
  std::int64_t id_ = 0;
};

/// A visitor that fills a row's fields from cells.
class FillRow {
 public:
  explicit FillRow(Cells& cells) : cells_(cells) {}

  template <typename Field>
  void operator()(const LogColumn&, Field& field) {
    cells_.read(field);
  }
  template <typename Value>
  void operator()(const LogColumn&, const AsText<Value>& field) {
    cells_.read_as(field.value, cells_.text());
  }
  template <typename Value>
  void operator()(const LogColumn&, const NullIfEmpty<Value>& field) {
    cells_.read_as(field.value, cells_.text_or_none().value_or(""));
  }
  void operator()(const PoseColumns&, const Exactly<Pose>& pose) { pose.value = cells_.pose(); }
  void operator()(const VelocityColumns&, const Exactly<Velocity>& velocity) {
    velocity.value.linear_m_s = cells_.vector();
    velocity.value.angular_rad_s = cells_.vector();
  }
  void operator()(const PoseColumns&, std::optional<Pose>& pose) { pose = cells_.pose_or_none(); }
  void operator()(const PoseColumns&, const PoseAt<std::vector<Pose>>& at) {
    if (const auto pose = cells_.pose_or_none()) at.poses.push_back(*pose);
  }

 private:
  Cells& cells_;
};

template <typename Row>
Row row_from(Cells& cells) {
  Row row{};
  visit_columns(row, FillRow(cells));
  return row;
}

/// A row of an attempt; the attempt index follows the row's id.
template <typename Row>
Row attempt_row_from(Cells& cells) {
  const int attempt_index = cells.integer();
  Row row = row_from<Row>(cells);
  row.attempt_index = attempt_index;
  return row;
}

}  // namespace heft
