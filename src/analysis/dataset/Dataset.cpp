#include "analysis/dataset/Dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

#include "base/Error.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "protocol/toml/TomlDocument.h"
#include "psychophysics/ProcedureKinds.h"
#include "record/export/Export.h"
#include "tasks/Comparison.h"
#include "tasks/Judgment.h"

namespace heft {

bool Attempt::has_comparison() const {
  return completed() && trial.plan.task == "comparison" && trial.outcome &&
         trial.plan.reference_g && trial.plan.level_g;
}

std::vector<double> Attempt::masses_g() const {
  std::vector<double> masses;
  for (const CubeRow& cube : cubes) masses.push_back(cube.mass_g);
  return masses;
}

bool Attempt::shows(std::span<const double> masses) const {
  std::vector<double> shown = masses_g();
  std::ranges::sort(shown);
  return std::ranges::equal(shown, masses) && std::ranges::none_of(cubes, [](const CubeRow& cube) {
           return cube.table_friction.has_value();
         });
}

std::optional<double> response_time_s(const TrialRow& trial) {
  if (!trial.shown_s || !trial.validated_s) return std::nullopt;
  return *trial.validated_s - *trial.shown_s - trial.paused_s - trial.lost_s;
}

std::optional<std::string> SessionData::model() const {
  for (const LoggedSetup& logged : setups) {
    if (has_person(logged.setup)) continue;
    const bool answered = std::ranges::any_of(attempts, [&](const Attempt& attempt) {
      return attempt.trial.setup_index == logged.setup_index;
    });
    if (answered || attempts.empty()) return to_text(logged.setup.responder);
  }
  return std::nullopt;
}

std::string SessionData::participant() const {
  const auto responder = model();
  return responder ? fmt::format("{} ({})", session.header.participant, *responder)
                   : session.header.participant;
}

const SessionConfig* SessionData::setup_of(const Attempt& attempt) const {
  const auto found =
      std::ranges::find(setups, attempt.trial.setup_index, &LoggedSetup::setup_index);
  return found == setups.end() ? nullptr : &found->setup;
}

std::optional<published::Condition> SessionData::published_condition(
    const std::string& condition) const {
  const auto found = published_conditions.find(condition);
  return found == published_conditions.end() ? std::nullopt : std::optional(found->second);
}

TrackingCounts SessionData::tracking() const {
  TrackingCounts counts{events.effector_lost, 0, 0, frames};
  for (const Attempt& attempt : attempts) {
    const TrialRow& trial = attempt.trial;
    if (!trial.shown_s || !trial.validated_s) continue;
    counts.lost_s += trial.lost_s;
    counts.answering_s += *trial.validated_s - *trial.shown_s - trial.paused_s;
  }
  return counts;
}

SessionData join_rows(const SessionRow& session, const SessionRows& rows) {
  SessionData data;
  data.session = session;
  data.estimates = rows.estimates;
  std::map<int, std::size_t> place;  // attempt index -> its place in data.attempts
  for (const TrialRow& trial : rows.trials) {
    place[trial.attempt_index] = data.attempts.size();
    data.attempts.push_back({trial, {}, {}, false});
  }
  const auto with_attempt = [&](int attempt_index, auto change) {
    const auto found = place.find(attempt_index);
    if (found != place.end()) change(data.attempts[found->second]);
  };
  for (const CubeRow& cube : rows.cubes)
    with_attempt(cube.attempt_index, [&](Attempt& a) { a.cubes.push_back(cube); });
  for (const AnswerRow& answer : rows.answers)
    with_attempt(answer.attempt_index, [&](Attempt& a) { a.answers.push_back(answer); });
  for (const ReversalRow& reversal : rows.reversals)
    with_attempt(reversal.attempt_index, [&](Attempt& a) { a.is_reversal = true; });
  for (Attempt& attempt : data.attempts) std::ranges::sort(attempt.cubes, {}, &CubeRow::slot);
  return data;
}

PictureCounts count_pictures(const std::vector<LoggedEvent>& events) {
  PictureCounts counts;
  for (const LoggedEvent& logged : events)
    if (const auto* report = logged.event.as<CameraReport>())
      counts += {report->n_shown, report->n_dropped, report->n_late, report->n_doubled.value_or(0)};
  return counts;
}

namespace {
std::optional<std::string> text_noted(const Event& event) {
  if (const auto* note = event.as<Note>()) return note->text;
  if (const auto* deviation = event.as<Deviation>()) return deviation->text;
  if (const auto* unblinding = event.as<Unblinding>()) return unblinding->who;
  if (const auto* check = event.as<CheckResult>(); check && check->verdict != CheckVerdict::ok)
    return fmt::format("{}, {}: {}", check->name, name_of(check->verdict), check->finding);
  return std::nullopt;
}
}  // namespace

std::vector<Noted> noted_in(const std::vector<LoggedEvent>& events) {
  std::vector<Noted> noted;
  for (const LoggedEvent& logged : events)
    if (const auto text = text_noted(logged.event))
      noted.push_back({logged.event.t_s, logged.event.kind(), *text});
  return noted;
}

EventCounts count_events(const std::vector<LoggedEvent>& events) {
  EventCounts counts;
  for (const LoggedEvent& logged : events) {
    counts.notes += logged.event.is<Note>() ? 1 : 0;
    counts.deviations += logged.event.is<Deviation>() ? 1 : 0;
    counts.unblindings += logged.event.is<Unblinding>() ? 1 : 0;
    counts.effector_lost += logged.event.is<EffectorLost>() ? 1 : 0;
    if (const auto* consent = logged.event.as<Consent>()) counts.consented = consent->agreed;
    if (const auto* check = logged.event.as<CheckResult>()) {
      counts.checks_failed += check->verdict == CheckVerdict::failed ? 1 : 0;
      counts.checks_warned += check->verdict == CheckVerdict::warning ? 1 : 0;
    }
  }
  return counts;
}

namespace {
// Forced choices give a JND only if the comparison is never the lighter one: otherwise the answers
// are equally frequent at the point of equality, not at a difference.
bool estimates_jnd(const TaskBlock& block, const Procedure& procedure) {
  if (!ProcedureKinds::estimates_level(procedure)) return false;
  const auto* comparison = block.as<Comparison::Block>();
  if (comparison) return comparison->has_three_answers();
  const auto* judgment = block.as<Judgment::Block>();
  if (!judgment || !judgment->is_forced()) return true;
  const UpDown* up_down = procedure.get_if<UpDown>();
  const auto levels_g = procedure.planned_levels();
  return std::ranges::none_of(levels_g, [](double level_g) { return level_g < 0; }) &&
         !(up_down && up_down->config().floor.value_or(0) < 0);
}
}  // namespace

std::set<std::string> staircases_without_jnd(const std::string& protocol_text) {
  std::set<std::string> names;
  try {
    for (const Block& block : parse_protocol(protocol_text, "protocol").blocks)
      if (const auto* trials = std::get_if<TaskBlock>(&block))
        for (const ReferenceStaircase& entry : trials->staircases())
          if (!estimates_jnd(*trials, entry.staircase)) names.insert(entry.staircase.name());
  } catch (const InvalidFile&) {
  }
  return names;
}

namespace {
struct Declared {
  std::set<std::string> without_jnd;
  std::map<std::string, StaircaseRun> staircases;
  std::optional<AnalysisPlan> plan;
  ExclusionRules exclusion;
  std::map<std::string, published::Condition> published_conditions;
  std::map<std::string, ComparisonAnswers> answers;  // by block, if not heavier_or_none
  std::map<std::string, Judgment::Offer> judgments;
};

constexpr std::array counted_kinds{event_kind<Note>,         event_kind<Deviation>,
                                   event_kind<Unblinding>,   event_kind<CheckResult>,
                                   event_kind<CameraReport>, event_kind<Consent>,
                                   event_kind<EffectorLost>};

std::map<std::string, StaircaseRun> staircases_in(const Protocol& protocol) {
  std::map<std::string, StaircaseRun> runs;
  for (const Block& block : protocol.blocks) {
    const auto* trials = std::get_if<TaskBlock>(&block);
    if (!trials) continue;
    const auto* comparison = trials->as<Comparison::Block>();
    for (const ReferenceStaircase& entry : trials->staircases())
      runs[entry.staircase.name()] = {
          std::make_shared<const Procedure>(entry.staircase),
          comparison && comparison->positive_answer == PositiveAnswer::correct_choice};
  }
  return runs;
}

// --set may change a technique's parameters; the text stays as it was.
Declared declared_in(const std::string& protocol_text, const SessionConfig& config) {
  Declared declared{staircases_without_jnd(protocol_text), {}, {}, {}, {}, {}, {}};
  try {
    Protocol protocol = parse_protocol(protocol_text, "protocol", config.settings);
    if (protocol.analysis.declares_any()) declared.plan = protocol.analysis;
    declared.exclusion = protocol.exclusion;
    declared.staircases = staircases_in(protocol);
    declared.published_conditions = published::conditions_in(protocol);
    for (const Block& block : protocol.blocks)
      if (const auto* comparison = block_as<Comparison::Block>(block);
          comparison && comparison->reference)
        declared.published_conditions.clear();  // the paper's reference was a cube
    for (const Block& block : protocol.blocks)
      if (const auto* comparison = block_as<Comparison::Block>(block);
          comparison && !comparison->has_three_answers())
        declared.answers[comparison->name] = comparison->answers;
    take_questions(protocol, config.texts.text, config.texts.path);
    for (const Block& block : protocol.blocks)
      if (const auto* judgment = block_as<Judgment::Block>(block); judgment && judgment->question)
        declared.judgments[judgment->name] = {*judgment->question, judgment->responses};
  } catch (const Error&) {
  }
  return declared;
}

/// Protocols are read once, however many sessions ran them with the same settings and texts.
using DeclaredByText = std::map<std::pair<std::string, std::string>, Declared>;

SessionData read_session(const LogReader& log, std::int64_t id, DeclaredByText& declared_by_text) {
  SessionData data = join_rows(log.session(id), {log.trials(id), log.cubes(id), log.answers(id),
                                                 log.reversals(id), log.estimates(id)});
  data.n_practice = static_cast<int>(std::erase_if(
      data.attempts, [](const Attempt& attempt) { return attempt.trial.plan.is_practice; }));
  data.setups = log.setups(id);
  const std::string& protocol_text = data.session.header.protocol_text;
  static const SessionConfig none;
  const SessionConfig& config = data.setups.empty() ? none : data.setups.front().setup;
  const auto [found, is_new] = declared_by_text.try_emplace(
      {protocol_text, to_text(config.settings) + '\n' + config.texts.sha256});
  if (is_new) found->second = declared_in(protocol_text, config);
  data.without_jnd = found->second.without_jnd;
  data.staircases = found->second.staircases;
  data.plan = found->second.plan;
  data.exclusion = found->second.exclusion;
  data.published_conditions = found->second.published_conditions;
  data.judgments = found->second.judgments;
  const std::vector<LoggedEvent> events = log.events(id, counted_kinds);
  data.frames = log.frame_counts(id);
  for (Attempt& attempt : data.attempts)
    if (const auto answers = found->second.answers.find(attempt.trial.plan.block);
        answers != found->second.answers.end())
      attempt.answers_offered = answers->second;
  const auto turns_deg = log.clone_yaw_deg(id);
  for (Attempt& attempt : data.attempts)
    for (const CubeRow& cube : attempt.cubes)
      if (const auto turn = turns_deg.find({attempt.trial.attempt_index, cube.slot});
          turn != turns_deg.end())
        attempt.clone_yaw_deg[cube.slot] = turn->second;
  data.events = count_events(events);
  data.noted = noted_in(events);
  data.pictures = count_pictures(events);
  return data;
}
}  // namespace

LoggedSessions::LoggedSessions(const std::vector<std::string>& databases,
                               const std::vector<std::int64_t>& session_ids) {
  if (databases.size() > 1 && !session_ids.empty())
    throw Error("--session names sessions of a single log; give one --db", ExitCode::usage);
  const std::set named(session_ids.begin(), session_ids.end());
  std::set<std::string> files;
  const std::vector<std::string> labs = lab_names(databases);
  for (const std::string& database : databases) {
    if (!files.insert(std::filesystem::weakly_canonical(database).string()).second)
      throw Error(fmt::format("{} is given twice", database), ExitCode::usage);
    OneLog& log = logs_.emplace_back(
        OneLog{database, labs.at(logs_.size()), LogReader(database), {named.begin(), named.end()}});
    if (log.session_ids.empty()) log.session_ids = log.reader.session_ids();
    n_withdrawn_ += static_cast<int>(std::erase_if(log.session_ids, [&](std::int64_t id) {
      const SessionRow session = log.reader.session(id);
      const bool is_withdrawn = session.state == SessionState::withdrawn;
      if (!is_withdrawn) purposes_[std::string(name_of(session.header.purpose))] += 1;
      return is_withdrawn;
    }));
  }
}

std::string LoggedSessions::database() const {
  std::string all;
  for (const OneLog& log : logs_) all += (all.empty() ? "" : ", ") + log.name;
  return all;
}

void LoggedSessions::each(const std::function<void(const SessionData&)>& use) const {
  DeclaredByText declared_by_text;
  for (const OneLog& log : logs_)
    for (const std::int64_t id : log.session_ids) {
      SessionData data = read_session(log.reader, id, declared_by_text);
      std::string& participant = data.session.header.participant;
      if (logs_.size() > 1) {
        participant = person_name(log.name, participant);
        data.lab = log.lab;
      }
      use(data);
    }
}

void refuse_mixed_purposes(const LoggedSessions& sessions) {
  if (sessions.purposes().size() < 2) return;
  std::string counts;
  for (const auto& [name, n] : sessions.purposes())
    counts += fmt::format("{}{} of purpose \"{}\"", counts.empty() ? "" : ", ", n, name);
  throw Error(fmt::format("{} holds sessions of several purposes ({}), and their figures don't "
                          "belong together. Name the sessions to use with --session, or put all "
                          "together with --mix.",
                          sessions.database(), counts),
              ExitCode::usage);
}

}  // namespace heft
