#include <fmt/format.h>

#include "record/schema/EventRow.h"
#include "record/schema/RowSql.h"
#include "record/schema/Schema.h"

namespace heft::schema {

namespace {

// A table of a row type: ids, the row's columns, and constraints between rows.
template <typename Row>
std::string table(std::string_view name, std::string_view ids, std::string_view rules) {
  return fmt::format("CREATE TABLE {} (\n  {},\n  {}{}\n) STRICT;\n", name, ids,
                     fmt::join(sql_of<Row>().declarations, ",\n  "), rules);
}

std::string list_tables() {
  std::string sql;
  for (const ClosedList& list : closed_lists())
    sql += fmt::format("CREATE TABLE {} (name TEXT PRIMARY KEY) STRICT;\n", list.table);
  for (const std::string_view list : word_lists)
    sql += fmt::format(
        "CREATE TABLE {} (name TEXT PRIMARY KEY, task TEXT NOT NULL, edition INTEGER NOT NULL) "
        "STRICT;\n",
        list);
  return sql;
}

constexpr auto of_session = "session_id INTEGER NOT NULL REFERENCES session";
constexpr auto of_session_and_trial =
    ",\n  FOREIGN KEY (session_id, trial_id) REFERENCES trial (session_id, trial_id)";

}  // namespace

std::string tables() {
  return list_tables() +
         table<SessionHeader>("session", "session_id INTEGER PRIMARY KEY",
                              ",\n  state TEXT NOT NULL REFERENCES list_state"
                              ",\n  n_events INTEGER NOT NULL DEFAULT 0"
                              ",\n  n_frames INTEGER NOT NULL DEFAULT 0"
                              ",\n  info_digest TEXT NOT NULL DEFAULT ''"
                              ",\n  digest TEXT NOT NULL") +
         fmt::format(
             "CREATE TABLE participant_info (\n  {},\n  key TEXT NOT NULL,\n  value TEXT NOT "
             "NULL,\n  PRIMARY KEY (session_id, key)\n) STRICT;\n",
             of_session) +
         table<SessionConfig>(
             "setup",
             fmt::format("setup_id INTEGER PRIMARY KEY,\n  {},\n  setup_index INTEGER NOT "
                         "NULL CHECK (setup_index >= 1),\n  from_event_id INTEGER",
                         of_session),
             ",\n  UNIQUE (session_id, setup_index)") +
         table<TrialRow>("trial",
                         fmt::format("trial_id INTEGER PRIMARY KEY,\n  {},\n  setup_id INTEGER "
                                     "REFERENCES setup",
                                     of_session),
                         ",\n  UNIQUE (session_id, attempt_index)"
                         ",\n  UNIQUE (session_id, trial_id)") +
         table<EventRow>(
             "event",
             fmt::format("event_id INTEGER PRIMARY KEY,\n  {},\n  trial_id INTEGER", of_session),
             std::string(",\n  digest TEXT NOT NULL") + of_session_and_trial) +
         "CREATE INDEX event_by_session ON event (session_id);\n" +
         table<CubeRow>("cube", "trial_id INTEGER NOT NULL REFERENCES trial",
                        ",\n  PRIMARY KEY (trial_id, slot)") +
         table<AnswerRow>("answer",
                          "answer_id INTEGER PRIMARY KEY,\n  trial_id INTEGER NOT NULL REFERENCES "
                          "trial",
                          "") +
         "CREATE INDEX answer_by_trial ON answer (trial_id);\n" +
         table<ReversalRow>("reversal", fmt::format("{},\n  trial_id INTEGER NOT NULL", of_session),
                            std::string(",\n  PRIMARY KEY (session_id, staircase, number)") +
                                of_session_and_trial) +
         table<EstimateRow>("estimate", of_session,
                            ",\n  PRIMARY KEY (session_id, staircase, method)") +
         table<ParticipantParameterRow>(
             "participant_parameter",
             fmt::format("{},\n  setup_id INTEGER NOT NULL REFERENCES setup", of_session),
             ",\n  PRIMARY KEY (session_id, setup_id, name)") +
         table<FrameRow>(
             "frame",
             fmt::format("frame_id INTEGER PRIMARY KEY,\n  {},\n  trial_id INTEGER", of_session),
             std::string(",\n  digest TEXT NOT NULL") + of_session_and_trial) +
         "CREATE INDEX frame_by_trial ON frame (trial_id, session_id);\n"
         "CREATE TABLE seal (\n  seal_id INTEGER PRIMARY KEY,\n  session_id INTEGER NOT NULL,\n  "
         "state TEXT NOT NULL REFERENCES list_state,\n  n_events INTEGER NOT NULL,\n  n_frames "
         "INTEGER NOT NULL,\n  info_digest TEXT NOT NULL,\n  digest TEXT NOT NULL,\n  head TEXT "
         "NOT NULL\n) STRICT;\n"
         "CREATE INDEX seal_by_session ON seal (session_id);\n";
}

// v_trial: attempts with their configuration. v_jnd: estimates of stopped staircases. v_sorting:
// completed sorting trials with the mass of the cube that has each label at the end (NULL: none).
// v_frame: displayed distance between clone and effector, in degrees of visual angle if the display
// was measured (small-angle approximation); v_trial has its maximum over a trial's frames. And the
// turn of the clone against the effector about the effector's z axis, counterclockwise from above
// for one that is held level.
const std::string views = std::string(R"sql(
CREATE VIEW v_trial AS
SELECT s.session_id, s.participant, s.protocol_name, s.purpose, u.responder, u.simulator,
  u.rate_hz, u.display_rate_hz, u.tracker, u.view, t.setup_id, t.trial_id, t.trial_number, t.attempt, t.block, t.task, t.condition, t.staircase,
  t.reference_g, t.level_g, t.reference_g + t.level_g AS comparison_g, t.is_catch, t.is_practice,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 1) AS cube1_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 2) AS cube2_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 3) AS cube3_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 4) AS cube4_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 5) AS cube5_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 6) AS cube6_mass_g,
  t.status, t.void_reason, t.outcome, t.chosen_slot, t.reference_slot, t.choice_correct, t.value,
  (SELECT count(*) FROM answer a WHERE a.trial_id = t.trial_id) AS n_answers,
  (SELECT sum(n_pushes) FROM cube c WHERE c.trial_id = t.trial_id) AS n_pushes,
  (SELECT sum(contact_s) FROM cube c WHERE c.trial_id = t.trial_id) AS contact_s,
  (SELECT max(max_push_displacement_m) FROM cube c WHERE c.trial_id = t.trial_id) AS max_push_displacement_m,
  (SELECT max(peak_lag_m) FROM cube c WHERE c.trial_id = t.trial_id) AS peak_lag_m,
  (SELECT max(clone_offset_px) FROM frame f WHERE f.trial_id = t.trial_id)
    * u.display_w_mm / u.display_w_px / u.eye_distance_mm * 57.29577951308232
    AS peak_clone_offset_deg,
  t.started_s, t.shown_s, t.first_contact_s, t.first_choice_s, t.validated_s, t.paused_s, t.lost_s,
  t.ended_s,
  t.validated_s - t.shown_s - t.paused_s - t.lost_s AS response_time_s
