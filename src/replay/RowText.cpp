#include "replay/RowText.h"

namespace heft {

namespace {
template <typename Row>
RowText texts(std::string table, std::string key, int attempt_index, double t_s, const Row& row) {
  RowText text{std::move(table), std::move(key), attempt_index, t_s, {}};
  visit_columns(row, TextColumns(text));
  return text;
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
