// actions.csv: every cell read, every mistake kept with its place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/TextFile.h"
#include "responders/Recording.h"

namespace heft {

namespace {
constexpr std::array<std::string_view, 5> columns{"trial_number", "t_s", "action", "slot", "label"};
enum Column : std::size_t { trial_number, time, action, slot, label };

bool needs_slot(ActionKind kind) {
  return kind == ActionKind::select || kind == ActionKind::label || kind == ActionKind::unlabel;
}

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  void header(std::string_view line) {
    if (!std::ranges::equal(cells_of(line), columns))
      mistake(1, 1, fmt::format("expected the header {}", fmt::join(columns, ",")));
  }

  void row(int number, std::string_view line) {
    line_ = line;
    number_ = number;
    cells_ = cells_of(line);
    if (cells_.size() == columns.size()) return cells();
    mistake(number, 1,
            fmt::format("{} cells, expected {} ({})", cells_.size(), columns.size(),
                        fmt::join(columns, ",")));
  }

  RecordedActions actions;
  std::vector<Mistake> mistakes;

 private:
  void cells() {
    const std::size_t before = mistakes.size();
    const int trial = whole_number(trial_number);
    TimedAction read;
    read.t_s = seconds();
    read.kind = kind();
    if (!named<ActionKind>(cells_[action])) return;
    read.slot = slot_of(read.kind);
    read.label = label_of(read.kind);
    if (mistakes.size() == before) keep(trial, read);
  }

  void keep(int trial, const TimedAction& read) {
    auto& before = actions[trial];
    if (!before.empty() && read.t_s < before.back().action.t_s)
      return mistake(time, fmt::format("comes before trial {}'s action at {} s in line {}", trial,
                                       before.back().action.t_s, before.back().place.line));
    before.push_back({read, place(action)});
  }

  int whole_number(Column column) {
    const auto value = number_in(cells_[column]);
    const bool usable = value && *value >= 1 && *value == std::floor(*value) &&
                        *value <= std::numeric_limits<int>::max();
    if (!usable) mistake(column, "expected a whole number from 1");
    return usable ? static_cast<int>(*value) : 0;
  }

  double seconds() {
    const auto value = number_in(cells_[time]);
    if (!value || *value < 0) mistake(time, "expected seconds since the trial's start");
    return value.value_or(0);
  }

  ActionKind kind() {
    const auto kind = named<ActionKind>(cells_[action]);
    if (!kind) mistake(action, expected_name(cells_[action], EnumNames<ActionKind>::names));
    return kind.value_or(ActionKind::validate);
  }

  std::optional<int> slot_of(ActionKind kind) {
    if (needs_slot(kind)) return whole_number(slot);
    if (!cells_[slot].empty()) mistake(slot, fmt::format("{} takes no slot", name_of(kind)));
    return std::nullopt;
  }

  std::optional<Label> label_of(ActionKind kind) {
    const auto read = named<Label>(cells_[label]);
    if (kind == ActionKind::label) {
      if (!read) mistake(label, expected_name(cells_[label], EnumNames<Label>::names));
      return read;
    }
    if (!cells_[label].empty()) mistake(label, fmt::format("{} takes no label", name_of(kind)));
    return std::nullopt;
  }

  static std::string expected_name(std::string_view cell, std::span<const std::string_view> names) {
    const auto nearest = nearest_name(cell, names);
    return nearest ? fmt::format("did you mean \"{}\"?", *nearest)
                   : fmt::format("expected {}", quoted_list(names));
  }

  SourcePlace place(Column column) const {
    return {file_, number_, static_cast<int>(cells_[column].data() - line_.data()) + 1};
  }

  void mistake(Column column, const std::string& wrong) {
    const SourcePlace at = place(column);
    mistake(at.line, at.column,
            fmt::format("{} is \"{}\": {}", columns[column], cells_[column], wrong));
  }

  void mistake(int line, int column, std::string message) {
    mistakes.push_back({{file_, line, column}, std::move(message)});
  }

  std::string file_;
  std::string_view line_;
  int number_ = 0;
  std::vector<std::string_view> cells_;
};
}  // namespace

RecordedActions parse_actions(const std::string& text, const std::string& file) {
  Reader reader(file);
  const auto lines = lines_of(text);
  reader.header(lines.empty() ? "" : lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (!lines[i].empty()) reader.row(static_cast<int>(i) + 1, lines[i]);
  if (!reader.mistakes.empty()) throw InvalidFile(std::move(reader.mistakes));
  return std::move(reader.actions);
}

}  // namespace heft