FROM trial t JOIN session s ON s.session_id = t.session_id
LEFT JOIN setup u ON u.setup_id = t.setup_id;

CREATE VIEW v_jnd AS
SELECT s.session_id, s.participant, s.protocol_name, s.purpose,
  (SELECT group_concat(DISTINCT t.responder) FROM v_trial t
   WHERE t.session_id = e.session_id AND t.staircase = e.staircase) AS responder, e.staircase,
  (SELECT min(t.reference_g) FROM trial t
   WHERE t.session_id = e.session_id AND t.staircase = e.staircase) AS reference_g,
  e.method, e.jnd_g, e.low_g, e.high_g, e.n_trials, e.n_reversals, e.n_floor, e.n_ceiling, e.reason, e.censored
FROM estimate e JOIN session s ON s.session_id = e.session_id;

CREATE VIEW v_sorting AS
WITH final_label AS (
  SELECT a.trial_id, a.slot, a.label FROM answer a
  WHERE a.action = 'label' AND NOT EXISTS (
    SELECT 1 FROM answer later
    WHERE later.trial_id = a.trial_id AND later.answer_id > a.answer_id
      AND later.action IN ('label', 'unlabel')
      AND (later.slot = a.slot OR later.label = a.label)))
SELECT t.session_id, t.participant, t.protocol_name, t.purpose, t.responder,
  t.trial_id, t.trial_number, t.attempt, t.block, t.condition,
  t.cube1_mass_g, t.cube2_mass_g, t.cube3_mass_g,
  (SELECT c.mass_g FROM final_label l JOIN cube c ON c.trial_id = l.trial_id AND c.slot = l.slot
   WHERE l.trial_id = t.trial_id AND l.label = 'lightest') AS labeled_lightest_g,
  (SELECT c.mass_g FROM final_label l JOIN cube c ON c.trial_id = l.trial_id AND c.slot = l.slot
   WHERE l.trial_id = t.trial_id AND l.label = 'intermediate') AS labeled_intermediate_g,
  (SELECT c.mass_g FROM final_label l JOIN cube c ON c.trial_id = l.trial_id AND c.slot = l.slot
   WHERE l.trial_id = t.trial_id AND l.label = 'heaviest') AS labeled_heaviest_g,
  t.outcome, t.is_practice, t.n_answers, t.n_pushes, t.contact_s, t.max_push_displacement_m, t.peak_lag_m,
  t.response_time_s
FROM v_trial t WHERE t.task = 'sorting' AND t.status = 'completed';

CREATE VIEW v_frame AS
SELECT f.frame_id, f.session_id, f.trial_id, t.trial_number, t.attempt, t.task, t.condition,
  f.t_s, f.trial_t_s, f.present_s, f.tracked, f.contact_slot, f.clone_offset_px,
  f.clone_offset_px * u.display_w_mm / u.display_w_px AS clone_offset_mm,
  f.clone_offset_px * u.display_w_mm / u.display_w_px / u.eye_distance_mm * 57.29577951308232
    AS clone_offset_deg,
)sql") + clone_yaw_deg_sql +
                          R"sql( AS clone_yaw_deg
FROM frame f LEFT JOIN trial t ON t.trial_id = f.trial_id
LEFT JOIN setup u ON u.setup_id = t.setup_id;
)sql";

}  // namespace heft::schema
