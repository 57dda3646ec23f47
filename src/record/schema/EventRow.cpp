#include "record/schema/EventRow.h"

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/Error.h"
#include "base/files/Printable.h"
#include "record/schema/RowSql.h"

namespace heft {

namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
constexpr bool is_optional = false;
template <typename Value>
constexpr bool is_optional<std::optional<Value>> = true;

[[noreturn]] void refuse(const EventRow& row, std::string_view expected) {
  throw Error(fmt::format("event \"{}\" at {} s: expected {}, found \"{}\"", name_of(row.kind),
                          row.t_s, expected, row.detail));
}

// Writes a payload's columns into a row.
class ToRow {
 public:
  explicit ToRow(EventRow& row) : row_(row) {}

  template <typename Value>
  ToRow& detail(const Value& value) {
    if constexpr (std::is_enum_v<Value>)
      row_.detail = name_of(value);
    else if constexpr (std::same_as<Value, SessionConfig>)
      row_.detail = to_json(value);
    else
      row_.detail = value;
    return *this;
  }
  void detail_is(std::string_view text, std::string_view) { row_.detail = text; }
  ToRow& slot(std::optional<int> slot) { return set(row_.slot, slot); }
  ToRow& label(const std::optional<Label>& label) { return set(row_.label, label); }
  ToRow& number(std::optional<double> number) { return set(row_.value, number); }
  ToRow& push(const CubeTouch& touch) {
    row_.max_push_displacement_m = touch.max_push_displacement_m;
    row_.peak_lag_m = touch.peak_lag_m;
    return *this;
  }
  ToRow& duration(std::optional<double> duration_s, std::optional<double> = {}) {
    return set(row_.value, duration_s);
  }
  // Missing where there is no value, as in events of older programs.
  template <typename Value>
  ToRow& json(const char* key, const std::optional<Value>& value) {
    return value ? json(key, *value) : *this;
  }
  template <typename Value>
  ToRow& json(const char* key, const Value& value) {
    if constexpr (std::is_enum_v<Value>)
      json_[key] = name_of(value);
    else
      json_[key] = value;
    return *this;
  }
  // Invalid UTF-8 must not prevent an event from being saved.
  void finish() {
    if (!json_.empty()) row_.detail = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

 private:
  template <typename Value>
  ToRow& set(std::optional<Value>& column, std::optional<Value> value) {
    column = value;
    return *this;
  }

  EventRow& row_;
  Json json_;
};

// Reads a payload's columns from a row.
class FromRow {
 public:
  explicit FromRow(const EventRow& row) : row_(row) {}

  template <typename Value>
  FromRow& detail(Value& value) {
    if constexpr (is_listed<Value>)
      value = named_in<Value>(row_.detail);
    else if constexpr (std::same_as<Value, SessionConfig>)
      value = setup_from_json(row_.detail);
    else
      value = row_.detail;
    return *this;
  }
  void detail_is(std::string_view text, std::string_view expected) {
    if (row_.detail != text) refuse(row_, expected);
  }
  FromRow& slot(auto& slot) { return take(slot, row_.slot, "a cube's slot"); }
  FromRow& label(std::optional<Label>& label) { return take(label, row_.label, "a label"); }
  FromRow& number(std::optional<double>& number) { return take(number, row_.value, "a number"); }
  FromRow& push(CubeTouch& touch) {
    touch.max_push_displacement_m = row_.max_push_displacement_m;
    touch.peak_lag_m = row_.peak_lag_m;
    return *this;
  }
  FromRow& duration(auto& duration_s, std::optional<double> if_none = {}) {
    const auto value = row_.value ? row_.value : if_none;
    if (value && !(*value >= 0)) refuse(row_, "a duration");
    return take(duration_s, value, "a duration");
  }
  template <typename Value>
  FromRow& json(const char* key, Value& value) try {
    if (json_.is_null()) json_ = Json::parse(row_.detail, nullptr, /*allow_exceptions=*/false);
    if (!json_.is_object()) refuse(row_, "a JSON object");
    if constexpr (is_optional<Value>)
      value = json_.contains(key) ? Value(json_.at(key).template get<typename Value::value_type>())
                                  : std::nullopt;
    else if constexpr (is_listed<Value>)
      value = named_in<Value>(json_.at(key).template get<std::string>());
    else
      value = json_.at(key).template get<Value>();
    return *this;
  } catch (const nlohmann::json::exception&) {
    refuse(row_, fmt::format("JSON with \"{}\"", key));
  }

