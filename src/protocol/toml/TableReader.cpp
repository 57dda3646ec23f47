#include "protocol/toml/TableReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/files/Printable.h"

namespace heft {

namespace {
// The most similar key; preferably one that continues the written one (most likely with its unit).
std::optional<std::string> meant(std::string_view written,
                                 std::span<const std::string_view> candidates) {
  const auto longer = std::ranges::find_if(candidates, [&](std::string_view candidate) {
    return written.size() > 2 && candidate.starts_with(written);
  });
  if (longer != candidates.end()) return std::string(*longer);
  return nearest_name(written, candidates);
}

bool is_filled(const std::string* text) {
  return text && text->find_first_not_of(" \t") != std::string::npos;
}

// Names go into tables, charts and commands.
bool is_line(const std::string& text) {
  return escaped_line(text) == text;
}
constexpr auto a_text = "a text in quotes that is not empty";
constexpr auto a_line = "a text on one line, without control characters";
}  // namespace

TableReader::TableReader(const TomlTable& root, Mistakes& mistakes)
    : TableReader(root, {}, "", "the file", mistakes) {}

TableReader::TableReader(const TomlTable& table, TomlPlace place, std::string path,
                         std::string title, Mistakes& mistakes)
    : table_(&table),
      place_(place),
      path_(std::move(path)),
      title_(std::move(title)),
      mistakes_(&mistakes) {}

std::string TableReader::path_to(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const TomlEntry* TableReader::find(std::string_view key) const {
  const auto found = std::ranges::find(*table_, key, &TomlEntry::key);
  return found == table_->end() ? nullptr : &*found;
}

const TomlEntry* TableReader::take(std::string_view key) {
  known_.emplace(key);
  return find(key);
}

void TableReader::refuse(const TomlNode& node, std::string_view key, const std::string& expected) {
  mistaken_.emplace(key);
  mistakes_->add(node.place, fmt::format("{} is {}, expected {}", key, shown(node), expected));
}

void TableReader::mistake(std::string_view key, const std::string& message) {
  const TomlEntry* entry = find(key);
  mistaken_.emplace(key);
  mistakes_->add(entry ? entry->node.place : place_, message);
}

void TableReader::mistake(std::string_view key, std::size_t i, const std::string& message) {
  if (!is_list(key)) return mistake(key, message);  // a grid of values as a table
  mistaken_.emplace(key);
  mistakes_->add(std::get<TomlArray>(find(key)->node.value).at(i).place, message);
}

bool TableReader::good(std::initializer_list<std::string_view> keys) const {
  return std::ranges::none_of(keys, [&](std::string_view key) { return mistaken_.contains(key); });
}

void TableReader::note(const ConfigMistakes& mistakes) {
  const auto mistaken_before = mistaken_;
  for (const ConfigMistake& one : mistakes) {
    if (std::ranges::any_of(one.keys, [&](auto key) { return mistaken_before.contains(key); }))
      continue;
    const auto there = std::ranges::find_if(one.keys, [&](auto key) { return has(key); });
    const std::string_view key = there == one.keys.end() ? one.keys.front() : *there;
    if (one.index)
      mistake(key, *one.index, one.text());
    else
      mistake(key, one.what.starts_with("lacks") ? title_ + " " + one.text() : one.text());
  }
}

std::optional<double> TableReader::number(const TomlNode& node, std::string_view key,
                                          const Range& range) {
  std::optional<double> value;
  if (const auto* real = std::get_if<double>(&node.value)) value = *real;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value))
    value = static_cast<double>(*integer);
  if (value && range.holds(*value)) return value;
  std::string expected = value && !std::isfinite(*value) ? "a finite number" : "a number";
  expected += range.text();
  const bool too_far = value && std::isfinite(*value) && std::abs(*value) > furthest &&
                       (range.low <= -furthest || range.high >= furthest);
  if (too_far || std::holds_alternative<TomlOverflow>(node.value))
    expected += fmt::format(", not beyond {:g}", furthest);
  refuse(node, key, expected);
  return std::nullopt;
}

void TableReader::read(std::string_view key, double& field, const Range& range) {
  if (const TomlEntry* entry = take(key)) field = number(entry->node, key, range).value_or(field);
}

void TableReader::read(std::string_view key, std::optional<double>& field, const Range& range) {
  if (const TomlEntry* entry = take(key))
    if (const auto value = number(entry->node, key, range)) field = value;
}

std::optional<std::int64_t> TableReader::whole(std::string_view key, const WholeRange& range) {
  const TomlEntry* entry = take(key);
  if (!entry) return std::nullopt;
  const auto* value = std::get_if<std::int64_t>(&entry->node.value);
  if (value && *value >= range.low && *value <= range.high) return *value;
  const bool too_large =
      std::holds_alternative<TomlOverflow>(entry->node.value) || (value && *value > range.high);
  refuse(entry->node, key,
         too_large ? fmt::format("a whole number from {} to {}", range.low, range.high)
                   : range.text());
  return std::nullopt;
}

