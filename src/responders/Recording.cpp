#include "responders/Recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>

#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "tasks/Task.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> columns{"trial_number", "t_s",   "action",
                                                  "slot",         "label", "value"};
enum Column : std::size_t { trial_number, time, action, slot, label, number };

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  void header(std::string_view line) {
    const auto cells = cells_of(line);
    if (std::ranges::equal(cells, columns)) return;
    n_columns_ = columns.size() - 1;  // recordings made before the column value was added
    if (!std::ranges::equal(cells, std::span(columns).first(n_columns_)))
      mistake(1, 1, fmt::format("expected the header {}", fmt::join(columns, ",")));
  }

  void row(int number, std::string_view line) {
    line_ = line;
    number_ = number;
    cells_ = cells_of(line);
    if (cells_.size() == n_columns_) return cells();
    mistake(number, 1,
            fmt::format("{} cells, expected {} ({})", cells_.size(), n_columns_,
                        fmt::join(std::span(columns).first(n_columns_), ",")));
  }

  RecordedActions actions;
  std::vector<Mistake> mistakes;

 private:
  void cells() {
    const std::size_t before = mistakes.size();
    const int trial = whole_number(trial_number);
    TimedAction read;
    read.t_s = seconds();
    const ActionSpec* spec = action_named(cells_[action]);
    if (!spec) return mistake(action, expected_name(cells_[action], words_of<ActionKind>()));
    read.kind = ActionKind(spec->kind);
    read.slot = slot_of(*spec);
    read.label = label_of(*spec);
    read.value = value_of(*spec);
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

  std::optional<int> slot_of(const ActionSpec& spec) {
    if (spec.slot) return whole_number(slot);
    return nothing(slot, spec);
  }

  std::optional<Label> label_of(const ActionSpec& spec) {
    if (!spec.label) return nothing(label, spec);
    const auto words = words_of<Label>();
    if (std::ranges::find(words, cells_[label]) != words.end()) return Label(cells_[label]);
    mistake(label, expected_name(cells_[label], words));
    return std::nullopt;
  }

  std::optional<double> value_of(const ActionSpec& spec) {
    if (n_columns_ <= number) {
      if (spec.value) mistake(action, "expected the column value, which it needs");
      return std::nullopt;
    }
    if (!spec.value) return nothing(number, spec);
    const auto value = number_in(cells_[number]);
    if (!value) mistake(number, "expected a number");
    return value;
  }

  std::nullopt_t nothing(Column column, const ActionSpec& spec) {
    if (!cells_[column].empty())
      mistake(column, fmt::format("{} takes no {}", spec.kind, columns[column]));
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
            fmt::format("{} is \"{}\": {}", columns[column], printable(std::string(cells_[column])),
                        wrong));
  }

  void mistake(int line, int column, std::string message) {
    mistakes.push_back({{file_, line, column}, std::move(message)});
  }

  std::string file_;
  std::string_view line_;
  int number_ = 0;
  std::size_t n_columns_ = columns.size();
  std::vector<std::string_view> cells_;
};

constexpr std::string_view prefix = "trial_", suffix = ".csv";

// The N of trial_N.csv, written without leading zeros.
std::optional<int> trial_number_of(const std::string& file_name) {
  if (!file_name.starts_with(prefix) || !file_name.ends_with(suffix)) return std::nullopt;
  const char* first = file_name.data() + prefix.size();
  const char* last = file_name.data() + file_name.size() - suffix.size();
  int number = 0;
  const auto [end, error] = std::from_chars(first, last, number);
  const bool usable = error == std::errc() && end == last && number >= 1 && *first != '0';
  return usable ? std::optional(number) : std::nullopt;
}

std::map<int, fs::path> trial_files(const std::string& folder) {
  std::error_code error;
  std::map<int, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (const auto number = trial_number_of(entry.path().filename().string()))
      files[*number] = entry.path();
  if (error)
    throw Error(fmt::format(
        "cannot read the recording {}: {}; expected a folder with actions.csv and trial_1.csv, ...",
        folder, error.message()));
  return files;
}

// Runs a reader and adds its mistakes to those of the other files.
template <typename Read>
void collect(std::vector<Mistake>& mistakes, Read read) {
  try {
    read();
  } catch (const InvalidFile& invalid) {
    mistakes.insert(mistakes.end(), invalid.mistakes().begin(), invalid.mistakes().end());
  }
}
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

Recording load_recording(const std::string& folder) {
  const auto files = trial_files(folder);
  const std::string actions_file = (fs::path(folder) / "actions.csv").string();
  Recording recording{folder, {}, {}};
  std::vector<Mistake> mistakes;
  collect(mistakes,
          [&] { recording.actions = parse_actions(read_text_file(actions_file), actions_file); });
  for (const auto& [number, path] : files)
    collect(mistakes, [&, n = number, file = path.string()] {
      recording.trajectories.emplace(n, load_trajectory(file));
    });
  for (const auto& [number, actions] : recording.actions)
    if (!files.contains(number))
      mistakes.push_back({actions.front().place,
                          fmt::format("trial {} has actions, but there is no trial_{}.csv in {}",
                                      number, number, folder)});
  if (!mistakes.empty()) throw InvalidFile(std::move(mistakes));
  return recording;
}

}  // namespace heft
