// The log's tables, their versions, and the column lists that writing and reading share. DESIGN.md,
// "The log", is the contract for the names.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace SQLite {
class Database;
}

namespace heft::schema {

/// "Heft" in ASCII: marks the file as ours for `file` and for SQLite.
inline constexpr std::int64_t application_id = 0x48656674;

/// The version that this program writes; the file's is its user_version.
int current_version();

/// What a database file holds.
enum class FileKind { empty, log, newer_log, foreign };
FileKind kind_of(SQLite::Database& database);

/// Creates the tables in an empty file, or brings an older log up to date. Call it in a
/// transaction.
void migrate(SQLite::Database& database);

// Columns after the keys, in the order in which rows are bound and read.
inline constexpr std::string_view header_columns =
    "participant, protocol_name, protocol_text, protocol_sha256, seed, heft_version, build, "
    "run_options, started_utc, purpose, responder";  ///< state and digest follow
inline constexpr std::string_view event_columns = "t_s, kind, slot, label, detail, value";
inline constexpr std::string_view trial_columns =
    "attempt_index, trial_number, attempt, block, task, condition, staircase, reference_g, "
    "level_g, is_catch, n_reshuffles, status, void_reason, outcome, chosen_slot, reference_slot, "
    "choice_correct, started_s, shown_s, first_contact_s, first_choice_s, validated_s, paused_s, "
    "lost_s, ended_s";
inline constexpr std::string_view cube_columns =
    "slot, mass_g, n_pushes, contact_s, first_contact_s, last_contact_s";
inline constexpr std::string_view answer_columns = "t_s, action, slot, label";
inline constexpr std::string_view reversal_columns =
    "staircase, number, level_g, step_before_g, step_after_g";
inline constexpr std::string_view estimate_columns =
    "staircase, method, jnd_g, low_g, high_g, n_trials, n_reversals, n_floor, n_ceiling, reason";
inline constexpr std::string_view frame_columns =
    "after_event, t_s, trial_t_s, capture_s, present_s, tracked, jump, contact_slot, quality, "
    "state_hash, "
    "effector_x_m, effector_y_m, effector_z_m, "
    "effector_qw, effector_qx, effector_qy, effector_qz, "
    "effector_vx_m_s, effector_vy_m_s, effector_vz_m_s, "
    "effector_wx_rad_s, effector_wy_rad_s, effector_wz_rad_s, "
    "clone_x_m, clone_y_m, clone_z_m, clone_qw, clone_qx, clone_qy, clone_qz, "
    "cube1_x_m, cube1_y_m, cube1_z_m, cube1_qw, cube1_qx, cube1_qy, cube1_qz, "
    "cube2_x_m, cube2_y_m, cube2_z_m, cube2_qw, cube2_qx, cube2_qy, cube2_qz, "
    "cube3_x_m, cube3_y_m, cube3_z_m, cube3_qw, cube3_qx, cube3_qy, cube3_qz";
/// Since version 2; empty on a virtual clock, and then no part of the row's digest, so that rows of
/// version 1 keep theirs.
inline constexpr std::string_view frame_timing_columns = "detected_s, simulated_s, n_dropped";
inline constexpr int n_frame_timing_columns = 3;
inline constexpr int most_cubes = 3;  ///< that a frame has columns for

/// frame_timing_columns as this file's version has them: NULLs before version 2.
std::string frame_timing_in(SQLite::Database& database);

/// INSERT INTO table(columns) VALUES (?, ?, ...)
std::string insert_sql(std::string_view table, std::string_view columns);

/// insert_sql, but a row with the same key columns takes over the new values.
std::string upsert_sql(std::string_view table, std::string_view columns, std::string_view key);

}  // namespace heft::schema