void TableReader::read(std::string_view key, int& field, const WholeRange& range) {
  if (const auto value = whole(key, range)) field = static_cast<int>(*value);
}

void TableReader::read(std::string_view key, std::uint64_t& field, const WholeRange& range) {
  if (const auto value = whole(key, range)) field = static_cast<std::uint64_t>(*value);
}

void TableReader::read(std::string_view key, bool& field) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  if (const auto* value = std::get_if<bool>(&entry->node.value))
    field = *value;
  else
    refuse(entry->node, key, "true or false");
}

void TableReader::read(std::string_view key, std::string& field) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  const auto* value = std::get_if<std::string>(&entry->node.value);
  if (!is_filled(value))
    refuse(entry->node, key, a_text);
  else if (!is_line(*value))
    refuse(entry->node, key, a_line);
  else
    field = *value;
}

void TableReader::read_lines(std::string_view key, std::string& field) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  const auto* value = std::get_if<std::string>(&entry->node.value);
  if (is_filled(value))
    field = *value;
  else
    refuse(entry->node, key, a_text);
}

std::optional<std::string> TableReader::read_name(std::string_view key,
                                                  std::span<const std::string_view> names) {
  const TomlEntry* entry = take(key);
  if (!entry) return std::nullopt;
  const auto* value = std::get_if<std::string>(&entry->node.value);
  if (value && std::ranges::find(names, *value) != names.end()) return *value;
  const auto nearest = value ? nearest_name(*value, names) : std::nullopt;
  refuse(entry->node, key,
         quoted_list(names) + (nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : ""));
  return std::nullopt;
}

const TomlEntry* TableReader::take_misspelled(std::string_view key) {
  for (const TomlEntry& entry : *table_) {
    if (!nearest_name(entry.key, std::span(&key, 1))) continue;
    known_.insert(entry.key);
    mistakes_->add(entry.place, fmt::format("unknown key \"{}\" in {}, expected \"{}\"?",
                                            printable(entry.key), title_, key));
    return &entry;
  }
  return nullptr;
}

std::optional<std::string> TableReader::read_nearest_name(std::string_view key,
                                                          std::span<const std::string_view> names) {
  const TomlEntry* entry = find(key);
  if (!entry) entry = take_misspelled(key);
  if (!entry) {
    mistake(key, fmt::format("{} lacks \"{}\", expected {}", title_, key, quoted_list(names)));
    return std::nullopt;
  }
  if (auto name = read_name(key, names)) return name;
  const auto* written = std::get_if<std::string>(&entry->node.value);
  return written ? nearest_name(*written, names) : std::nullopt;
}

std::optional<std::vector<double>> TableReader::numbers(const TomlNode& node, std::string_view key,
                                                        const Range& range, std::size_t count) {
  const auto* array = std::get_if<TomlArray>(&node.value);
  if (!array) {
    refuse(node, key, count ? fmt::format("{} numbers in brackets", count) : "numbers in brackets");
    return std::nullopt;
  }
  std::vector<double> values;
  for (const TomlNode& element : *array)
    if (const auto value = number(element, key, range)) values.push_back(*value);
  if (count ? array->size() != count : array->empty()) {
    mistaken_.emplace(key);
    mistakes_->add(node.place, fmt::format("{} has {} numbers, expected {}", key, array->size(),
                                           count ? fmt::format("{}", count) : "at least 1"));
  }
  if (!good({key})) return std::nullopt;
  return values;
}

std::optional<std::vector<double>> TableReader::numbers(std::string_view key, const Range& range,
                                                        std::size_t count) {
  const TomlEntry* entry = take(key);
  return entry ? numbers(entry->node, key, range, count) : std::nullopt;
}

void TableReader::read(std::string_view key, std::vector<double>& field, const Range& range) {
  if (auto values = numbers(key, range, 0)) field = std::move(*values);
}

void TableReader::read(std::string_view key, std::vector<std::string>& field) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  const std::string expected = "texts in quotes, in brackets, none of them empty";
  const auto* array = std::get_if<TomlArray>(&entry->node.value);
  if (!array || array->empty()) return refuse(entry->node, key, expected);
  std::vector<std::string> texts;
  for (const TomlNode& element : *array) {
    const auto* text = std::get_if<std::string>(&element.value);
    if (!is_filled(text))
      refuse(element, key, expected);
    else if (!is_line(*text))
      refuse(element, key, a_line);
    else
      texts.push_back(*text);
  }
  if (good({key})) field = std::move(texts);
}