 private:
  template <typename To, typename Value>
  FromRow& take(To& to, const std::optional<Value>& value, std::string_view expected) {
    if constexpr (std::same_as<To, Value>) {
      if (!value) refuse(row_, expected);
      to = *value;
    } else {
      to = value;
    }
    return *this;
  }
  template <typename Listed>
  Listed named_in(const std::string& text) {
    const auto names = listed_names<Listed>();
    const auto found = std::ranges::find(names, text);
    if (found == names.end()) refuse(row_, quoted_list(names));
    if constexpr (is_word<Listed>)
      return Listed(*found);
    else
      return static_cast<Listed>(found - names.begin());
  }

  const EventRow& row_;
  Json json_;
};

// Writes or reads. A payload with fields but without event_columns does not compile.
void convert(auto& payload, auto& row) {
  using Payload = std::remove_const_t<std::remove_reference_t<decltype(payload)>>;
  if constexpr (!std::is_empty_v<Payload>) Payload::event_columns(payload, row);
}

template <std::size_t... Kinds>
EventPayload empty_of(EventKind kind, std::index_sequence<Kinds...>) {
  EventPayload what;
  ((static_cast<std::size_t>(kind) == Kinds ? void(what.emplace<Kinds>()) : void()), ...);
  return what;
}

// Truncates to at most `most` bytes, between characters.
std::string truncated(const std::string& text, std::size_t most) {
  std::string kept;
  for (const std::string_view letter : letters_of(text)) {
    if (kept.size() + letter.size() > most) break;
    kept += letter;
  }
  return kept;
}

}  // namespace

EventRow row_of(const Event& event) {
  EventRow row;
  row.t_s = event.t_s;
  row.kind = event.kind();
  ToRow to(row);
  std::visit([&](const auto& payload) { convert(payload, to); }, event.what);
  to.finish();
  return row;
}

Event event_of(const EventRow& row) {
  EventPayload what =
      empty_of(row.kind, std::make_index_sequence<std::variant_size_v<EventPayload>>());
  FromRow from(row);
  std::visit([&](auto& payload) { convert(payload, from); }, what);
  return {row.t_s, std::move(what)};
}

namespace {
// " cube 2 heaviest"
std::string cube_text(const std::optional<int>& slot, const std::optional<Label>& label) {
  return (slot ? fmt::format(" cube {}", *slot) : "") +
         (label ? fmt::format(" {}", name_of(*label)) : "");
}
}  // namespace

std::string text_of(const Event& event) {
  const EventRow row = row_of(event);
  std::string text = fmt::format("{} \"{}\"{} at {} s", name_of(row.kind), row.detail,
                                 cube_text(row.slot, row.label), row.t_s);
  const bool is_number = event.is<Action, ActionRefused>();
  if (row.value) text += fmt::format(", {}{}", *row.value, is_number ? "" : " s");
  if (row.max_push_displacement_m && row.peak_lag_m)
    text +=
        fmt::format(", displacement {} m, lag {} m", *row.max_push_displacement_m, *row.peak_lag_m);
  return text;
}

std::string description(const Event& event, std::optional<int> trial_number) {
  const auto* action = event.as<Action>();
  const std::string text = action ? fmt::format("the answer \"{}{}\"", name_of(action->kind),
                                                cube_text(action->slot, action->label))
                                  : fmt::format("the event \"{}\"", name_of(event.kind()));
  return trial_number ? fmt::format("{} of trial {}", text, *trial_number) : text;
}

namespace {
Json line_about(const AnnouncedEvent& about, double t_s, std::string_view kind) {
  constexpr std::size_t longest_name = 60;  // bytes; escaped at most sixfold
  Json line;
  line["t_s"] = t_s;
  line["utc"] = about.utc;
  line["session"] = about.session_id;
  line["participant"] = truncated(about.participant, longest_name);
  line["kind"] = kind;
  return line;
}
}  // namespace

std::string sealed_line(const AnnouncedEvent& about, double t_s, const std::string& head) {
  Json line = line_about(about, t_s, "sealed");
  line["head"] = head;
  return line.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string event_line(const Event& event, const AnnouncedEvent& about) {
  constexpr std::size_t longest_detail = 240;
  const EventRow row = row_of(event);
  Json line = line_about(about, event.t_s, name_of(row.kind));
  if (about.plan) {
    line["trial"] = about.plan->trial_number;
    line["attempt"] = about.plan->attempt;
  }
  if (row.slot) line["slot"] = *row.slot;
  if (row.label) line["label"] = name_of(*row.label);
  if (!row.detail.empty() && row.kind != event_kind<SessionConfig>)
    line["detail"] = truncated(row.detail, longest_detail);
  if (about.logged) line["logged"] = *about.logged;
  return line.dump(-1, ' ', true, Json::error_handler_t::replace);
}

namespace {

// Columns of `setup` that had other names before version 7.
constexpr std::array renamed_columns{std::pair{"simulator_why", "simulator_reason"},
                                     std::pair{"handed", "controls"}};

// Writes columns and contents by name, without empty values.
struct Write {
  Json& json;

  template <typename Value>
  void operator()(const LogColumn& column, const Value& value) const {
    (*this)(column.name, value);
  }
  template <typename Value>
  void operator()(const LogColumn& column, const NullIfEmpty<const Value>& field) const {
    (*this)(column.name, to_text(field.value));
  }
  template <typename Value>
  void operator()(const LogColumn& column, const AsText<const Value>& field) const {
    (*this)(column.name, to_text(field.value));
  }
  void operator()(std::string_view name, const std::string& text) const {
    if (!text.empty()) json[std::string(name)] = text;
  }
  template <typename Value>
  void operator()(std::string_view name, const std::optional<Value>& value) const {
    if (value) json[std::string(name)] = *value;
  }
  void operator()(std::string_view name, const std::map<std::string, double>& values) const {
    if (!values.empty()) json[std::string(name)] = values;
  }
};

struct Read {
  const Json& json;

  template <typename Value>
  void operator()(const LogColumn& column, Value& value) const {
    (*this)(column.name, value);
  }
  template <typename Value>
  void operator()(const LogColumn& column, const NullIfEmpty<Value>& field) const {
    (*this)(column, AsText{field.value});
  }
  template <typename Value>
  void operator()(const LogColumn& column, const AsText<Value>& field) const {
    std::string text = to_text(field.value);
    (*this)(column.name, text);
    if (!from_text(text, field.value))
      throw Error(fmt::format("invalid setup: its {} is \"{}\"", column.name, text));
  }
  template <typename Value>
  void operator()(std::string_view name, Value& value) const {
    const auto found = json.find(std::string(name));
    if (found == json.end()) return;
    if constexpr (requires { value.has_value(); })
      value = found->template get<typename Value::value_type>();
    else
      value = found->template get<Value>();
  }
};

}  // namespace

std::string to_json(const SessionConfig& setup) {
  Json json = Json::object();
  visit_columns(setup, Write{json});
  visit_contents(setup, Write{json});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SessionConfig setup_from_json(const std::string& text) try {
  Json json = Json::parse(text);
  if (!json.is_object()) throw Error("invalid setup: expected a JSON object");
  for (const auto& [older, name] : renamed_columns)
    if (const auto found = json.find(older); found != json.end()) json[name] = *found;
  SessionConfig setup;
  visit_columns(setup, Read{json});
  visit_contents(setup, Read{json});
  return setup;
} catch (const nlohmann::json::exception& error) {
  throw Error(fmt::format("invalid setup: {}", error.what()));
}

}  // namespace heft
