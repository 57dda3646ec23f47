#include "record/OlderSetups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/Sha256.h"
#include "base/TextFile.h"
#include "record/SetupJson.h"

namespace heft {

namespace {

using Json = nlohmann::ordered_json;

// Their options, all texts; setups have these under the same names, but for what `auto` was.
constexpr std::array options{"responder",      "responder_text", "tracker",       "tracker_text",
                             "view",           "simulator",      "camera_file",   "camera_text",
                             "board_file",     "board_text",     "effector_file", "effector_text",
                             "texts_file",     "texts_text",     "handed",        "record_camera",
                             "auto_simulator", "auto_why",       "auto_rate_hz"};

void take(Json& setup, std::string_view option, const std::string& value) {
  if (option == "auto_why")
    setup["simulator_why"] = value;
  else if (option == "auto_rate_hz") {
    if (const auto rate_hz = number_in(value)) setup["rate_hz"] = *rate_hz;
  } else if (option == "auto_simulator") {  // comes after `simulator`, which then says "auto"
    if (!value.empty()) setup["simulator"] = value;
  } else if (std::ranges::find(options, option) != options.end()) {
    setup[std::string(option)] = value;
  }
}

SessionConfig config_in(const Json& json) {
  SessionConfig config = setup_from_json(json.dump());
  for (ConfigFile* file : {&config.camera, &config.board, &config.effector, &config.texts})
    file->sha256 = file->text.empty() ? "" : sha256(file->text);
  return config;
}

SessionConfig setup_in(const SessionHeader& header) try {
  Json setup{
      {"simulator_edition", 1}, {"heft_version", header.heft_version}, {"build", header.build}};
  const auto json = Json::parse(header.run_options);
  for (const char* option : options)
    if (json.contains(option)) take(setup, option, json.at(option));
  return config_in(setup);
} catch (const nlohmann::json::exception& error) {
  throw Error(fmt::format("session.run_options is not what heft wrote: {}", error.what()),
              ExitCode::diverged);
}

// The setup after a deviation of that kind; none for any other deviation.
std::optional<SessionConfig> after(const Deviation& deviation, const SessionConfig& config) {
  const auto json = Json::parse(deviation.text, nullptr, false);
  if (!json.is_object() || !json.contains("option") || !json.contains("to")) return std::nullopt;
  if (!json["option"].is_string() || !json["to"].is_string()) return std::nullopt;
  Json setup = Json::parse(to_json(config));
  take(setup, json["option"].get<std::string>(), json["to"]);
  return config_in(setup);
}

}  // namespace

OlderSetups::OlderSetups(const SessionHeader& header) {
  constexpr int first_with_setups = 3;
  if (header.log_version < first_with_setups) first_ = now_ = setup_in(header);
}

Event OlderSetups::told(Event event) {
  if (!now_) return event;
  if (const auto* setup = event.as<SessionConfig>()) now_ = *setup;
  const auto* deviation = event.as<Deviation>();
  if (const auto changed = deviation ? after(*deviation, *now_) : std::nullopt)
    event.what = *(now_ = changed);
  return event;
}

}  // namespace heft
