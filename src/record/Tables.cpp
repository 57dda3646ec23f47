#include "record/Tables.h"

namespace heft::schema {

// Units are in the names; enumerations and plain impossibilities are refused by the file itself,
// so that no other program can put in what ours would not. A REAL column forgets the sign of -0.0,
// and physics makes other bits of it; what a frame gave to Drive is therefore ANY.
const char* const tables_1 = R"sql(
CREATE TABLE session (
  session_id INTEGER PRIMARY KEY,
  participant TEXT NOT NULL,
  protocol_name TEXT NOT NULL,
  protocol_text TEXT NOT NULL,
  protocol_sha256 TEXT NOT NULL,
  seed INTEGER NOT NULL CHECK (seed >= 0),
  heft_version TEXT NOT NULL,
  build TEXT NOT NULL,
  run_options TEXT NOT NULL,
  started_utc TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('running', 'paused', 'finished', 'aborted')),
  purpose TEXT NOT NULL CHECK (purpose IN ('main', 'pilot', 'test', 'simulated')),
  responder TEXT NOT NULL,
  digest TEXT NOT NULL
) STRICT;

CREATE TABLE participant_info (
  session_id INTEGER NOT NULL REFERENCES session,
  key TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (session_id, key)
) STRICT;

CREATE TABLE trial (
  trial_id INTEGER PRIMARY KEY,
  session_id INTEGER NOT NULL REFERENCES session,
  attempt_index INTEGER NOT NULL CHECK (attempt_index >= 1),
  trial_number INTEGER NOT NULL CHECK (trial_number >= 1),
  attempt INTEGER NOT NULL CHECK (attempt >= 1),
  block TEXT NOT NULL,
  task TEXT NOT NULL CHECK (task IN ('introduction', 'sorting', 'comparison')),
  condition TEXT NOT NULL CHECK (condition IN ('C1', 'C2')),
  staircase TEXT,
  reference_g REAL CHECK (reference_g > 0),
  level_g REAL,
  is_catch INTEGER NOT NULL CHECK (is_catch IN (0, 1)),
  n_reshuffles INTEGER NOT NULL CHECK (n_reshuffles >= 0),
  status TEXT NOT NULL CHECK (status IN ('completed', 'void', 'open')),
  void_reason TEXT,
  outcome TEXT CHECK (outcome IN ('correct', 'incorrect', 'dont_know', 'difference',
                                  'no_difference')),
  chosen_slot INTEGER CHECK (chosen_slot BETWEEN 1 AND 3),
  reference_slot INTEGER CHECK (reference_slot BETWEEN 1 AND 3),
  choice_correct INTEGER CHECK (choice_correct IN (0, 1)),
  started_s REAL NOT NULL CHECK (started_s >= 0),
  shown_s REAL CHECK (shown_s >= 0),
  first_contact_s REAL CHECK (first_contact_s >= 0),
  first_choice_s REAL CHECK (first_choice_s >= 0),
  validated_s REAL CHECK (validated_s >= 0),
  paused_s REAL NOT NULL CHECK (paused_s >= 0),
  lost_s REAL NOT NULL CHECK (lost_s >= 0),
  ended_s REAL CHECK (ended_s >= 0),
  UNIQUE (session_id, attempt_index),
  UNIQUE (session_id, trial_id)
) STRICT;

CREATE TABLE event (
  event_id INTEGER PRIMARY KEY,
  session_id INTEGER NOT NULL REFERENCES session,
  trial_id INTEGER,
  t_s REAL NOT NULL CHECK (t_s >= 0),
  kind TEXT NOT NULL CHECK (kind IN (
    'trial_started', 'action', 'void', 'paused', 'continued', 'cubes_reset', 'demonstration_shown',
    'resumed', 'ended', 'cubes_shown', 'cube_contact', 'effector_lost', 'effector_found', 'consent',
    'text_shown', 'break', 'note', 'deviation', 'unblinding', 'camera', 'check')),
  slot INTEGER CHECK (slot BETWEEN 1 AND 3),
  label TEXT CHECK (label IN ('lightest', 'intermediate', 'heaviest')),
  detail TEXT NOT NULL,
  value REAL,
  digest TEXT NOT NULL,
  FOREIGN KEY (session_id, trial_id) REFERENCES trial (session_id, trial_id)
) STRICT;
CREATE INDEX event_by_session ON event (session_id);

