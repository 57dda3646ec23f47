#include "analysis/dataset/SessionIncidents.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "experiment/Rows.h"

namespace heft {

namespace {
std::string text_of(const std::string& text) {
  return text;
}
std::string text_of(double value) {
  return fmt::format("{:g}", value);
}
std::string text_of(int value) {
  return fmt::format("{}", value);
}
template <typename Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? text_of(*value) : "";
}

// As the log's columns are, "" where a setup has none.
std::vector<std::string> values_of(const SessionConfig& setup) {
  std::vector<std::string> values;
  visit_cells(setup,
              [&](const CellColumn&, const auto& value) { values.push_back(text_of(value)); });
  return values;
}
}  // namespace

void SetupsFold::add(const SessionData& data) {
  std::set<std::pair<std::size_t, std::string>> in_session;
  for (const LoggedSetup& logged : data.setups) {
    const auto n_attempts =
        static_cast<int>(std::ranges::count_if(data.attempts, [&](const Attempt& attempt) {
          return attempt.trial.setup_index == logged.setup_index;
        }));
    const std::vector<std::string> values = values_of(logged.setup);
    for (std::size_t column = 0; column < values.size(); ++column) {
      if (values[column].empty()) continue;
      const std::pair key{column, values[column]};
      values_[key].n_attempts += n_attempts;
      values_[key].n_sessions += in_session.insert(key).second ? 1 : 0;
    }
  }
}

std::vector<SetupValue> SetupsFold::result() const {
  std::vector<CellColumn> columns;
  visit_cells(SessionConfig{},
              [&](const CellColumn& column, const auto&) { columns.push_back(column); });
  std::vector<SetupValue> rows;
  for (const auto& [key, counted] : values_) {
    const CellColumn& column = columns[key.first];
    rows.push_back({column.full_name(), std::string(column.unit), key.second,
                    std::string(column.meaning), counted.n_sessions, counted.n_attempts});
  }
  return rows;
}

void IncidentsFold::add(const SessionData& data) {
  const std::string participant = data.noted.empty() ? "" : data.participant();
  for (const Noted& noted : data.noted)
    incidents_.push_back({data.session.session_id, participant, noted});
}

}  // namespace heft
