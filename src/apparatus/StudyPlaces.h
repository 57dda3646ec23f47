// The next participant of a study, from its plan and the sessions in its log.
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

/// The plan's assignment of a session, as recorded in participant_info.
struct LoggedPlace {
  std::string study, group, order;
  int number = 0, participants = 0;
  std::string backup;  ///< folder; empty: none
};

/// None if the session belongs to no study.
std::optional<LoggedPlace> place_of(const ParticipantInfo& info);

/// "7 of 24"; empty if the session belongs to no study.
std::string place_words(const ParticipantInfo& info);

struct PlannedParticipant {
  StudyPlace place;
  std::string id;
};

/// The first free place, or the participant's own. A place is free again after its session was
/// ended for good (state "aborted") or withdrawn. Sessions of other studies and purposes do not
/// count, but their ids are not given again: P07 becomes P07b. Each purpose except main has
/// separate places and ids, see id_for().
/// @param sessions of the log  @param id none: the plan's
/// @throws Error if all places are taken, or a logged place contradicts the plan
PlannedParticipant planned_participant(const StudyPlan& plan,
                                       const std::vector<SessionRow>& sessions, Purpose purpose,
                                       const std::optional<std::string>& id);

/// The id itself for data; "pilot-P07", "test-P07" or "simulated-P07" for other purposes, so that
/// trying a study takes no participant's id.
std::string id_for(Purpose purpose, const std::string& id);

/// Participants of a group whose sessions used another version of its protocol.
struct OtherVersions {
  std::vector<std::string> participants;
  bool newest_too = false;  ///< the group's last one, so the protocol has changed since
};

/// @param protocol_sha256 of the current protocol
OtherVersions had_another_protocol(const StudyPlan& plan, const std::vector<SessionRow>& sessions,
                                   Purpose purpose, const std::string& group,
                                   const std::string& protocol_sha256);

/// The rows of participant_info that place_of() reads.
ParticipantInfo info_of(const StudyPlan& plan, const StudyPlace& place);

/// An id that may have been meant: 01 for 1, " 01" or O1; P01 for P-01, p1, 01 or 1. None if the id
/// itself exists, or no similar one does.
std::optional<std::string> near_id(const std::string& id, const std::vector<SessionRow>& sessions);

/// The same among the plan's ids.
std::optional<std::string> near_planned_id(const std::string& id, const StudyPlan& plan);

bool is_planned_id(const std::string& id, const StudyPlan& plan);

}  // namespace heft
