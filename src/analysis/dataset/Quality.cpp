#include "analysis/dataset/Quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "experiment/Rows.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

namespace {
struct Anticipation {
  bool early = false, fast = false, untouched = false;
  bool any() const { return early || fast || untouched; }
};

bool was_touched(const Attempt& attempt) {
  if (attempt.trial.first_contact_s) return true;
  for (const CubeRow& cube : attempt.cubes)
    if (cube.n_pushes > 0) return true;
  return false;
}

// The session's rule; where the log has none, that of new protocols.
double least_answer_s(const SessionData& data, const Attempt& attempt) {
  const SessionConfig* setup = data.setup_of(attempt);
  return setup ? setup->min_answer_s.value_or(Onset{}.min_answer_s) : Onset{}.min_answer_s;
}

Anticipation anticipation_in(const SessionData& data, const Attempt& attempt) {
  Anticipation found;
  if (const auto time = response_time_s(attempt.trial)) {
    found.early = *time < least_answer_s(data, attempt);
    found.fast = *time < fastest_answer_s;
  }
  found.untouched = !was_touched(attempt);
  return found;
}

// Bands rather than levels: staircases show a different level in almost every trial.
template <std::size_t n>
std::size_t band_of(double value_g, const std::array<double, n>& tops_g) {
  std::size_t band = 0;
  while (band < n && value_g > tops_g[band]) ++band;
  return band;
}

template <std::size_t n>
std::string band_name(std::size_t band, const std::array<double, n>& tops_g) {
  if (band == 0) return tops_g[0] == 0 ? "0 g" : fmt::format("to {:g} g", tops_g[0]);
  if (band == n) return fmt::format("over {:g} g", tops_g[n - 1]);
  return fmt::format("over {:g} to {:g} g", tops_g[band - 1], tops_g[band]);
}

constexpr std::array differences_g{0.0, 100.0, 300.0, 700.0};
constexpr std::array masses_g{20.0, 100.0, 300.0, 700.0, 1000.0};

using LossKey = std::tuple<Task, std::string, std::size_t>;

LossKey key_of(const TrialPlan& plan) {
  const bool compared = plan.task == "comparison" && plan.level_g;
  return {plan.task, plan.condition,
          compared ? band_of(std::abs(*plan.level_g), differences_g) + 1 : 0};
}

void count_loss(LossRow& row, const SessionData& data, const Attempt& attempt) {
  row.n_attempts += 1;
  row.n_completed += attempt.completed() ? 1 : 0;
  row.n_void += attempt.trial.status == TrialStatus::voided ? 1 : 0;
  row.n_lost += attempt.trial.lost_s > 0 ? 1 : 0;
  row.lost_s += attempt.trial.lost_s;
  row.n_anticipatory += attempt.completed() && is_anticipatory(data, attempt) ? 1 : 0;
}

void count_resets(std::map<std::size_t, ResetRow>& resets, const Attempt& attempt) {
  for (const CubeRow& cube : attempt.cubes) {
    const std::size_t band = band_of(cube.mass_g, masses_g);
    ResetRow& row = resets[band];
    row.mass = band_name(band, masses_g);
    row.n_cubes += 1;
    row.n_reset += cube.n_resets > 0 ? 1 : 0;
  }
}

using Sums = QualityCollector::Sums;

void count_completed(Sums& sums, const SessionData& data, const Attempt& attempt) {
  const Anticipation found = anticipation_in(data, attempt);
  sums.least_answers_s.insert(least_answer_s(data, attempt));
  sums.n_completed += 1;
  sums.n_early += found.early ? 1 : 0;
  sums.n_fast += found.fast ? 1 : 0;
  sums.n_untouched += found.untouched ? 1 : 0;
}

void count_session(Sums& sums, const SessionData& data) {
  sums.events.notes += data.events.notes;
  sums.events.deviations += data.events.deviations;
  sums.events.checks_failed += data.events.checks_failed;
  sums.events.checks_warned += data.events.checks_warned;
  sums.events.unblindings += data.events.unblindings;
  sums.pictures += data.pictures;
  sums.n_sessions += 1;
  sums.n_unfinished += data.finished() ? 0 : 1;
}

std::string too_early(const std::set<double>& least_answers_s) {
  if (least_answers_s.empty())
    return fmt::format("answers earlier than {:g} s", Onset{}.min_answer_s);
  return fmt::format("answers earlier than {:g} s", fmt::join(least_answers_s, " or "));
}

std::vector<DataQualityRow> rows_of(const Sums& sums, std::span<const LossRow> losses) {
  LossRow all;
  for (const LossRow& row : losses) {
    all.n_attempts += row.n_attempts;
    all.n_void += row.n_void;
    all.n_lost += row.n_lost;
  }
  return {{too_early(sums.least_answers_s), sums.n_early, sums.n_completed,
           "time since all cubes were shown; the limit is in the session's configuration"},
          {"answers faster than 0.3 s", sums.n_fast, sums.n_completed,
           "faster than people can react; a subset of the row above"},
          {"answers without contact", sums.n_untouched, sums.n_completed,
           "no cube was touched before the answer"},
          {"void attempts", all.n_void, all.n_attempts, "each was presented again"},
          {"attempts with tracking lost", all.n_lost, all.n_attempts,
           "they count; the time is subtracted from the response time"},
          {"camera pictures dropped", sums.pictures.dropped,
           sums.pictures.shown + sums.pictures.dropped, "not shown to a participant"},
          {"camera pictures late", sums.pictures.late, sums.pictures.shown,
           "shown more than two picture periods after they were taken"},
          {"camera pictures with a second print of a tag", sums.pictures.doubled,
           sums.pictures.shown, "spare sheets and nets belong out of the camera's view"},
          {"notes", sums.events.notes, std::nullopt, "logged by the experimenter or the program"},
          {"deviations from the protocol", sums.events.deviations, std::nullopt, "logged"},
          {"checks that failed", sums.events.checks_failed, std::nullopt,
           "apparatus checks before a session"},
          {"checks that warned", sums.events.checks_warned, std::nullopt, "as above"},
          {"unblindings", sums.events.unblindings, std::nullopt,
           "hidden conditions were shown to the experimenter"},
          {"unfinished sessions", sums.n_unfinished, sums.n_sessions,
           "completed trials and finished staircases count, unless the participant is excluded"}};
}
}  // namespace

