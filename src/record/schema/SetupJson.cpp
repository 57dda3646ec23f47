#include "record/schema/SetupJson.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/Error.h"

namespace heft {

namespace {

using Json = nlohmann::ordered_json;

// Columns by their names, contents by theirs; what is not told is left out.
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
      throw Error(fmt::format("a setup can't be read: its {} is \"{}\"", column.name, text));
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
  const Json json = Json::parse(text);
  if (!json.is_object()) throw Error("a setup can't be read: expected a JSON object");
  SessionConfig setup;
  visit_columns(setup, Read{json});
  visit_contents(setup, Read{json});
  return setup;
} catch (const nlohmann::json::exception& error) {
  throw Error(fmt::format("a setup can't be read: {}", error.what()));
}

}  // namespace heft
