#include "apparatus/StudyPlaces.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "base/files/TextFile.h"

namespace heft {

namespace {
std::string value_of(const ParticipantInfo& info, const char* key) {
  const auto found = info.find(key);
  return found == info.end() ? "" : found->second;
}

int whole(const std::string& text) {
  return static_cast<int>(number_in(text).value_or(0));
}

bool counts(const SessionRow& session, const StudyPlan& plan, Purpose purpose) {
  return session.header.purpose == purpose &&
         value_of(session.header.participant_info, "study") == plan.name;
}

// If an edited plan changes the meaning of places, some would be given twice and others never.
void refuse_other_place(const SessionRow& session, const LoggedPlace& logged,
                        const StudyPlan& plan) {
  std::string now = fmt::format("has only {} places", plan.participants);
  if (logged.number >= 1 && logged.number <= plan.participants) {
    const auto planned = info_of(plan, place_in(plan, logged.number));
    if (planned.at("study_group") == logged.group && planned.at("study_order") == logged.order)
      return;
    now = fmt::format("gives group \"{}\", order \"{}\"", planned.at("study_group"),
                      planned.at("study_order"));
  }
  throw Error(
      fmt::format("session {} of participant {} has place {} of the study \"{}\" (group "
                  "\"{}\", order \"{}\"), but the plan now {}: its groups, orders, seed or "
                  "number of participants were changed. Undo that, or give the changed "
                  "study another name",
                  session.session_id, session.header.participant, logged.number, plan.name,
                  logged.group, logged.order, now));
}

std::map<int, const SessionRow*> taken_places(const StudyPlan& plan,
                                              const std::vector<SessionRow>& sessions,
                                              Purpose purpose) {
  std::map<int, const SessionRow*> taken;
  for (const SessionRow& session : sessions) {
    if (!counts(session, plan, purpose)) continue;
    const auto logged = place_of(session.header.participant_info);
    if (!logged || session.state == SessionState::withdrawn) continue;
    refuse_other_place(session, *logged, plan);
    if (session.state != SessionState::aborted) taken[logged->number] = &session;
  }
  return taken;
}

bool is_in(const std::vector<SessionRow>& sessions, const std::string& id) {
  return std::ranges::any_of(
      sessions, [&](const SessionRow& session) { return session.header.participant == id; });
}

// How many withdrawn sessions had a place; their ids are not in the log any more.
std::ptrdiff_t n_withdrawn_from(const StudyPlan& plan, int number,
                                const std::vector<SessionRow>& sessions, Purpose purpose) {
  return std::ranges::count_if(sessions, [&](const SessionRow& session) {
    return session.state == SessionState::withdrawn && counts(session, plan, purpose) &&
           place_of(session.header.participant_info)->number == number;
  });
}

// The plan's id, or P07b if a session of P07 was begun and ended or withdrawn.
std::string fresh_id(const StudyPlan& plan, int number, const std::vector<SessionRow>& sessions,
                     Purpose purpose) {
  const std::string planned = id_for(purpose, planned_id(plan, number));
  auto n_withdrawn = n_withdrawn_from(plan, number, sessions, purpose);
  std::string id = planned;
  for (char letter = 'b'; (is_in(sessions, id) || n_withdrawn-- > 0) && letter <= 'z'; ++letter)
    id = planned + letter;
  return id;
}

// For comparison: without blanks, hyphens, leading zeros of numbers and capitals; O is read as 0, l
// and I as 1.
std::string folded(const std::string& id) {
  std::string plain;
  for (const char c : id) {
    if (c == ' ' || c == '\t' || c == '-' || c == '_' || c == '.') continue;
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    plain += small == 'o' ? '0' : small == 'l' || small == 'i' ? '1' : small;
  }
  std::string folded;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const auto is_digit = [&](std::size_t k) { return plain[k] >= '0' && plain[k] <= '9'; };
    const bool leads =
        plain[i] == '0' && (i == 0 || !is_digit(i - 1)) && i + 1 < plain.size() && is_digit(i + 1);
    if (leads)
      plain[i] = ' ';  // so that the next zero is a leading one, too
    else
      folded += plain[i];
  }
  return folded;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// "01" of "P01" or "P-01"; none without a number or without other characters.
std::optional<std::string> without_letters(const std::string& id) {
  const auto number = std::ranges::find_if(id, is_digit);
  const auto is_part = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' || c == '.' ||
           c == ' ';
  };
  if (number == id.begin() || number == id.end() || !std::all_of(number, id.end(), is_digit) ||
      !std::all_of(id.begin(), number, is_part))
    return std::nullopt;
  return std::string(number, id.end());
}

// Whether the id is the session's without its letters, such as "01" for "P01". Main sessions only:
// ids such as pilot-P01 and simulated-1 are compared whole.
bool lacks_letters_of(const std::string& id, const SessionRow& session) {
  if (session.header.purpose != Purpose::main) return false;
  const auto number = without_letters(session.header.participant);
  return number && folded(*number) == folded(id);
}
}  // namespace