void TableReader::read(std::string_view key, Eigen::Vector2d& field, const Range& range) {
  if (const auto values = numbers(key, range, 2)) field = Eigen::Vector2d(values->data());
}

void TableReader::read(std::string_view key, Eigen::Vector3d& field, const Range& range) {
  if (const auto values = numbers(key, range, 3)) field = Eigen::Vector3d(values->data());
}

void TableReader::read(std::string_view key, std::vector<Eigen::Vector2d>& pairs, const Range& of_a,
                       const Range& of_b) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  const auto* array = std::get_if<TomlArray>(&entry->node.value);
  if (!array || array->empty()) return refuse(entry->node, key, "pairs of numbers [[a, b], ...]");
  for (const TomlNode& node : *array) {
    const auto* pair = std::get_if<TomlArray>(&node.value);
    if (!pair || pair->size() != 2) {
      refuse(node, key, "pairs of numbers [[a, b], ...]");
      continue;
    }
    const auto a = number((*pair)[0], key, of_a), b = number((*pair)[1], key, of_b);
    if (a && b) pairs.emplace_back(*a, *b);
  }
  if (!good({key})) pairs.clear();
}

void TableReader::read(std::string_view key, std::span<Eigen::Vector3d> points) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  const auto* array = std::get_if<TomlArray>(&entry->node.value);
  if (!array || array->size() != points.size())
    return refuse(entry->node, key,
                  fmt::format("{} points [x, y, z], each in brackets", points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const auto values = numbers((*array)[i], key, any_number, 3))
      points[i] = Eigen::Vector3d(values->data());
}

void TableReader::read_size(std::string_view key, Eigen::Vector3d& field) {
  const TomlEntry* entry = take(key);
  if (!entry) return;
  if (std::holds_alternative<TomlArray>(entry->node.value)) return read(key, field, size_on_earth);
  if (const auto value = number(entry->node, key, size_on_earth)) field.setConstant(*value);
}

bool TableReader::is_list(std::string_view key) const {
  const TomlEntry* entry = find(key);
  return entry && std::holds_alternative<TomlArray>(entry->node.value);
}

bool TableReader::has_table(std::string_view key) const {
  const TomlEntry* entry = find(key);
  return entry && std::holds_alternative<TomlTable>(entry->node.value);
}

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> keys;
  for (const TomlEntry& entry : *table_) keys.push_back(entry.key);
  std::ranges::sort(keys);
  return keys;
}

std::optional<TableReader> TableReader::table(std::string_view key) {
  const TomlEntry* entry = take(key);
  if (!entry) return std::nullopt;
  const std::string title = fmt::format("[{}]", path_to(key));
  if (const auto* inner = std::get_if<TomlTable>(&entry->node.value))
    return TableReader(*inner, entry->node.place, path_to(key), title, *mistakes_);
  refuse(entry->node, key, "a table " + title);
  return std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  const TomlEntry* entry = take(key);
  if (!entry) return {};
  const std::string title = fmt::format("[[{}]]", path_to(key));
  const auto* array = std::get_if<TomlArray>(&entry->node.value);
  std::vector<TableReader> readers;
  if (!array || array->empty()) {
    refuse(entry->node, key, "tables " + title);
    return readers;
  }
  for (const TomlNode& node : *array) {
    if (const auto* inner = std::get_if<TomlTable>(&node.value))
      readers.push_back({*inner, node.place, path_to(key), title, *mistakes_});
    else
      refuse(node, key, "a table " + title);
  }
  return readers;
}

void TableReader::require(std::initializer_list<std::string_view> keys) {
  required_.insert(required_.end(), keys.begin(), keys.end());
  known_.insert(keys.begin(), keys.end());
}

void TableReader::refuse_unknown(const TomlEntry& entry) {
  const std::vector<std::string_view> known(known_.begin(), known_.end());
  std::vector<std::string_view> absent;  // candidates for a misspelled key
  std::ranges::copy_if(known, std::back_inserter(absent), [&](auto key) { return !has(key); });
  auto nearest = meant(entry.key, absent);
  if (nearest) mistaken_.insert(*nearest);
  if (!nearest) nearest = meant(entry.key, known);
  mistakes_->add(entry.place,
                 fmt::format("unknown key \"{}\" in {}, expected {}", printable(entry.key), title_,
                             nearest ? fmt::format("\"{}\"?", *nearest) : quoted_list(known)));
}

void TableReader::close() {
  for (const TomlEntry& entry : *table_)
    if (!known_.contains(entry.key)) refuse_unknown(entry);
  for (const std::string& key : required_)
    if (!find(key) && !mistaken_.contains(key))
      mistake(key, fmt::format("{} lacks \"{}\"", title_, key));
}

}  // namespace heft
