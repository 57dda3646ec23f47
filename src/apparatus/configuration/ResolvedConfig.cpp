#include "apparatus/configuration/ResolvedConfig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "apparatus/sources/PictureSource.h"
#include "base/Error.h"
#include "base/Random.h"
#include "base/SimulationChoices.h"
#include "experiment/Rows.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"
#include "protocol/readers/Files.h"
#include "responders/ResponderParameters.h"
#include "view/ArView.h"

namespace heft {

namespace fs = std::filesystem;

namespace {
// A column's value in a message.
std::string shown(const std::string& text) {
  return text;
}
template <typename Value>
std::string shown(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(name_of(value));
  else
    return fmt::format("{}", value);
}
template <typename Value>
std::string shown(const std::optional<Value>& value) {
  return value ? shown(*value) : "";
}

std::map<std::string, std::string> shown_columns(const SessionConfig& config) {
  std::map<std::string, std::string> values;
  visit_cells(config, [&](const CellColumn& column, const auto& value) {
    values[column.full_name()] = shown(value);
  });
  return values;
}

}  // namespace

ResolvedConfig::ResolvedConfig(Parts parts) : parts_(std::move(parts)) {}

ResolvedConfig ResolvedConfig::with_seed(std::uint64_t seed) const {
  ResolvedConfig other = *this;
  other.parts_.seed = seed;
  other.parts_.config.participant_parameters =
      has_person(parts_.config) ? std::map<std::string, double>{} : parts_.model.drawn(seed);
  return other;
}

ResolvedConfig ResolvedConfig::of_simulation(int participants) const {
  ResolvedConfig other = *this;
  other.parts_.config.simulation_seed = parts_.seed;
  other.parts_.config.simulation_participants = participants;
  return other;
}

SessionConfig with_devices(SessionConfig config, const DeviceFacts& devices) {
  constexpr double same_rate = 0.01;  // 29.97 equals 30
  config.source_rate_hz = devices.source_rate_hz;
  if (config.source_rate_hz && config.display_rate_hz &&
      std::abs(*config.source_rate_hz / *config.display_rate_hz - 1) < same_rate)
    config.source_rate_hz.reset();
  if (!devices.display) return config;
  const auto& [number, name, w_px, h_px, refresh_hz, scale] = *devices.display;
  if (config.display_w_mm && (config.display_w_px != w_px || config.display_h_px != h_px))
    throw Error(fmt::format("{} describes a display of {} x {} pixels, but this one has {} x {}: "
                            "measure it (heft calibrate display), or name its file with "
                            "--display-file",
                            config.display_file, config.display_w_px.value_or(0),
                            config.display_h_px.value_or(0), w_px, h_px),
                ExitCode::invalid_file);
  config.display = {number, name};
  config.display_w_px = w_px;
  config.display_h_px = h_px;
  config.refresh_hz = refresh_hz;
  config.display_scale = scale;
  if (!config.window) config.window = WindowState::full_screen;
  return config;
}

ResolvedModel logged_model(Plug logged) {
  const ResponderEntry& entry = responder_named(logged.name);
  ResolvedModel model{std::move(logged), &entry, {}};
  if (entry.file == ResponderFile::folder) model.options.folder = model.named.what;
  if (entry.file == ResponderFile::parameters && !model.named.text.empty())
    model.options.parameters = parse_parameters(model.named.text, model.named.what);
  return model;
}

namespace {
// A separate seed, from which the session's trials cannot be derived.
ResponderOptions seeded(ResponderOptions options, std::uint64_t session_seed) {
  options.seed = RandomStream(session_seed, "responder").bits();
  return options;
}
}  // namespace

std::unique_ptr<Responder> ResolvedModel::responder(std::uint64_t session_seed) const {
  return entry->make(seeded(options, session_seed));
}

std::map<std::string, double> ResolvedModel::drawn(std::uint64_t session_seed) const {
  return drawn_values(seeded(options, session_seed), entry->parts);
}

bool runs_on_wall_clock(bool person, const TrackerEntry& tracker, const ViewEntry& view) {
  return person || tracker.is_live || view.has_screen;
}

SimulatorPick resolve_auto(const Protocol& protocol) {
  std::vector<std::string> techniques{spring_technique};
  for (const Technique& declared : protocol.techniques) techniques.push_back(declared.name);
  std::vector<SimulatorPick> picks;
  for (const std::string& technique : techniques)
    picks.push_back(resolve_auto(scene_of(protocol, technique, {}), protocol.display_rate_hz));
  return *std::ranges::max_element(picks, {}, &SimulatorPick::rate_hz);
}

SimulatorPick simulator_for(const std::string& name, const Protocol& protocol) {
  if (name == automatic) return resolve_auto(protocol);
  return {std::string(simulator_named(name).name), protocol.simulator.rate_hz, ""};
}

std::shared_ptr<const Protocol> protocol_for(Protocol protocol, const SessionConfig& config) {
  if (!config.simulator.empty()) protocol.simulator.name = config.simulator;
  if (config.rate_hz) protocol.simulator.rate_hz = *config.rate_hz;
  if (config.input) protocol.simulator.input.mode = *config.input;
  if (config.predict_s) protocol.simulator.input.predict_s = *config.predict_s;
  take_questions(protocol, config.texts.text, config.texts.path);
  return std::make_shared<const Protocol>(std::move(protocol));
}

std::vector<ConfigChange> changes_between(const SessionConfig& from, const SessionConfig& to) {
  std::vector<ConfigChange> changes;
  const auto before = shown_columns(from), after = shown_columns(to);
  for (const auto& [column, value] : after)
    if (before.at(column) != value) changes.push_back({column, before.at(column), value});
  return changes;
}

std::string next_part(const std::string& path) {
  const fs::path whole(path);
  std::string candidate = path;
  for (int part = 2; fs::exists(candidate); ++part)
    candidate = (whole.parent_path() /
                 fmt::format("{}-{}{}", whole.stem().string(), part, whole.extension().string()))
                    .string();
  return candidate;
}

}  // namespace heft
