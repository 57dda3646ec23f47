// analysis.R, which goes along with an export: the figures of `heft analyse` computed anew from the
// files alone, and the mixed models that stay in R.
#include "record/ExportFolder.h"

namespace heft {

const char* const analysis_script =
    R"R(# Reads an export of heft and prints its main figures and models; the same goes to analysis.txt, and
# the figures to figures.csv. Run it in its folder: Rscript analysis.R
# Mixed models need lme4 and ordinal (Debian: r-cran-lme4, r-cran-ordinal); the rest is base R.
# Nobody is left out: rules of the protocol's [exclusion] are not applied here.

# The tables ---------------------------------------------------------------------------------------

read_table <- function(name) {
  places <- c(paste0(name, ".csv"), sprintf("data/description-%s_data.csv", name),
              sprintf("../data/description-%s_data.csv", name))
  place <- places[file.exists(places)][1]
  if (is.na(place)) stop("no ", name, ".csv here: run this script in the folder of an export")
  table <- read.csv(place, check.names = FALSE, stringsAsFactors = FALSE, na.strings = "",
                    encoding = "UTF-8")
  texts <- vapply(table, is.character, TRUE)
  table[texts] <- lapply(table[texts], function(text) sub("^'", "", text))
  table
}

trials <- read_table("trials")
choices <- read_table("choices")
estimates <- read_table("estimates")
reversals <- read_table("reversals")
setups <- read_table("setups")

# A model of another kind that answers under the same name is another participant.
key <- function(table) paste(table$log, table$session_id)
answered <- setups[paste(key(setups), setups$setup_id) %in% paste(key(trials), trials$setup_id), ]
models <- answered[answered$responder != "human", ]
models <- models[!duplicated(key(models)), ]
person_of <- function(table) {
  model <- models$responder[match(key(table), key(models))]
  ifelse(is.na(model), as.character(table$person), paste0(table$person, " (", model, ")"))
}
trials$person <- person_of(trials)
choices$person <- person_of(choices)
estimates$person <- person_of(estimates)
completed <- trials[trials$status == "completed", ]

figures <- data.frame()
tell <- function(figure, condition, reference_g, value) {
  figures[nrow(figures) + 1, c("figure", "condition", "reference_g", "value")] <<-
    list(figure, condition, reference_g, value)
}
number <- function(value) ifelse(is.na(value), "-", formatC(value, digits = 10, format = "g"))
heading <- function(text) cat("\n", text, "\n", strrep("-", nchar(text)), "\n", sep = "")

# E1: sorting --------------------------------------------------------------------------------------

shares <- function(condition, name, outcome, of) {
  sorted <- completed[completed$task == "sorting" & completed$condition == condition &
                      completed$outcome %in% of, ]
  if (nrow(sorted) == 0) return(invisible())
  percent <- 100 * tapply(sorted$outcome == outcome, sorted$person, mean)
  cat(sprintf("%s %-18s mean %s %%, SD %s, %d of %d trials of %d people\n", condition, name,
              number(mean(percent)), number(sd(percent)), sum(sorted$outcome == outcome),
              nrow(sorted), length(percent)))
  tell(paste0("sorting.", name, ".mean"), condition, NA, mean(percent))
  tell(paste0("sorting.", name, ".sd"), condition, NA, sd(percent))
  tell(paste0("sorting.", name, ".n_hits"), condition, NA, sum(sorted$outcome == outcome))
  tell(paste0("sorting.", name, ".n_trials"), condition, NA, nrow(sorted))
  tell(paste0("sorting.", name, ".n_participants"), condition, NA, length(percent))
}

sorting_model <- function() {
  sorted <- completed[completed$task == "sorting" & !is.na(completed$outcome), ]
  sorted$correct <- as.integer(sorted$outcome == "correct")
  sorted$condition <- factor(sorted$condition)
  if (nlevels(sorted$condition) < 2) return(cat("One condition only: nothing to compare.\n"))
  if (!requireNamespace("lme4", quietly = TRUE)) return(cat("lme4 is not installed: no model.\n"))
  fit <- function(formula)
    suppressMessages(lme4::glmer(formula, sorted, family = binomial,
                                 control = lme4::glmerControl(optimizer = "bobyqa")))
  model <- tryCatch(fit(correct ~ condition + (1 + condition | person)), error = identity)
  if (inherits(model, "error") || lme4::isSingular(model)) {
    cat("People's differences between conditions can't be told from their levels: the model has\n",
        "their levels only.\n", sep = "")
    model <- tryCatch(fit(correct ~ condition + (1 | person)), error = identity)
  }
  if (inherits(model, "error")) return(cat("No model:", conditionMessage(model), "\n"))
  all_alike <- tapply(sorted$correct, sorted$condition, function(correct) all(correct == correct[1]))
  if (any(all_alike))
    cat("All trials of ", paste(names(all_alike)[all_alike], collapse = ", "), " ended alike: its ",
        "coefficient has no finite estimate, and its SE says nothing.\n", sep = "")
  print(summary(model), correlation = FALSE)
}

# The paper's JND: reversals of staircases ---------------------------------------------------------

# As heft has it: what a bound, the trial limit or fewer than four reversals cut is known to lie
# above or below what it gives, or not at all.
staircase_results <- function() {
  rows <- estimates[estimates$method == "mean_of_reversals", ]
  rows$censored[is.na(rows$censored)] <- "none"
  with_staircase <- completed[completed$task == "comparison" & !is.na(completed$staircase) &
                              !is.na(completed$level_g), ]
  courses <- split(with_staircase, paste(key(with_staircase), with_staircase$staircase))
  for (i in seq_len(nrow(rows))) {
    course <- courses[[paste(key(rows[i, ]), rows$staircase[i])]]
    levels <- course$level_g
    rows$reference_g[i] <- course$reference_g[1]
    rows$condition[i] <- course$condition[1]
    rows$start_g[i] <- levels[1]
    cut <- rows$censored[i] != "none" || rows$n_reversals[i] < 4 || rows$reason[i] == "trials"
    way <- rows$censored[i]
    if (cut && way %in% c("none", "unsettled")) {
      at_ceiling <- rows$n_ceiling[i] > 0
      at_floor <- rows$n_floor[i] > 0
      last <- levels[length(levels)]
      way <- if (at_ceiling != at_floor) { if (at_ceiling) "above" else "below" }
             else if (at_ceiling || last == levels[1]) "unsettled"
             else if (last > levels[1]) "above" else "below"
    }
    rows$way[i] <- way
    rows$shown_g[i] <- if (way == "unsettled") NA
                       else if (!is.na(rows$jnd_g[i])) rows$jnd_g[i]
                       else if (way == "above") max(levels) else if (way == "below") min(levels)
                       else NA
  }
  rows
}

# The mean of figures, one NA, or of opposite directions: nothing is known.
mean_figure <- function(values, ways) {
  known <- unique(ways[ways != "none"])
  if (length(values) == 0 || anyNA(values) || length(known) > 1) return(list(value = NA, way = NA))
  list(value = mean(values), way = if (length(known) == 1) known else "none")
}

# Exact where nothing is cut; otherwise by maximum likelihood, where more than half is exact (Tobit).
censored_mean <- function(values, ways, n_missing) {
  exact <- values[ways == "none"]
  if (2 * length(exact) <= length(values) + n_missing) return(NA)
  if (length(exact) == length(values)) return(mean(values))
  if (length(exact) < 2 || sd(exact) == 0) return(NA)
  center <- mean(exact); scale <- sd(exact)
  z <- (values - center) / scale
  loss <- function(p) {
    sigma <- exp(p[2])
    -sum(ifelse(ways == "none", dnorm(z, p[1], sigma, log = TRUE),
         ifelse(ways == "above", pnorm(z, p[1], sigma, lower.tail = FALSE, log.p = TRUE),
                pnorm(z, p[1], sigma, log.p = TRUE))))
  }
  best <- optim(c(0, 0), loss, method = "BFGS", control = list(reltol = 1e-14, maxit = 1000))
  center + scale * best$par[1]
}

jnds <- function() {
  results <- staircase_results()
  began <- unique(trials[trials$task == "comparison" & !is.na(trials$staircase),
                         c("log", "session_id", "person", "staircase", "reference_g", "condition")])
  began <- began[!duplicated(paste(key(began), began$staircase)), ]
  for (condition in sort(unique(began$condition)))
    for (reference in sort(unique(began$reference_g[began$condition == condition]))) {
      here <- began[began$condition == condition & began$reference_g == reference, ]
      people <- lapply(split(here, here$person), function(theirs) {
        sessions <- lapply(split(theirs, key(theirs)), function(session) {
          found <- results[match(paste(key(session), session$staircase),
                                 paste(key(results), results$staircase)), ]
          mean_figure(found$shown_g, found$way)
        })
        told <- Filter(function(one) !is.na(one$value), sessions)
        mean_figure(vapply(told, function(one) one$value, 0), vapply(told, function(one) one$way, ""))
      })
      tell_jnds(people, "jnd", "all staircases", condition, reference)
      for (side in c("from_above", "from_below")) {
        of_side <- by_start(here, results, side)
        if (any(vapply(of_side, function(one) !is.na(one$value), NA)))
          tell_jnds(of_side, paste0("jnd.", side), sub("_", " ", side), condition, reference)
      }
    }
}

tell_jnds <- function(people, figure, staircases, condition, reference) {
  value <- vapply(people, function(one) as.numeric(one$value), 0)
  way <- vapply(people, function(one) as.character(one$way), "")
  n_missing <- sum(is.na(value))
  mean_g <- censored_mean(value[!is.na(value)], way[!is.na(value)], n_missing)
  cat(sprintf("%s %g g, %s: mean %s g; %d people, %d above, %d below, %d unknown\n", condition,
              reference, staircases, number(mean_g), length(value),
              sum(way == "above", na.rm = TRUE), sum(way == "below", na.rm = TRUE), n_missing))
  tell(paste0(figure, ".mean_g"), condition, reference, mean_g)
  tell(paste0(figure, ".n"), condition, reference, length(value))
  tell(paste0(figure, ".n_censored_above"), condition, reference, sum(way == "above", na.rm = TRUE))
  tell(paste0(figure, ".n_censored_below"), condition, reference, sum(way == "below", na.rm = TRUE))
  tell(paste0(figure, ".n_missing"), condition, reference, n_missing)
}

# Of sessions whose staircases began high and low: those on one side of the middle between.
by_start <- function(here, results, side) {
  lapply(split(here, here$person), function(theirs) {
    own <- do.call(rbind, lapply(split(theirs, key(theirs)), function(session) {
      found <- results[paste(key(results), results$staircase) %in%
                       paste(key(session), session$staircase), ]
      if (length(unique(found$start_g)) < 2) return(found[0, ])
      found[(found$start_g > mean(range(found$start_g))) == (side == "from_above"), ]
    }))
    mean_figure(own$shown_g, own$way)
  })
}

# Sensitivity: comparison, none or reference -------------------------------------------------------

# D = s x + b + N(0, 1): comparison where D > t, reference where D < -t. All trials together, as
# `heft fit choices.csv --model indecision --by compared` has it; intervals need the mixed model.
indecision_fits <- function() {
  if (!requireNamespace("ordinal", quietly = TRUE)) return(cat("ordinal is not installed: no fit.\n"))
  for (compared in unique(choices$compared)) {
    here <- choices[choices$compared == compared, ]
    condition <- here$condition[1]
    reference <- here$reference_g[1]
    here$answer <- factor(here$answer, c("reference", "none", "comparison"), ordered = TRUE)
    if (any(table(here$answer) == 0) || length(unique(here$level_g)) < 2) {
      cat(compared, ": not all answers or too few levels, no fit\n", sep = "")
      next
    }
    unit <- max(abs(here$level_g))
    here$x <- here$level_g / unit
    fit <- tryCatch(ordinal::clm(answer ~ x, data = here, link = "probit",
                                 control = list(gradTol = 1e-8, maxIter = 200)), error = identity)
    if (inherits(fit, "error")) {
      cat(compared, ": ", conditionMessage(fit), "\n", sep = "")
      next
    }
    theta <- fit$alpha
    s <- unname(fit$beta) / unit
    cat(sprintf("%s: sensitivity %s per g, indecision %s, bias %s, log likelihood %s, %d trials\n",
                compared, number(s), number((theta[[2]] - theta[[1]]) / 2),
                number(-(theta[[1]] + theta[[2]]) / 2), number(as.numeric(logLik(fit))),
                nrow(here)))
    tell("indecision.sensitivity", condition, reference, s)
    tell("indecision.indecision", condition, reference, (theta[[2]] - theta[[1]]) / 2)
    tell("indecision.bias", condition, reference, -(theta[[1]] + theta[[2]]) / 2)
    tell("indecision.log_likelihood", condition, reference, as.numeric(logLik(fit)))
    mixed_fit(here, compared, unit)
  }
}

# Each person's own sensitivity.
mixed_fit <- function(here, compared, unit) {
  here$person <- factor(here$person)
  if (nlevels(here$person) < 5 || nlevels(here$person) > 100) return(invisible())
  fit <- tryCatch(suppressWarnings(ordinal::clmm(answer ~ x + (0 + x | person), data = here,
                                                 link = "probit", threshold = "symmetric")),
                  error = identity)
  if (inherits(fit, "error")) return(cat("  mixed:", conditionMessage(fit), "\n"))
  at <- tryCatch(coef(summary(fit))["x", ], error = function(e) c(fit$beta[["x"]], NA, NA, NA))
  cat(sprintf("  mixed: sensitivity %s per g (SE %s), SD between people %s\n", number(at[1] / unit),
              number(at[2] / unit), number(sqrt(unlist(fit$ST)[1]^2) / unit)))
}

# --------------------------------------------------------------------------------------------------

sink("analysis.txt", split = TRUE)
cat("heft export:", length(unique(trials$person)), "participants,", nrow(completed),
    "completed trials of", nrow(trials), "\n")
if (any(!is.na(models$responder))) cat("SIMULATED: a model answered", nrow(models), "sessions.\n")
heading("E1, sorting: shares of people's trials")
for (condition in sort(unique(completed$condition[completed$task == "sorting"]))) {
  all <- c("correct", "incorrect", "dont_know")
  shares(condition, "correct", "correct", all)
  shares(condition, "incorrect", "incorrect", all)
  shares(condition, "none", "dont_know", all)
  shares(condition, "answered.correct", "correct", all[1:2])
}
heading("E1, sorting: mixed logistic regression of correct on condition")
sorting_model()
heading("E2: the paper's JND, by condition and reference (it moves with the criterion)")
jnds()
heading("E2: choices with indecision, by condition and reference")
indecision_fits()
sink()
write.csv(format(figures, digits = 15, trim = TRUE), "figures.csv", row.names = FALSE, quote = FALSE)
)R";

}  // namespace heft
