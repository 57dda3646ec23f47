#include "analysis/report/Notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "analysis/dataset/Jnd.h"
#include "analysis/display/Phrases.h"
#include "tasks/Comparison.h"
#include "tasks/Judgment.h"
#include "tasks/Sorting.h"

namespace heft {

namespace {
std::string unverified_note(const Summary& summary) {
  return summary.integrity.is_verified ? "" : std::string(unverified_warning);
}

std::string withdrawn_note(const Summary& summary) {
  const int n = summary.flow.n_withdrawn;
  return n == 0 ? "" : fmt::format("Withdrawn: the data of {}.", counted(n, "session"));
}

std::string unfinished_note(const Summary& summary) {
  std::vector<std::string> sessions;
  for (const SessionSummary& session : summary.sessions)
    if (session.state != SessionState::finished)
      sessions.push_back(fmt::format("{} ({}, {})", session.session_id, session.participant,
                                     name_of(session.state)));
  if (sessions.empty()) return "";
  return fmt::format(
      "Not finished: session {}. Completed trials and finished staircases count, unless the "
      "participant is excluded.",
      some_of(sessions));
}

std::string excluded_note(const Summary& summary) {
  std::vector<std::string> excluded;
  for (const ParticipantRow& row : summary.participants)
    if (row.excluded())
      excluded.push_back(fmt::format("{} ({})", row.participant, row.excluded_because));
  if (excluded.empty()) return "";
  return fmt::format("Excluded from all figures by the rules of the protocol: {}.",
                     some_of(excluded));
}

std::string missing_note(const Summary& summary) {
  if (summary.sessions.empty()) return fmt::format("{} holds no sessions.", summary.database);
  const bool any = std::ranges::any_of(summary.sessions,
                                       [](const auto& session) { return session.n_completed > 0; });
  return any ? "" : "No trial was completed: there is nothing to estimate from.";
}
}  // namespace

void NotesCollector::add(const SessionData& data) {
  const SessionHeader& header = data.session.header;
  n_sessions_[data.participant()] += 1;
  protocols_[header.protocol_sha256] = header.protocol_name;
  for (const std::string_view task : {Comparison::task.name, Judgment::task.name}) {
    StaircaseCollector staircases(task);
    staircases.add(data);
    for (const StaircaseResult& result : staircases.results())
      if (result.jnd_g) methods_[result.compared.block].insert(result.compared.method);
  }
  if (std::ranges::any_of(data.setups,
                          [](const auto& s) { return s.setup.tracker.name == "mouse"; }))
    dragged_.push_back(fmt::format("{} ({})", data.session.session_id, header.participant));
  for (const Attempt& attempt : data.attempts) {
    if (attempt.trial.plan.task != Sorting::task.name || !attempt.completed()) continue;
    std::vector<double> masses_g = attempt.masses_g();
    std::ranges::sort(masses_g);
    sorted_g_[attempt.trial.plan.condition].insert(std::move(masses_g));
  }
  pictures_ += data.pictures;
}

std::string NotesCollector::repeated_note() const {
  std::vector<std::string> repeated;
  for (const auto& [participant, n] : n_sessions_)
    if (n > 1) repeated.push_back(fmt::format("{} ({} sessions)", participant, n));
  if (repeated.empty()) return "";
  return fmt::format(
      "More than one session: {}. The participant counts once: sorting trials are pooled, JNDs "
      "averaged over sessions, the introduction taken from the first.",
      some_of(repeated));
}

std::string NotesCollector::protocols_note() const {
  if (protocols_.size() < 2) return "";
  std::vector<std::string> names;
  for (const auto& [sha256, name] : protocols_)
    names.push_back(fmt::format("{} ({:.8})", name, sha256));
  return fmt::format(
      "The sessions ran {} protocols, as the groups of a study do: {}. Equal conditions are "
      "analyzed together; --session N... selects sessions.",
      protocols_.size(), some_of(names));
}

std::vector<std::string> NotesCollector::methods_notes() const {
  std::vector<std::string> notes;
  for (const auto& [block, methods] : methods_)
    if (methods.size() > 1)
      notes.push_back(fmt::format(
          "{} are by several methods, in separate rows: {}.",
          block.empty() ? "JNDs" : fmt::format("Thresholds of the judgment \"{}\"", block),
          fmt::join(methods, ", ")));
  return notes;
}

// Whether a sorting is hard depends on its masses.
std::string NotesCollector::sorted_note() const {
  std::vector<std::string> conditions;
  for (const auto& [condition, all] : sorted_g_) {
    std::vector<std::string> sets;
    for (const auto& masses_g : all)
      sets.push_back(fmt::format("{:g} g", fmt::join(masses_g, ", ")));
    if (sets.size() > 1)
      conditions.push_back(fmt::format("in {} of {}", condition, fmt::join(sets, "; of ")));
  }
  if (conditions.empty()) return "";
  return fmt::format("Sortings of different masses are analyzed together: {}.",
                     some_of(conditions, 3));
}

// A dragged effector has the same physics as a held one, but other movements.
std::string NotesCollector::dragged_note() const {
  if (dragged_.empty()) return "";
  return fmt::format(
      "The effector was dragged on the screen (tracker mouse), not held, in session {}: do not "
      "compare with a held effector.",
      some_of(dragged_));
}

std::string NotesCollector::pictures_note() const {
  if (pictures_.dropped == 0 && pictures_.late == 0 && pictures_.doubled == 0) return "";
  std::string note = fmt::format(
      "Of {} camera pictures shown to participants, {} were late; {} more were dropped.",
      pictures_.shown, pictures_.late, pictures_.dropped);
  if (pictures_.doubled > 0)
    note += fmt::format(
        " {} show a second print of a tag, which tracking had to distinguish from the own one.",
        pictures_.doubled);
  return note;
}

std::vector<std::string> NotesCollector::result(const Summary& summary) const {
  std::vector<std::string> notes{unverified_note(summary),
                                 withdrawn_note(summary),
                                 excluded_note(summary),
                                 simulated_note(summary),
                                 missing_note(summary),
                                 unfinished_note(summary),
                                 repeated_note(),
                                 protocols_note(),
                                 dragged_note(),
                                 pictures_note(),
                                 sorted_note()};
  std::ranges::move(methods_notes(), std::back_inserter(notes));
  std::erase(notes, "");
  return notes;
}

}  // namespace heft
