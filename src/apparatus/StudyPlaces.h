// Who is next in a study: its plan, and what its log says of those who have taken part.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/study/StudyPlan.h"
#include "record/reader/LogReader.h"

namespace heft {

/// A session's rows of participant_info, by key.
using ParticipantInfo = std::map<std::string, std::string>;

/// What a plan gave a session, as participant_info has it.
struct LoggedPlace {
  std::string study, group, order;
  int number = 0, participants = 0;
  std::string backup;  ///< folder; empty: none
};

/// None where the session was of no study.
std::optional<LoggedPlace> place_of(const ParticipantInfo& info);

/// "7 of 24"; empty where the session was of no study.
std::string place_words(const ParticipantInfo& info);

struct PlannedParticipant {
  StudyPlace place;
  std::string id;
};

/// The first place that nobody has, or the participant's own. A place is free again when its
/// session was ended for good (state "aborted"). Sessions of other studies and purposes don't
/// count, but their ids are not given again: P07 comes as P07b. Each purpose but main has places
/// and ids of its own, as id_for() makes them.
/// @param sessions of the log  @param id none: as the plan calls them
/// @throws Error when all places are taken, or a place was given otherwise than the plan gives it
PlannedParticipant planned_participant(const StudyPlan& plan,
                                       const std::vector<SessionRow>& sessions, Purpose purpose,
                                       const std::optional<std::string>& id);

/// The id itself for what is to be data; "pilot-P07", "test-P07" or "simulated-P07" for what is
/// not, so that nobody's id is taken by whoever tried the study before them.
std::string id_for(Purpose purpose, const std::string& id);

/// Participants of a group who had another version of its protocol than there is now.
struct OtherVersions {
  std::vector<std::string> participants;
  bool newest_too = false;  ///< the last one of the group: it has changed since then
};

/// @param protocol_sha256 of the protocol as it is now
OtherVersions had_another_protocol(const StudyPlan& plan, const std::vector<SessionRow>& sessions,
                                   Purpose purpose, const std::string& group,
                                   const std::string& protocol_sha256);

/// The keys of participant_info that place_of() reads.
ParticipantInfo info_of(const StudyPlan& plan, const StudyPlace& place);

/// An id that somebody may have meant to be this one: 01 for 1, " 01" or O1, P01 for P-01, p1, 01
/// or 1. None where the id itself is there already, or no such one.
std::optional<std::string> near_id(const std::string& id, const std::vector<SessionRow>& sessions);

/// The same among the ids that the plan gives.
std::optional<std::string> near_planned_id(const std::string& id, const StudyPlan& plan);

}  // namespace heft
