#include "session/RunOptions.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

void check_tracker(const std::string& tracker) {
  constexpr std::array<std::string_view, 1> known{"hand"};
  if (tracker == known[0]) return;
  throw Error(fmt::format("there is no tracker \"{}\" in this version; expected {}", tracker,
                          quoted_list(known)),
              ExitCode::usage);
}

}  // namespace

std::string to_json(const RunOptions& options) {
  return nlohmann::ordered_json{{"responder", options.responder},
                                {"responder_text", options.responder_text},
                                {"tracker", options.tracker},
                                {"view", options.view},
                                {"simulator", options.simulator}}
      .dump();
}

RunOptions run_options_from_json(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    return {json.at("responder"), json.at("responder_text"), json.at("tracker"), json.at("view"),
            json.at("simulator")};
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("session.run_options can't be read: {}", error.what()));
  }
}

void complete(RunOptions& options) {
  const auto [name, file] = split(options.responder);
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
  if (entry.file == ResponderFile::parameters && !file.empty())
    options.responder_text = read_text_file(file);
  check_tracker(options.tracker);
  make_view(options.view);
  if (!options.simulator.empty()) make_simulator(options.simulator);
  make_responder(options, 0);  // says what is wrong with its parameters before anything is logged
}

std::unique_ptr<Responder> make_responder(const RunOptions& options, std::uint64_t seed) {
  const auto [name, file] = split(options.responder);
  const ResponderEntry& entry = responder_named(name);
  ResponderOptions made_with;
  made_with.seed = seed;
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
