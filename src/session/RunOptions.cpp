#include "session/RunOptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/PlugTable.h"
#include "base/Random.h"
#include "base/TextFile.h"
#include "physics/DecouplingSimulator.h"
#include "protocol/ParameterFile.h"
#include "view/ArView.h"

namespace heft {

namespace {

struct NameAndFile {
  std::string name, file;
};

NameAndFile split(const std::string& responder) {
  const auto colon = responder.find(':');
  if (colon == std::string::npos) return {responder, ""};
  return {responder.substr(0, colon), responder.substr(colon + 1)};
}

// Every option and where it is kept, by its name in session.run_options.
struct Field {
  const char* name;
  std::string RunOptions::*value;
};
constexpr std::array fields{
    Field{"responder", &RunOptions::responder},
    Field{"responder_text", &RunOptions::responder_text}, Field{"tracker", &RunOptions::tracker},
    Field{"view", &RunOptions::view}, Field{"simulator", &RunOptions::simulator}};

using Names = std::vector<std::string_view>;

// A device that this version has, one that is still to come, or a slip of the pen.
void check_device(const char* kind, const std::string& given, const Names& present,
                  const Names& to_come) {
  if (std::ranges::find(present, given) != present.end()) return;
  const std::string name = split(given).name;
  if (std::ranges::find(to_come, name) != to_come.end())
    throw Error(fmt::format("this version does not have the {0} \"{1}\" yet; run with --{0} {2}",
                            kind, given, present.front()),
                ExitCode::device_missing);
  Names known = present;
  known.insert(known.end(), to_come.begin(), to_come.end());
  throw unknown_name(kind, name, known);
}

void check_devices(const RunOptions& options) {
  check_device("tracker", options.tracker, {"hand"}, {"camera", "video", "frames", "synthetic"});
  check_device("view", options.view, names_in(views()), {"window", "video"});
}

// A session may be resumed from another folder than it was started in.
std::string absolute_path(const std::string& file) {
  std::error_code error;
  const auto path = std::filesystem::absolute(file, error);
  if (error) throw Error(fmt::format("can't find {}: {}", file, error.message()));
  return path.lexically_normal().string();
}

const ResponderEntry& checked_responder(const std::string& responder) {
  const auto [name, file] = split(responder);
  if (name == "human") {
    throw Error(
        "a human participant needs the window view, which this version does not have; "
        "run with --responder simulated to try the protocol",
        ExitCode::device_missing);
  }
  const ResponderEntry& entry = responder_named(name);
  if (entry.file == ResponderFile::none && !file.empty())
    throw Error(fmt::format("responder \"{}\" takes no file", name), ExitCode::usage);
  if (entry.file == ResponderFile::folder && file.empty())
    throw Error(fmt::format("responder \"{0}\" needs a folder: {0}:FOLDER", name), ExitCode::usage);
  return entry;
}

}  // namespace

std::string to_json(const RunOptions& options) {
  nlohmann::ordered_json json;
  for (const Field& field : fields) json[field.name] = options.*field.value;
  return json.dump();
}

RunOptions run_options_from_json(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    RunOptions options;
    for (const Field& field : fields) options.*field.value = json.at(field.name);
    return options;
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("session.run_options can't be read: {}", error.what()));
  }
}

void complete(RunOptions& options) {
  const ResponderEntry& entry = checked_responder(options.responder);
  options.responder_text.clear();
  if (auto [name, file] = split(options.responder); !file.empty()) {
    file = absolute_path(file);
    options.responder = name + ":" + file;
    if (entry.file == ResponderFile::parameters) options.responder_text = read_text_file(file);
  }
  check(options);
}

void check(const RunOptions& options) {
  checked_responder(options.responder);
  check_devices(options);
  if (!options.simulator.empty()) simulator_named(options.simulator);
  make_responder(options, 0);  // says what is wrong with its parameters before anything is logged
}

bool is_same_simulator(const std::string& a, const std::string& b) {
  return simulator_named(a).make == simulator_named(b).make;
}

std::string to_json(const OptionChange& change) {
  return nlohmann::ordered_json{{"option", change.option}, {"from", change.from}, {"to", change.to}}
      .dump();
}

std::vector<OptionChange> changes_between(const RunOptions& from, const RunOptions& to) {
  std::vector<OptionChange> changes;
  for (const Field& field : fields)
    if (from.*field.value != to.*field.value)
      changes.push_back({field.name, from.*field.value, to.*field.value});
  return changes;
}

void apply_deviation(RunOptions& options, const std::string& detail) {
  const auto json = nlohmann::json::parse(detail, nullptr, false);
  if (!json.is_object() || !json.contains("option") || !json.contains("to")) return;
  for (const Field& field : fields)
    if (json["option"] == field.name && json["to"].is_string()) options.*field.value = json["to"];
}

std::unique_ptr<Responder> make_responder(const RunOptions& options, std::uint64_t seed) {
  const auto [name, file] = split(options.responder);
  const ResponderEntry& entry = responder_named(name);
  ResponderOptions made_with;
  // A seed of its own: nobody could draw the session's trials from it.
  made_with.seed = RandomStream(seed, "responder").bits();
  if (entry.file == ResponderFile::folder) made_with.folder = file;
  if (entry.file == ResponderFile::parameters && !options.responder_text.empty())
    made_with.parameters = parse_parameters(options.responder_text, file);
  return entry.make(made_with);
}

std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const RunOptions& options) {
  if (!options.simulator.empty()) protocol.simulator.name = options.simulator;
  return std::make_shared<const Protocol>(std::move(protocol));
}

}  // namespace heft
