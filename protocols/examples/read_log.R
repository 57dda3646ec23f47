# Reads a log in R, with the packages DBI and RSQLite (Debian: r-cran-rsqlite).
#
#     Rscript read_log.R lab.db
#
# src/record/README.md describes the tables. `heft replay --db lab.db` checks that it is unchanged.

log_file <- commandArgs(trailingOnly = TRUE)[1]
if (is.na(log_file) || !file.exists(log_file)) stop("expected a log: Rscript read_log.R lab.db")

# Read only, and a session may be running. SQLite may leave empty files -shm and -wal beside the log.
log <- DBI::dbConnect(RSQLite::SQLite(), log_file, flags = RSQLite::SQLITE_RO)
cat("Tables and views:", DBI::dbListTables(log), "\n\n")

# One row is one attempt at a trial. Units are in the names: level_g, response_time_s.
# Flags are 0 and 1. Void attempts have status "void", and practice does not count.
trials <- DBI::dbGetQuery(log, "SELECT * FROM v_trial WHERE status = 'completed' AND NOT is_practice")
cat(nrow(trials), "completed trials. Mean response time in s:\n")
print(aggregate(response_time_s ~ participant + condition, trials, mean))

# The levels of each staircase, trial by trial.
staircases <- trials[!is.na(trials$staircase), ]
levels <- split(staircases$level_g, paste(staircases$participant, staircases$staircase), drop = TRUE)
cat("\nLevels in g:\n")
str(levels, vec.len = 8)

# Estimates. censored: "below": the JND is at most this value, "above": at least.
jnds <- DBI::dbGetQuery(log, "SELECT * FROM v_jnd ORDER BY participant, reference_g")
cat("\nJNDs in g:\n")
print(jnds[, c("participant", "reference_g", "staircase", "method", "jnd_g", "censored")])

DBI::dbDisconnect(log)