std::optional<LoggedPlace> place_of(const ParticipantInfo& info) {
  if (value_of(info, "study").empty()) return std::nullopt;
  return LoggedPlace{value_of(info, "study"),
                     value_of(info, "study_group"),
                     value_of(info, "study_order"),
                     whole(value_of(info, "study_place")),
                     whole(value_of(info, "study_participants")),
                     value_of(info, "study_backup")};
}

std::string place_words(const ParticipantInfo& info) {
  const auto place = place_of(info);
  return place ? fmt::format("{} of {}", place->number, place->participants) : "";
}

PlannedParticipant planned_participant(const StudyPlan& plan,
                                       const std::vector<SessionRow>& sessions, Purpose purpose,
                                       const std::optional<std::string>& id) {
  const auto taken = taken_places(plan, sessions, purpose);
  const auto is_free = [&](int number) { return !taken.contains(number); };
  const auto given = [&](int number, const std::string& participant) {
    return PlannedParticipant{place_in(plan, number), participant};
  };
  if (id) {
    const std::string own = id_for(purpose, *id);
    for (const auto& [number, session] : taken)
      if (session->header.participant == own) return given(number, own);
    for (int number = 1; number <= plan.participants; ++number)
      if (is_free(number) && id_for(purpose, planned_id(plan, number)) == own)
        return given(number, own);
  }
  for (int number = 1; number <= plan.participants; ++number)
    if (is_free(number))
      return given(number, id ? id_for(purpose, *id) : fresh_id(plan, number, sessions, purpose));
  throw Error(
      fmt::format("all {} participants of the study \"{}\" have their sessions; to continue, "
                  "plan more: a larger `participants` keeps the existing places",
                  plan.participants, plan.name));
}

OtherVersions had_another_protocol(const StudyPlan& plan, const std::vector<SessionRow>& sessions,
                                   Purpose purpose, const std::string& group,
                                   const std::string& protocol_sha256) {
  OtherVersions found;
  for (const SessionRow& session : sessions) {
    const SessionHeader& header = session.header;
    if (!counts(session, plan, purpose) || session.state == SessionState::aborted ||
        session.state == SessionState::withdrawn ||
        value_of(header.participant_info, "study_group") != group)
      continue;
    found.newest_too = header.protocol_sha256 != protocol_sha256;
    if (found.newest_too) found.participants.push_back(header.participant);
  }
  return found;
}

std::string id_for(Purpose purpose, const std::string& id) {
  if (purpose == Purpose::main) return id;
  const std::string rehearsal = std::string(name_of(purpose)) + '-';
  return id.starts_with(rehearsal) ? id : rehearsal + id;
}

ParticipantInfo info_of(const StudyPlan& plan, const StudyPlace& place) {
  const StudyGroup& group = plan.groups[static_cast<std::size_t>(place.group)];
  return {{"study", plan.name},
          {"study_sha256", plan.sha256},
          {"study_place", fmt::format("{}", place.number)},
          {"study_participants", fmt::format("{}", plan.participants)},
          {"study_group", group.name},
          {"study_order", described(plan.orders[static_cast<std::size_t>(place.order)])}};
}

std::optional<std::string> near_planned_id(const std::string& id, const StudyPlan& plan) {
  std::optional<std::string> near;
  for (int number = 1; number <= plan.participants; ++number) {
    const std::string planned = planned_id(plan, number);
    if (planned == id) return std::nullopt;
    const std::string bare = planned.substr(plan.id_prefix.size());
    if (!near && (folded(planned) == folded(id) || folded(bare) == folded(id))) near = planned;
  }
  return near;
}

bool is_planned_id(const std::string& id, const StudyPlan& plan) {
  for (int number = 1; number <= plan.participants; ++number)
    if (planned_id(plan, number) == id) return true;
  return false;
}

std::optional<std::string> near_id(const std::string& id, const std::vector<SessionRow>& sessions) {
  if (is_in(sessions, id)) return std::nullopt;
  for (const SessionRow& session : sessions)
    if (folded(session.header.participant) == folded(id) || lacks_letters_of(id, session))
      return session.header.participant;
  return std::nullopt;
}

}  // namespace heft