CREATE TABLE cube (
  trial_id INTEGER NOT NULL REFERENCES trial,
  slot INTEGER NOT NULL CHECK (slot BETWEEN 1 AND 3),
  mass_g REAL NOT NULL CHECK (mass_g > 0),
  n_pushes INTEGER NOT NULL CHECK (n_pushes >= 0),
  contact_s REAL NOT NULL CHECK (contact_s >= 0),
  first_contact_s REAL CHECK (first_contact_s >= 0),
  last_contact_s REAL CHECK (last_contact_s >= 0),
  PRIMARY KEY (trial_id, slot)
) STRICT;

CREATE TABLE answer (
  answer_id INTEGER PRIMARY KEY,
  trial_id INTEGER NOT NULL REFERENCES trial,
  t_s REAL NOT NULL CHECK (t_s >= 0),
  action TEXT NOT NULL CHECK (action IN ('select', 'label', 'unlabel', 'validate', 'dont_know',
                                         'no_difference')),
  slot INTEGER CHECK (slot BETWEEN 1 AND 3),
  label TEXT CHECK (label IN ('lightest', 'intermediate', 'heaviest'))
) STRICT;
CREATE INDEX answer_by_trial ON answer (trial_id);

CREATE TABLE reversal (
  session_id INTEGER NOT NULL REFERENCES session,
  staircase TEXT NOT NULL,
  number INTEGER NOT NULL CHECK (number >= 1),
  trial_id INTEGER NOT NULL,
  level_g REAL NOT NULL,
  step_before_g REAL NOT NULL,
  step_after_g REAL NOT NULL,
  PRIMARY KEY (session_id, staircase, number),
  FOREIGN KEY (session_id, trial_id) REFERENCES trial (session_id, trial_id)
) STRICT;

CREATE TABLE estimate (
  session_id INTEGER NOT NULL REFERENCES session,
  staircase TEXT NOT NULL,
  method TEXT NOT NULL,
  jnd_g REAL,
  low_g REAL,
  high_g REAL,
  n_trials INTEGER NOT NULL CHECK (n_trials >= 0),
  n_reversals INTEGER NOT NULL CHECK (n_reversals >= 0),
  n_floor INTEGER NOT NULL CHECK (n_floor >= 0),
  n_ceiling INTEGER NOT NULL CHECK (n_ceiling >= 0),
  reason TEXT NOT NULL CHECK (reason IN ('reversals', 'trials')),
  PRIMARY KEY (session_id, staircase, method)
) STRICT;

