// Rows into statements and out of cells, column by column as their descriptions say. Private to
// this room.
#pragma once

#include <concepts>

#include "experiment/EachCell.h"
#include "record/Binding.h"
#include "record/Cells.h"

namespace heft {

/// Writes a row's fields into a statement's places.
template <typename Row>
void bind_row(Binding& places, const Row& row) {
  visit_cells(row, [&](const CellColumn& column, const auto& value) {
    if constexpr (std::same_as<decltype(value), const double&>)
      column.exact ? places.exactly(value) : places << value;
    else
      places << value;
  });
}

/// Fills a row's fields from cells.
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

/// A row of an attempt, whose index is the first cell after the row's id.
template <typename Row>
Row attempt_row_from(Cells& cells) {
  const int attempt_index = cells.integer();
  Row row = row_from<Row>(cells);
  row.attempt_index = attempt_index;
  return row;
}

}  // namespace heft
