#include "experiment/SessionConfig.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace heft {

namespace {
constexpr std::string_view person = "human";

// The parts before and after the first `at`; none if there is none.
std::optional<std::pair<std::string, std::string>> parted(std::string_view text, char at) {
  const auto place = text.find(at);
  if (place == std::string_view::npos) return std::nullopt;
  return std::pair{std::string(text.substr(0, place)), std::string(text.substr(place + 1))};
}
}  // namespace

std::string to_text(const Plug& plug) {
  return plug.what.empty() ? plug.name : plug.name + ":" + plug.what;
}

std::string to_text(const ResponderChoice& responder) {
  const auto* model = std::get_if<Plug>(&responder);
  return model ? to_text(*model) : std::string(person);
}

std::string to_text(const ProtocolSetting& setting) {
  return setting.key + "=" + setting.value;
}

std::string to_text(const std::vector<ProtocolSetting>& settings) {
  std::string text;
  for (const ProtocolSetting& setting : settings) {
    if (!text.empty()) text += '\n';
    text += to_text(setting);
  }
  return text;
}

std::string to_text(const NamedDisplay& display) {
  return fmt::format("{}{}{}", display.number, display.name.empty() ? "" : " ", display.name);
}

bool from_text(std::string_view text, Plug& plug) {
  const auto two = parted(text, ':');
  plug.name = two ? two->first : text;
  plug.what = two ? two->second : "";
  return true;
}

bool from_text(std::string_view text, ResponderChoice& responder) {
  if (text == person) {
    responder = Person{};
    return true;
  }
  if (std::holds_alternative<Person>(responder)) responder = Plug{};
  return from_text(text, std::get<Plug>(responder));
}

bool from_text(std::string_view text, ProtocolSetting& setting) {
  const auto two = parted(text, '=');
  if (two) setting = {two->first, two->second};
  return two.has_value();
}

bool from_text(std::string_view text, std::vector<ProtocolSetting>& settings) {
  std::vector<ProtocolSetting> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    if (!from_text(text.substr(0, end), lines.emplace_back())) return false;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  settings = std::move(lines);
  return true;
}

bool from_text(std::string_view text, NamedDisplay& display) {
  constexpr std::size_t most_digits = 2;
  const std::string_view number = text.substr(0, text.find(' '));
  display.name = text.substr(std::min(text.size(), number.size() + 1));
  const auto [end, error] = std::from_chars(number.begin(), number.end(), display.number);
  return error == std::errc{} && end == number.end() && number.size() <= most_digits &&
         display.number >= 0;
}

}  // namespace heft
