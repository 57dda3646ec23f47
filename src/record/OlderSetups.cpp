#include "record/OlderSetups.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/Error.h"
#include "base/Names.h"
#include "base/Sha256.h"
#include "base/TextFile.h"

namespace heft {

namespace {

struct TextOption {
  const char* name;
  std::string SessionConfig::*value;
};
constexpr std::array text_options{TextOption{"responder", &SessionConfig::responder},
                                  TextOption{"responder_text", &SessionConfig::responder_text},
                                  TextOption{"tracker", &SessionConfig::tracker},
                                  TextOption{"tracker_text", &SessionConfig::tracker_text},
                                  TextOption{"view", &SessionConfig::view},
                                  TextOption{"simulator", &SessionConfig::simulator},
                                  TextOption{"auto_simulator", &SessionConfig::simulator},
                                  TextOption{"auto_why", &SessionConfig::simulator_why},
                                  TextOption{"camera_file", &SessionConfig::camera_file},
                                  TextOption{"camera_text", &SessionConfig::camera_text},
                                  TextOption{"board_file", &SessionConfig::board_file},
                                  TextOption{"board_text", &SessionConfig::board_text},
                                  TextOption{"effector_file", &SessionConfig::effector_file},
                                  TextOption{"effector_text", &SessionConfig::effector_text},
                                  TextOption{"texts_file", &SessionConfig::texts_file},
                                  TextOption{"texts_text", &SessionConfig::texts_text},
                                  TextOption{"handed", &SessionConfig::handed},
                                  TextOption{"record_camera", &SessionConfig::record_camera}};

void take(SessionConfig& setup, std::string_view option, const std::string& value) {
  if (option == "auto_rate_hz") setup.rate_hz = number_in(value);
  for (const TextOption& text : text_options)
    // What `auto` was comes after `simulator`, which then says "auto"; elsewhere it is empty.
    if (option == text.name && (option != "auto_simulator" || !value.empty()))
      setup.*text.value = value;
}

std::string hash_of(const std::string& text) {
  return text.empty() ? "" : sha256(text);
}

SessionConfig hashed(SessionConfig setup) {
  setup.camera_sha256 = hash_of(setup.camera_text);
  setup.board_sha256 = hash_of(setup.board_text);
  setup.effector_sha256 = hash_of(setup.effector_text);
  setup.texts_sha256 = hash_of(setup.texts_text);
  return setup;
}

SessionConfig setup_in(const SessionHeader& header) try {
  SessionConfig setup;
  setup.simulator_edition = 1;
  setup.heft_version = header.heft_version;
  setup.build = header.build;
  const auto json = nlohmann::json::parse(header.run_options);
  for (const TextOption& text : text_options)
    if (json.contains(text.name)) take(setup, text.name, json.at(text.name));
  if (json.contains("auto_rate_hz")) take(setup, "auto_rate_hz", json.at("auto_rate_hz"));
  return hashed(setup);
} catch (const nlohmann::json::exception& error) {
  throw Error(fmt::format("session.run_options is not what heft wrote: {}", error.what()),
              ExitCode::diverged);
}

// The setup after a deviation of that kind; none for any other deviation.
std::optional<SessionConfig> after(const Deviation& deviation, SessionConfig setup) {
  const auto json = nlohmann::json::parse(deviation.text, nullptr, false);
  if (!json.is_object() || !json.contains("option") || !json.contains("to")) return std::nullopt;
  if (!json["option"].is_string() || !json["to"].is_string()) return std::nullopt;
  take(setup, json["option"].get<std::string>(), json["to"]);
  return hashed(std::move(setup));
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
