// The queries for a session's rows, each with the attempt it belongs to. Private to this room.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// What a session's chains of digests start from. Parameter: the session's id.
inline constexpr auto chain_start_sql =
    "SELECT participant || '/' || protocol_sha256 || '/' || seed FROM session WHERE session_id = ?";

// First column the row's id, then the attempt (0 where the row names no trial; a text, which Cells
// refuses, where its session has no such trial), then `columns`; ordered by id. ?1 is the session.

/// Rows that carry the session's id themselves. @param condition that they fulfill, as SQL
std::string in_session(std::string_view table, std::string_view id, std::string_view columns,
                       std::string_view condition = "true");

/// The same for frames of all attempts, which are many: without a look at other sessions'.
std::string frames_in_session(std::string_view columns);

/// Rows that belong to a session through their trial.
std::string in_trials(std::string_view table, std::string_view id, std::string_view columns);

}  // namespace heft
