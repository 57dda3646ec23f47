#include "replay/RowText.h"

#include <fmt/format.h>

#include <type_traits>
#include <utility>

#include "experiment/EachCell.h"

namespace heft {

namespace {
std::string text(const std::string& value) {
  return '"' + value + '"';
}
std::string text(bool value) {
  return value ? "1" : "0";
}
std::string text(int value) {
  return fmt::format("{}", value);
}
// Adding 0 turns -0, which the log does not keep, into 0.
std::string text(double value) {
  return fmt::format("{}", value + 0.0);
}
template <typename Enum>
requires std::is_enum_v<Enum> std::string text(Enum value) {
  return std::string(name_of(value));
}
template <typename Value>
std::string text(const std::optional<Value>& value) {
  return value ? text(*value) : "NULL";
}

template <typename Row>
RowText texts(std::string table, std::string key, int attempt_index, double t_s, const Row& row) {
  RowText made{std::move(table), std::move(key), attempt_index, t_s, {}};
  visit_cells(row, [&](const CellColumn& column, const auto& value) {
    made.columns.push_back({column.full_name(), text(value), column.since});
  });
  return made;
}

void add(RowText& text, std::string column, int value) {
  text.columns.push_back({std::move(column), fmt::format("{}", value)});
}

constexpr double at_its_end = -1;
}  // namespace

RowText text_of(const TrialRow& row) {
  RowText text =
      texts("trial", fmt::format("trial {} attempt {}", row.plan.trial_number, row.plan.attempt),
            row.attempt_index, at_its_end, row);
  add(text, "setup", row.setup_index);
  return text;
}

RowText text_of(const CubeRow& row) {
  return texts("cube", fmt::format("cube {} of attempt {}", row.slot, row.attempt_index),
               row.attempt_index, at_its_end, row);
}

RowText text_of(const AnswerRow& row, int number) {
  RowText text = texts("answer", fmt::format("answer {}", number), row.attempt_index, row.t_s, row);
  add(text, "attempt", row.attempt_index);
  return text;
}

RowText text_of(const ReversalRow& row) {
  RowText text =
      texts("reversal", fmt::format("reversal {} of staircase \"{}\"", row.number, row.staircase),
            row.attempt_index, at_its_end, row);
  add(text, "attempt", row.attempt_index);
  return text;
}

RowText text_of(const EstimateRow& row) {
  return texts("estimate",
               fmt::format("estimate \"{}\" of staircase \"{}\"", row.method, row.staircase), 0,
               at_its_end, row);
}

RowText text_of(const ParticipantParameterRow& row) {
  return texts("participant_parameter",
               fmt::format("parameter {} of setup {}", row.name, row.setup_index), 0, at_its_end,
               row);
}

RowText text_of(const Setup& setup, int number, int from_event) {
  RowText text = texts("setup", fmt::format("setup {}", number), 0, at_its_end, setup);
  add(text, "from_event", from_event);
  return text;
}

}  // namespace heft
