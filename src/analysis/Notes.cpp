#include "analysis/Notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

namespace heft {

namespace {
// "1, 2, 3 and 40 more"
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  const std::size_t shown = std::min(most, names.size());
  std::string text = fmt::format("{}", fmt::join(std::span(names).first(shown), ", "));
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

std::string unfinished_note(const Summary& summary) {
  std::vector<std::string> sessions;
  for (const SessionSummary& session : summary.sessions)
    if (session.state != SessionState::finished)
      sessions.push_back(fmt::format("{} ({}, {})", session.session_id, session.participant,
                                     name_of(session.state)));
  if (sessions.empty()) return "";
  return fmt::format(
      "Not finished: session {}. Only completed trials and finished staircases "
      "count.",
      some_of(sessions));
}

std::string repeated_note(const Dataset& dataset) {
  std::map<std::string, int> n_sessions;
  for (const SessionData& data : dataset.sessions) n_sessions[data.participant()] += 1;
  std::vector<std::string> repeated;
  for (const auto& [participant, n] : n_sessions)
    if (n > 1) repeated.push_back(fmt::format("{} ({} sessions)", participant, n));
  if (repeated.empty()) return "";
  return fmt::format(
      "More than one session: {}. All are used and the participant counts once: "
      "sorting trials together, JNDs as the mean over sessions, the introduction "
      "from the first session only.",
      some_of(repeated));
}

std::string protocols_note(const Dataset& dataset) {
  std::map<std::string, std::string> protocols;  // by content, not name
  for (const SessionData& data : dataset.sessions)
    protocols[data.session.header.protocol_sha256] = data.session.header.protocol_name;
  if (protocols.size() < 2) return "";
  std::vector<std::string> names;
  for (const auto& [sha256, name] : protocols)
    names.push_back(fmt::format("{} ({:.8})", name, sha256));
  return fmt::format(
      "The sessions used {} different protocols: {}. Their figures are put "
      "together; --session N... takes single sessions.",
      protocols.size(), some_of(names));
}

std::string other_methods_note(const Dataset& dataset) {
  std::set<std::string> methods;
  for (const SessionData& data : dataset.sessions)
    for (const EstimateRow& row : data.estimates)
      if (row.method != jnd_method) methods.insert(row.method);
  if (methods.empty()) return "";
  return fmt::format("The JNDs are those of the method {}; estimates by {} are in the log too.",
                     jnd_method, fmt::join(methods, ", "));
}

std::string excluded_note(const Summary& summary) {
  std::vector<std::string> excluded;
  for (const ParticipantRow& row : summary.participants)
    if (row.excluded())
      excluded.push_back(fmt::format("{} ({})", row.participant, row.excluded_because));
  if (excluded.empty()) return "";
  return fmt::format("Left out of every figure, as the protocol declares: {}.", some_of(excluded));
}

std::string simulated_note(const Summary& summary) {
  if (summary.data == "simulated") return "Every figure here is of simulated responders.";
  if (!summary.simulated()) return "";
  return "Figures of persons and of simulated responders are mixed here.";
}

// Nobody held anything: what they felt is of the same physics, and of another hand.
std::string dragged_note(const Dataset& dataset) {
  std::vector<std::string> sessions;
  for (const SessionData& data : dataset.sessions)
    if (std::ranges::any_of(data.setups, [](const auto& s) { return s.setup.tracker == "mouse"; }))
      sessions.push_back(
          fmt::format("{} ({})", data.session.session_id, data.session.header.participant));
  if (sessions.empty()) return "";
  return fmt::format(
      "The effector was dragged on the screen (tracker mouse), not held, in session {}: to try and "
      "to teach, not to be put beside a held one's figures.",
      some_of(sessions));
}

std::string pictures_note(const Dataset& dataset) {
  PictureCounts all;
  for (const SessionData& data : dataset.sessions) {
    all.shown += data.pictures.shown;
    all.dropped += data.pictures.dropped;
    all.late += data.pictures.late;
  }
  if (all.dropped == 0 && all.late == 0) return "";
  return fmt::format(
      "Of {} pictures shown to persons {} came late, and {} of the camera's were never shown; the "
      "log's frames say which.",
      all.shown, all.late, all.dropped);
}

std::string missing_note(const Summary& summary) {
  if (summary.sessions.empty()) return fmt::format("{} holds no sessions.", summary.database);
  const bool any = std::ranges::any_of(summary.sessions,
                                       [](const auto& session) { return session.n_completed > 0; });
  return any ? "" : "No trial was completed: there is nothing to estimate from.";
}
}  // namespace

std::vector<std::string> notes_on(const Dataset& dataset, const Summary& summary) {
  std::vector<std::string> notes{
      simulated_note(summary),     missing_note(summary),  unfinished_note(summary),
      excluded_note(summary),      repeated_note(dataset), protocols_note(dataset),
      other_methods_note(dataset), dragged_note(dataset),  pictures_note(dataset)};
  std::erase(notes, "");
  return notes;
}

}  // namespace heft
