#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"

namespace heft {

namespace {
using nlohmann::ordered_json;

ordered_json json_of(const Cell& cell) {
  if (cell.is_flag) return cell.text == "yes";
  if (!cell.value) return cell.text.empty() ? ordered_json(nullptr) : ordered_json(cell.text);
  if (!std::isfinite(*cell.value)) return nullptr;
  return cell.is_whole ? ordered_json(static_cast<std::int64_t>(*cell.value))
                       : ordered_json(*cell.value);
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::string part;
  int depth = 0;  // names of keys may be in brackets
  for (char c : path) {
    if (c == '[') ++depth;
    if (c == ']') --depth;
    if (c == '.' && depth == 0)
      parts.push_back(std::exchange(part, {}));
    else
      part += c;
  }
  parts.push_back(part);
  return parts;
}

// A row's path in the JSON tree.
class RowPath {
 public:
  RowPath(const Table& table, const std::vector<Cell>& row) : table_(table), row_(row) {}

  // The object that the row's cells go to.
  ordered_json& object_in(ordered_json& root) const {
    ordered_json* at = &root;
    for (const std::string& part : parts_of(table_.json)) at = &step(*at, part);
    return *at;
  }

  void put_cells(ordered_json& object) const {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const Column& column = table_.columns[i];
      const std::string& path = column.json.empty() ? column.name : column.json;
      if (path.empty() || path == "-" || is_in_path(column.name)) continue;
      ordered_json* at = &object;
      std::vector<std::string> parts = parts_of(path);
      for (std::string& part : parts) {
        if (part.ends_with('?')) part.pop_back();
        at = &(*at)[part];
      }
      *at = json_of(row_[i]);
    }
    for (const Column& column : table_.columns)  // "from_above?.mean_g" of nothing is null
      if (const auto mark = column.json.find('?'); mark != std::string::npos) {
        ordered_json& inner = object[column.json.substr(0, mark)];
        if (std::ranges::all_of(inner, [](const ordered_json& one) { return one.is_null(); }))
          inner = nullptr;
      }
  }

 private:
  const Cell& cell(const std::string& name) const {
    const auto found = std::ranges::find(table_.columns, name, &Column::name);
    return row_.at(static_cast<std::size_t>(found - table_.columns.begin()));
  }
  bool is_in_path(const std::string& name) const {
    return !name.empty() && table_.json.find("{" + name + "}") != std::string::npos;
  }

  ordered_json& step(ordered_json& at, const std::string& part) const {
    if (part.starts_with('{')) {
      const std::string key = json_key(cell(part.substr(1, part.size() - 2)).text);
      return key.empty() ? at : at[key];
    }
    const auto bracket = part.find('[');
    if (bracket == std::string::npos) return at[part];
    ordered_json& list = at[part.substr(0, bracket)];
    if (!list.is_array()) list = ordered_json::array();
    const std::string keys = part.substr(bracket + 1, part.size() - bracket - 2);
    if (!keys.empty())
      for (ordered_json& element : list)
        if (has_keys(element, keys)) return element;
    list.push_back(ordered_json::object());
    if (!keys.empty()) put_keys(list.back(), keys);
    return list.back();
  }
  // The keys for "all" or "I don't know" among names.
  static std::string json_key(const std::string& text) {
    return text == "all" ? "" : text == "I don't know" ? "none" : text;
  }
  template <typename Use>
  void each_key(const std::string& keys, Use use) const {
    std::size_t from = 0;
    while (from <= keys.size()) {
      const std::size_t to = std::min(keys.find(',', from), keys.size());
      const std::string name = keys.substr(from, to - from);
      use(name, json_of(cell(name)));
      from = to + 1;
    }
  }
  bool has_keys(const ordered_json& element, const std::string& keys) const {
    bool all = true;
    each_key(keys, [&](const std::string& name, const ordered_json& value) {
      all = all && element.contains(name) && element[name] == value;
    });
    return all;
  }
  void put_keys(ordered_json& element, const std::string& keys) const {
    each_key(keys,
             [&](const std::string& name, const ordered_json& value) { element[name] = value; });
  }

  const Table& table_;
  const std::vector<Cell>& row_;
};

// Adds a table without rows as an empty list or an object of nulls.
void put_empty(ordered_json& root, const Table& table) {
  ordered_json* at = &root;
  for (const std::string& part : parts_of(table.json)) {
    if (part.starts_with('{')) {
      if (at->is_null()) *at = ordered_json::object();
      return;
    }
    at = &(*at)[part.substr(0, part.find('['))];
    if (part.find('[') == std::string::npos) continue;
    if (at->is_null()) *at = ordered_json::array();
    return;
  }
  if (at->is_null()) RowPath(table, std::vector<Cell>(table.columns.size())).put_cells(*at);
}

void put(ordered_json& root, const Table& table) {
  if (table.json.empty()) return;
  if (table.rows.empty()) put_empty(root, table);
  for (const auto& row : table.rows) {
    const RowPath path(table, row);
    path.put_cells(path.object_in(root));
  }
}

ordered_json hypotheses_json(const Summary& summary) {
  ordered_json json = ordered_json::object();
  for (const Hypothesis& hypothesis : summary.hypotheses)
    json[hypothesis.name] = {{"verdict", name_of(hypothesis.verdict)},
                             {"declared", hypothesis.declared},
                             {"why", hypothesis.why},
                             {"statement", hypothesis.statement},
                             {"figures", hypothesis.figures}};
  return json;
}

ordered_json flow_json(const ParticipantFlow& flow) {
  return {{"n_asked", flow.n_asked},
          {"n_withdrawn", flow.n_withdrawn},
          {"n_declined", flow.n_declined},
          {"n_started", flow.n_started},
          {"n_finished", flow.n_finished},
          {"n_analyzed", flow.n_analyzed},
          {"n_practice_trials", flow.n_practice_trials},
          {"excluded", flow.excluded},
          {"unfinished", flow.unfinished}};
}
}  // namespace

std::string as_json(const Summary& summary) {
  ordered_json json{
      {"made_by", "heft analyse"},
      {"heft_version", HEFT_VERSION},
      {"command", summary.command},
      {"database", summary.database},
      {"verified", summary.integrity.is_verified},
      {"integrity", summary.integrity.words},
      {"simulated", summary.simulated()},
      {"data", summary.data.empty() ? ordered_json(nullptr) : ordered_json(summary.data)},
      {"confidence", confidence_level},
      {"n_sessions", summary.sessions.size()},
      {"n_participants", summary.n_participants},
      {"analysis", summary.plan ? "declared" : "exploratory"},
      {"n_excluded", std::ranges::count_if(summary.participants, &ParticipantRow::excluded)},
      {"participant_flow", flow_json(summary.flow)},
      {"hypotheses", hypotheses_json(summary)},
      {"notes", summary.notes}};
  for (const auto& places : {all_csv_places, {TablePlace::json_only}})
    for (const Table& table : tables_at(summary, places)) put(json, table);
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace heft
