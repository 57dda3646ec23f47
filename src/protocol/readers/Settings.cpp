#include <fmt/format.h>

#include <algorithm>

#include "protocol/readers/ProtocolTables.h"

namespace heft {

namespace {

[[noreturn]] void refuse(const ProtocolSetting& setting, const std::string& why) {
  throw Error(fmt::format("--set {}: {}, expected KEY=VALUE, such as "
                          "coupling.stiffness_n_per_m=100 or block.sorting.trials=4",
                          to_text(setting), why),
              ExitCode::usage);
}

// Not of the file: a mistake in it is reported as one of --set.
TomlNode set_node(TomlNode node) {
  node.place = set_place;
  if (auto* array = std::get_if<TomlArray>(&node.value))
    for (TomlNode& element : *array) element = set_node(std::move(element));
  if (auto* table = std::get_if<TomlTable>(&node.value))
    for (TomlEntry& entry : *table) entry = {entry.key, set_place, set_node(std::move(entry.node))};
  return node;
}

TomlNode value_of(const ProtocolSetting& setting) {
  const std::string& text = setting.value;
  try {
    TomlTable table = parse_toml("value = " + text, "--set");
    if (table.size() == 1) return table.front().node;
  } catch (const InvalidFile&) {
  }
  // A word without quotes is a text: --set physics.simulator=bullet-ea
  if (text.find_first_of("\"'\\\n") != std::string::npos || text.empty())
    refuse(setting, fmt::format("\"{}\" is not a value", text));
  return {{}, text};
}

TomlEntry* entry_named(TomlTable& table, const std::string& key) {
  const auto found = std::ranges::find(table, key, &TomlEntry::key);
  return found == table.end() ? nullptr : &*found;
}

bool is_called(TomlNode& node, const std::string& name) {
  auto* table = std::get_if<TomlTable>(&node.value);
  if (!table) return false;
  for (const char* key : {"name", "kind"})
    if (const TomlEntry* entry = entry_named(*table, key))
      if (const auto* text = std::get_if<std::string>(&entry->node.value); text && *text == name)
        return true;
  return false;
}

// The table at `key` of `table`; in an array of tables the next part names the element.
TomlTable& descend(TomlTable& table, const std::string& key, std::vector<std::string>& rest,
                   const ProtocolSetting& setting) {
  TomlEntry* entry = entry_named(table, key);
  if (!entry)
    return std::get<TomlTable>(
        table.emplace_back(TomlEntry{key, {}, {{}, TomlTable{}}}).node.value);
  TomlNode* node = &entry->node;
  if (auto* array = std::get_if<TomlArray>(&node->value); array && !rest.empty()) {
    const auto element = std::ranges::find_if(
        *array, [&](TomlNode& candidate) { return is_called(candidate, rest.front()); });
    if (element == array->end())
      refuse(setting, fmt::format("there is no {} named \"{}\"", key, rest.front()));
    rest.erase(rest.begin());
    node = &*element;
  }
  if (auto* inner = std::get_if<TomlTable>(&node->value)) return *inner;
  refuse(setting, fmt::format("\"{}\" is not a table", key));
}

void apply(TomlTable& root, const ProtocolSetting& setting) {
  std::vector<std::string> path;
  for (std::size_t from = 0; from <= setting.key.size();) {
    const std::size_t dot = std::min(setting.key.find('.', from), setting.key.size());
    path.push_back(setting.key.substr(from, dot - from));
    if (path.back().empty()) refuse(setting, "a part of the key is empty");
    from = dot + 1;
  }
  const TomlNode value = set_node(value_of(setting));
  TomlTable* table = &root;
  while (path.size() > 1) {
    const std::string key = path.front();
    path.erase(path.begin());
    table = &descend(*table, key, path, setting);
    if (path.empty()) refuse(setting, "the key is a table");
  }
  if (TomlEntry* entry = entry_named(*table, path.front()))
    entry->node = value;
  else
    table->push_back({path.front(), set_place, value});
}

}  // namespace

void apply_settings(TomlTable& root, std::span<const ProtocolSetting> settings) {
  for (const ProtocolSetting& setting : settings) apply(root, setting);
}

}  // namespace heft
