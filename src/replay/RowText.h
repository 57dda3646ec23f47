// Projected rows as named columns of text, so that logged and folded rows can be compared and a
// difference named. Doubles are written so that equal text means equal bits.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "experiment/Rows.h"

namespace heft {

struct ColumnText {
  std::string name, value;
  int since = 1;  ///< the version of the log that first has it
};

struct RowText {
  std::string table;  ///< as the log calls it
  std::string key;    ///< which row, for people: "cube 2 of trial 7"
  int attempt_index = 0;
  double t_s = 0;  ///< session time that the row belongs to; negative: its attempt's end
  std::vector<ColumnText> columns;
};

/// Puts a row's columns into text; see visit_columns.
class TextColumns {
 public:
  explicit TextColumns(RowText& row) : row_(row) {}

  template <typename Field>
  void operator()(const LogColumn& column, const Field& field) {
    row_.columns.push_back({std::string(column.name), text(field), column.since});
  }

 private:
  static std::string text(const std::string& value) { return '"' + value + '"'; }
  static std::string text(bool value) { return value ? "1" : "0"; }
  static std::string text(int value) { return fmt::format("{}", value); }
  // Adding 0 turns -0, which the log does not keep, into 0.
  static std::string text(double value) { return fmt::format("{}", value + 0.0); }
  static std::string text(const NullIfEmpty<const std::string>& value) { return text(value.value); }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  static std::string text(Enum value) { return std::string(name_of(value)); }
  template <typename Value>
  static std::string text(const std::optional<Value>& value) {
    return value ? text(*value) : "NULL";
  }

  RowText& row_;
};

RowText text_of(const TrialRow& row);
RowText text_of(const CubeRow& row);
/// @param number of the answer in the session, from 1
RowText text_of(const AnswerRow& row, int number);
RowText text_of(const ReversalRow& row);
RowText text_of(const EstimateRow& row);
RowText text_of(const ParticipantParameterRow& row);
/// @param from_event the session's event that told it, from 1; 0: none
RowText text_of(const Setup& setup, int number, int from_event);

}  // namespace heft
