#include "cli/SessionOptions.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "base/PlugTable.h"
#include "cli/Installation.h"
#include "cli/Talk.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"

namespace heft::cli {

void add_apparatus_options(CLI::App* command, GivenOptions& given) {
  command->add_option("--camera-file", given.camera_file,
                      "the camera's calibration, from heft calibrate camera");
  command->add_option("--board", given.board_file,
                      "the printed board; default: protocols/apparatus/board.toml");
  command->add_option("--effector", given.effector_file,
                      "the effector's tags; default: protocols/apparatus/effector.toml");
}

void add_session_options(CLI::App* command, GivenOptions& given) {
  command->add_option("--responder", given.responder,
                      "human (default), or a model: NAME or NAME:FILE (heft doctor lists them)");
  command->add_option("--tracker", given.tracker,
                      "where effector poses come from: camera:N, video:FILE, frames:FOLDER, "
                      "synthetic (a rendered camera films a model's hand), hand (that hand as it "
                      "is); default: camera:0 for a person, hand for a model");
  command->add_option("--view", given.view,
                      "what shows the session: window, headless, video:FILE; default: window for a "
                      "person, headless for a model");
  add_apparatus_options(command, given);
}

RunOptions with_defaults(const GivenOptions& given) {
  RunOptions options;
  options.responder = given.responder.value_or("human");
  const bool person = has_person(options);
  options.tracker = given.tracker.value_or(person ? "camera:0" : "hand");
  options.view = given.view.value_or(person ? "window" : "headless");
  options.simulator = given.simulator.value_or("");
  const bool synthetic = options.tracker == "synthetic";
  options.camera_file = given.camera_file.value_or(
      synthetic ? installed_file("protocols/apparatus/synthetic_camera.yaml") : "");
  options.board_file = given.board_file.value_or(installed_file("protocols/apparatus/board.toml"));
  options.effector_file =
      given.effector_file.value_or(installed_file("protocols/apparatus/effector.toml"));
  return options;
}

void warn_of_simulator(const std::string& name) {
  const SimulatorEntry& entry = simulator_named(name);
  if (!entry.warning.empty()) say("heft: {} {}\n", entry.name, entry.warning);
}

void tell_simulator(const Protocol& protocol, const RunOptions& options) {
  const SimulatorChoice simulator = protocol_for(protocol, options)->simulator;
  if (!options.auto_simulator.empty())
    say("heft: {}\n", described({simulator.name, simulator.rate_hz, options.auto_why}));
  warn_of_simulator(simulator.name);
}

std::string texts_file(const std::string& language) {
  if (language.ends_with(".toml")) return language;
  const std::filesystem::path folder =
      std::filesystem::path(installed_file("protocols/texts/en.toml")).parent_path();
  std::vector<std::string> shipped;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") shipped.push_back(entry.path().stem().string());
  std::ranges::sort(shipped);
  if (std::ranges::find(shipped, language) == shipped.end())
    throw unknown_name("language", language,
                       std::vector<std::string_view>(shipped.begin(), shipped.end()));
  return (folder / (language + ".toml")).string();
}

}  // namespace heft::cli
