// A copy of a whole log after a session, that was looked at before it is called one.
#pragma once

#include <cstdint>
#include <string>

namespace heft {

/// "P07_session7_20261122T093000Z", without its ".db"; what a file name should not hold is "_"
/// there.
std::string backup_name(const std::string& participant, std::int64_t session_id,
                        const std::string& utc);

/// Makes the folder where it is not there, and writes a file to it and takes that away again: so
/// that before a session it is known that a copy can be put there.
/// @throws Error when it can't be made or written
void require_backup_folder(const std::string& folder);

/// Copies the log, as it is committed, to a file of its own in `folder` (made where it is not
/// there), for its owner alone (0600). The copy is opened for reading and checked: its pages, rules
/// and references, and the session's digests. Only then does it get its name, which is never one
/// that is taken ("...-2.db"): a half-made copy is called "NAME.part" and stays that.
/// @param db the log; nobody of this program has it open for writing
/// @return the copy's path
/// @throws Error when it can't be made or is not sound; the log is as it was
std::string back_up(const std::string& db, const std::string& folder, std::int64_t session_id);

}  // namespace heft