bool is_anticipatory(const SessionData& data, const Attempt& attempt) {
  return anticipation_in(data, attempt).any();
}

void QualityCollector::add(const SessionData& data) {
  count_session(sums_, data);
  for (const Attempt& attempt : data.attempts) {
    const TrialPlan& plan = attempt.trial.plan;
    const LossKey key = key_of(plan);
    LossRow& row = losses_[key];
    row.task = plan.task;
    row.condition = plan.condition;
    if (std::get<2>(key) > 0) row.difference = band_name(std::get<2>(key) - 1, differences_g);
    count_loss(row, data, attempt);
    if (!attempt.completed()) continue;
    count_completed(sums_, data, attempt);
    count_resets(resets_, attempt);
  }
}

Quality QualityCollector::result() const {
  Quality quality;
  for (const auto& [key, row] : losses_) quality.losses.push_back(row);
  quality.counted = rows_of(sums_, quality.losses);
  for (const auto& [band, row] : resets_) quality.resets.push_back(row);
  return quality;
}

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

// Texts of the columns of `setup`; "" for NULL.
std::vector<std::string> values_of(const SessionConfig& setup) {
  std::vector<std::string> values;
  visit_cells(setup,
              [&](const CellColumn&, const auto& value) { values.push_back(text_of(value)); });
  return values;
}
}  // namespace

void SetupsCollector::add(const SessionData& data) {
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

std::vector<SetupValue> SetupsCollector::result() const {
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

void IncidentsCollector::add(const SessionData& data) {
  const std::string participant = data.noted.empty() ? "" : data.participant();
  for (const Noted& noted : data.noted)
    incidents_.push_back({data.session.session_id, participant, noted});
}

}  // namespace heft
