// A verified copy of a whole log after a session.
#pragma once

#include <cstdint>
#include <string>

namespace heft {

/// "P07_session7_20261122T093000Z_1a2b3c4d5e6f"; special characters become "_".
/// @param head the log's; empty: without it
std::string backup_name(const std::string& participant, std::int64_t session_id,
                        const std::string& utc, const std::string& head);

/// Creates the folder if missing and tests, before a session, that files can be written there.
/// @throws Error if it cannot be created or written
void require_backup_folder(const std::string& folder);

/// Copies the committed log to a new file in `folder`, readable by its owner only (0600). The copy
/// is named NAME.part until its pages, constraints, references and the session's digests were
/// checked; then it gets the first free name (NAME.db, NAME-2.db...).
/// @param db the log; not open for writing in this program
/// @return the copy's path
/// @throws Error if it cannot be made or is not sound; the log is unchanged
std::string back_up(const std::string& db, const std::string& folder, std::int64_t session_id);

}  // namespace heft
