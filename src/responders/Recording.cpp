#include "responders/Recording.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/TextFile.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

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
        "can't read the recording {}: {}; expected a folder with actions.csv and trial_1.csv, ...",
        folder, error.message()));
  return files;
}

// Runs a reader and keeps its mistakes beside those of the other files.
template <typename Read>
void collect(std::vector<Mistake>& mistakes, Read read) {
  try {
    read();
  } catch (const InvalidFile& invalid) {
    mistakes.insert(mistakes.end(), invalid.mistakes().begin(), invalid.mistakes().end());
  }
}
}  // namespace

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
