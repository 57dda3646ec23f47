// Removing a person's data from a log.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heft {

/// Removes all rows of a session and vacuums the file. The session's number, protocol name, purpose
/// and versions remain, with the state "withdrawn", so that replay still verifies the log, and
/// analyses can count it.
/// @param when_utc of the withdrawal; kept with it
/// @return the log's new head
/// @throws Error if the log is in use or cannot be written, there is no such session, or its data
///   were withdrawn before; nothing is changed then
std::string withdraw_session(const std::string& db, std::int64_t session_id,
                             const std::string& when_utc);

/// Files in a folder and its folders that still hold a session: other logs (backups, earlier
/// versions) by participant and start time, and texts (exports, reports) by the participant's id.
/// @param db the log itself, which is not listed
std::vector<std::string> copies_of_session(const std::string& folder, const std::string& db,
                                           const std::string& participant,
                                           const std::string& started_utc);

}  // namespace heft