CREATE TABLE frame (
  frame_id INTEGER PRIMARY KEY,
  session_id INTEGER NOT NULL REFERENCES session,
  trial_id INTEGER,
  after_event INTEGER NOT NULL CHECK (after_event >= 0),
  t_s REAL NOT NULL CHECK (t_s >= 0),
  trial_t_s REAL NOT NULL,
  capture_s REAL NOT NULL,
  present_s REAL NOT NULL,
  tracked INTEGER NOT NULL CHECK (tracked IN (0, 1)),
  jump INTEGER NOT NULL CHECK (jump IN (0, 1)),
  contact_slot INTEGER CHECK (contact_slot BETWEEN 1 AND 3),
  quality REAL,
  state_hash TEXT NOT NULL,
  effector_x_m ANY NOT NULL, effector_y_m ANY NOT NULL, effector_z_m ANY NOT NULL,
  effector_qw ANY NOT NULL, effector_qx ANY NOT NULL, effector_qy ANY NOT NULL,
  effector_qz ANY NOT NULL, effector_vx_m_s ANY NOT NULL, effector_vy_m_s ANY NOT NULL,
  effector_vz_m_s ANY NOT NULL, effector_wx_rad_s ANY NOT NULL, effector_wy_rad_s ANY NOT NULL,
  effector_wz_rad_s ANY NOT NULL,
  clone_x_m REAL, clone_y_m REAL, clone_z_m REAL,
  clone_qw REAL, clone_qx REAL, clone_qy REAL, clone_qz REAL,
  cube1_x_m REAL, cube1_y_m REAL, cube1_z_m REAL,
  cube1_qw REAL, cube1_qx REAL, cube1_qy REAL, cube1_qz REAL,
  cube2_x_m REAL, cube2_y_m REAL, cube2_z_m REAL,
  cube2_qw REAL, cube2_qx REAL, cube2_qy REAL, cube2_qz REAL,
  cube3_x_m REAL, cube3_y_m REAL, cube3_z_m REAL,
  cube3_qw REAL, cube3_qx REAL, cube3_qy REAL, cube3_qz REAL,
  digest TEXT NOT NULL,
  CHECK (
    typeof(effector_x_m) IN ('real', 'integer') AND
    typeof(effector_y_m) IN ('real', 'integer') AND
    typeof(effector_z_m) IN ('real', 'integer') AND
    typeof(effector_qw) IN ('real', 'integer') AND
    typeof(effector_qx) IN ('real', 'integer') AND
    typeof(effector_qy) IN ('real', 'integer') AND
    typeof(effector_qz) IN ('real', 'integer') AND
    typeof(effector_vx_m_s) IN ('real', 'integer') AND
    typeof(effector_vy_m_s) IN ('real', 'integer') AND
    typeof(effector_vz_m_s) IN ('real', 'integer') AND
    typeof(effector_wx_rad_s) IN ('real', 'integer') AND
    typeof(effector_wy_rad_s) IN ('real', 'integer') AND
    typeof(effector_wz_rad_s) IN ('real', 'integer')),
  FOREIGN KEY (session_id, trial_id) REFERENCES trial (session_id, trial_id)
) STRICT;
CREATE INDEX frame_by_trial ON frame (trial_id, session_id);
)sql";

// v_trial: a row an attempt. v_jnd: a row a staircase that ended. v_sorting: a row a completed
// sorting trial, with the mass of the cube that carries each label at its end (NULL: no cube does).
const char* const views_1 = R"sql(
CREATE VIEW v_trial AS
SELECT s.session_id, s.participant, s.protocol_name, s.purpose, s.responder,
  t.trial_id, t.trial_number, t.attempt, t.block, t.task, t.condition, t.staircase,
  t.reference_g, t.level_g, t.reference_g + t.level_g AS comparison_g, t.is_catch,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 1) AS cube1_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 2) AS cube2_mass_g,
  (SELECT mass_g FROM cube c WHERE c.trial_id = t.trial_id AND c.slot = 3) AS cube3_mass_g,
  t.status, t.void_reason, t.outcome, t.chosen_slot, t.reference_slot, t.choice_correct,
  (SELECT count(*) FROM answer a WHERE a.trial_id = t.trial_id) AS n_answers,
  (SELECT sum(n_pushes) FROM cube c WHERE c.trial_id = t.trial_id) AS n_pushes,
  (SELECT sum(contact_s) FROM cube c WHERE c.trial_id = t.trial_id) AS contact_s,
  t.started_s, t.shown_s, t.first_contact_s, t.first_choice_s, t.validated_s, t.paused_s, t.lost_s,
  t.ended_s,
  t.validated_s - t.shown_s - t.paused_s - t.lost_s AS response_time_s
FROM trial t JOIN session s ON s.session_id = t.session_id;

CREATE VIEW v_jnd AS
SELECT s.session_id, s.participant, s.protocol_name, s.purpose, s.responder, e.staircase,
  (SELECT min(t.reference_g) FROM trial t
   WHERE t.session_id = e.session_id AND t.staircase = e.staircase) AS reference_g,
  e.method, e.jnd_g, e.low_g, e.high_g, e.n_trials, e.n_reversals, e.n_floor, e.n_ceiling, e.reason
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
  t.outcome, t.n_answers, t.n_pushes, t.contact_s, t.response_time_s
FROM v_trial t WHERE t.task = 'sorting' AND t.status = 'completed';
)sql";

const char* const changes_2 = R"sql(
ALTER TABLE frame ADD COLUMN detected_s REAL;
ALTER TABLE frame ADD COLUMN simulated_s REAL;
ALTER TABLE frame ADD COLUMN n_dropped INTEGER CHECK (n_dropped >= 0);
)sql";

}  // namespace heft::schema
