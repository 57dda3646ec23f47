#include "analysis/Dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "analysis/Jnd.h"
#include "base/Error.h"
#include "protocol/Protocol.h"

namespace heft {

std::vector<double> Attempt::masses_g() const {
  std::vector<double> masses;
  for (const CubeRow& cube : cubes) masses.push_back(cube.mass_g);
  return masses;
}

std::optional<std::string> SessionData::model() const {
  for (const LoggedSetup& logged : setups) {
    if (has_person(logged.setup)) continue;
    const bool answered = std::ranges::any_of(attempts, [&](const Attempt& attempt) {
      return attempt.trial.setup_index == logged.setup_index;
    });
    if (answered || attempts.empty()) return logged.setup.responder;
  }
  return std::nullopt;
}

std::string SessionData::participant() const {
  const auto responder = model();
  return responder ? fmt::format("{} ({})", session.header.participant, *responder)
                   : session.header.participant;
}

const Setup* SessionData::setup_of(const Attempt& attempt) const {
  const auto found =
      std::ranges::find(setups, attempt.trial.setup_index, &LoggedSetup::setup_index);
  return found == setups.end() ? nullptr : &found->setup;
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
  data.attempts.reserve(rows.trials.size());  // of a thousand sessions, what is spare is much
  std::map<int, std::size_t> place;           // attempt index -> its place in data.attempts
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
  for (Attempt& attempt : data.attempts) {
    std::ranges::sort(attempt.cubes, {}, &CubeRow::slot);
    attempt.cubes.shrink_to_fit();
    attempt.answers.shrink_to_fit();
  }
  return data;
}

PictureCounts count_pictures(const std::vector<LoggedEvent>& events) {
  PictureCounts counts;
  for (const LoggedEvent& logged : events)
    if (const auto* report = logged.event.as<CameraReport>()) {
      counts.shown += report->n_shown;
      counts.dropped += report->n_dropped;
      counts.late += report->n_late;
    }
  return counts;
}

EventCounts count_events(const std::vector<LoggedEvent>& events) {
  EventCounts counts;
  for (const LoggedEvent& logged : events) {
    counts.notes += logged.event.kind() == EventKind::note ? 1 : 0;
    counts.deviations += logged.event.kind() == EventKind::deviation ? 1 : 0;
    counts.unblindings += logged.event.kind() == EventKind::unblinding ? 1 : 0;
    counts.effector_lost += logged.event.kind() == EventKind::effector_lost ? 1 : 0;
    if (const auto* consent = logged.event.as<Consent>()) counts.consented = consent->agreed;
    if (const auto* check = logged.event.as<CheckResult>()) {
      counts.checks_failed += check->verdict == CheckVerdict::failed ? 1 : 0;
      counts.checks_warned += check->verdict == CheckVerdict::warning ? 1 : 0;
    }
  }
  return counts;
}

namespace {
struct Declared {
  std::set<std::string> without_jnd;
  std::optional<AnalysisPlan> plan;
  ExclusionRules exclusion;
};

constexpr std::array counted_kinds{
    EventKind::note,   EventKind::deviation, EventKind::unblinding,   EventKind::check,
    EventKind::camera, EventKind::consent,   EventKind::effector_lost};

// The contents of a session's files, of which no figure is made: of a thousand sessions they are
// most of what would be kept in memory.
void forget_contents(Setup& setup) {
  for (std::string* text : {&setup.responder_text, &setup.tracker_text, &setup.camera_text,
                            &setup.board_text, &setup.effector_text, &setup.texts_text})
    *text = {};
  setup.participant_parameters.clear();
}

Declared declared_in(const std::string& protocol_text) {
  Declared declared{staircases_without_jnd(protocol_text), {}, {}};
  try {
    const Protocol protocol = parse_protocol(protocol_text, "protocol");
    if (protocol.analysis.declares_any()) declared.plan = protocol.analysis;
    declared.exclusion = protocol.exclusion;
  } catch (const InvalidFile&) {
  }
  return declared;
}
}  // namespace

Dataset read_dataset(const std::string& database, const std::vector<std::int64_t>& session_ids) {
  const LogReader log(database);
  std::vector<SessionRow> sessions;
  if (session_ids.empty()) sessions = log.sessions();
  for (std::int64_t id : std::set(session_ids.begin(), session_ids.end()))
    sessions.push_back(log.session(id));
  Dataset dataset{database, {}};
  std::map<std::string, Declared> declared;  // by the protocol's text
  for (const SessionRow& session : sessions) {
    const std::int64_t id = session.session_id;
    dataset.sessions.push_back(join_rows(session, {log.trials(id), log.cubes(id), log.answers(id),
                                                   log.reversals(id), log.estimates(id)}));
    SessionData& data = dataset.sessions.back();
    data.setups = log.setups(id);
    for (LoggedSetup& logged : data.setups) forget_contents(logged.setup);
    const auto [found, is_new] = declared.try_emplace(session.header.protocol_text);
    if (is_new) found->second = declared_in(session.header.protocol_text);
    data.without_jnd = found->second.without_jnd;
    data.plan = found->second.plan;
    data.exclusion = found->second.exclusion;
    const std::vector<LoggedEvent> events = log.events(id, counted_kinds);
    data.frames = log.frame_counts(id);
    data.events = count_events(events);
    if (!data.simulated()) data.pictures = count_pictures(events);
  }
  return dataset;
}

std::vector<std::string> purposes(const Dataset& dataset) {
  std::set<std::string> names;
  for (const SessionData& data : dataset.sessions)
    names.emplace(name_of(data.session.header.purpose));
  return {names.begin(), names.end()};
}

void refuse_mixed_purposes(const Dataset& dataset) {
  const std::vector<std::string> names = purposes(dataset);
  if (names.size() < 2) return;
  std::string counts;
  for (const std::string& name : names) {
    const auto n = std::ranges::count(dataset.sessions, name, [](const SessionData& data) {
      return name_of(data.session.header.purpose);
    });
    counts += fmt::format("{}{} of purpose \"{}\"", counts.empty() ? "" : ", ", n, name);
  }
  throw Error(fmt::format("{} holds sessions of several purposes ({}), and their figures don't "
                          "belong together. Name the sessions to use with --session, or put all "
                          "together with --mix.",
                          dataset.database, counts),
              ExitCode::usage);
}

}  // namespace heft
