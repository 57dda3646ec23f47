# Reads an export of heft and prints the main results and models for every task and condition. Writes
# the text to analysis.txt and the results to figures.csv.
# Run it in its folder: Rscript analysis.R
# Mixed models need lme4 and ordinal (Debian: r-cran-lme4, r-cran-ordinal); the rest is base R.
# All participants are included; the protocol's [exclusion] rules are not applied.

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
cubes <- read_table("cubes")
setups <- read_table("setups")

# Different models under the same name are different participants.
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
if ("unverified" %in% names(trials)) message("NOT VERIFIED: it was not checked whether the log was changed")
completed <- trials[trials$status == "completed" & trials$is_practice == 0, ]

figures <- data.frame()
record <- function(figure, condition, reference_g, value) {
  figures[nrow(figures) + 1, c("figure", "condition", "reference_g", "value")] <<-
    list(figure, condition, reference_g, value)
}
number <- function(value) ifelse(is.na(value), "-", formatC(value, digits = 10, format = "g"))
heading <- function(text) cat("\n", text, "\n", strrep("-", nchar(text)), "\n", sep = "")

# Outcomes -----------------------------------------------------------------------------------------

# Percentage of trials with an outcome among those with an outcome in `of`; mean and SD over
# participants.
share <- function(rows, task, condition, name, outcome, of) {
  rows <- rows[rows$outcome %in% of, ]
  if (nrow(rows) == 0) return(invisible())
  percent <- 100 * tapply(rows$outcome == outcome, rows$person, mean)
  cat(sprintf("%s %s %-18s mean %s %%, SD %s, %d of %d trials of %d people\n", task, condition, name,
              number(mean(percent)), number(sd(percent)), sum(rows$outcome == outcome), nrow(rows),
              length(percent)))
  figure <- paste(task, name, sep = ".")
  record(paste0(figure, ".mean"), condition, NA, mean(percent))
  record(paste0(figure, ".sd"), condition, NA, sd(percent))
  record(paste0(figure, ".n_hits"), condition, NA, sum(rows$outcome == outcome))
  record(paste0(figure, ".n_trials"), condition, NA, nrow(rows))
  record(paste0(figure, ".n_participants"), condition, NA, length(percent))
}

shares <- function(task) {
  of_task <- completed[completed$task == task & !is.na(completed$outcome), ]
  outcomes <- unique(of_task$outcome)
  scored <- c("correct", "incorrect")
  if (length(outcomes) > 1 && any(scored %in% outcomes)) outcomes <- union(scored, outcomes)
  for (condition in sort(unique(of_task$condition))) {
    rows <- of_task[of_task$condition == condition, ]
    for (outcome in outcomes)
      share(rows, task, condition, sub("dont_know", "none", outcome), outcome, outcomes)
    if (length(setdiff(outcomes, scored)) > 0 && "correct" %in% outcomes)
      share(rows, task, condition, "answered.correct", "correct", scored)
  }
}

# Mixed logistic regression of correct on condition.
correctness_model <- function(task) {
  rows <- completed[completed$task == task & !is.na(completed$outcome), ]
  rows$correct <- as.integer(rows$outcome == "correct")
  rows$condition <- factor(rows$condition)
  if (nlevels(rows$condition) < 2) return(cat("One condition only: nothing to compare.\n"))
  if (!requireNamespace("lme4", quietly = TRUE)) return(cat("lme4 is not installed: no model.\n"))
  fit <- function(formula)
    suppressMessages(lme4::glmer(formula, rows, family = binomial,
                                 control = lme4::glmerControl(optimizer = "bobyqa")))
  model <- tryCatch(fit(correct ~ condition + (1 + condition | person)), error = identity)
  if (inherits(model, "error") || lme4::isSingular(model)) {
    cat("Random slopes are not identifiable; the model has random intercepts only.\n", sep = "")
    model <- tryCatch(fit(correct ~ condition + (1 | person)), error = identity)
  }
  if (inherits(model, "error")) return(cat("No model:", conditionMessage(model), "\n"))
  all_equal <- tapply(rows$correct, rows$condition, function(correct) all(correct == correct[1]))
  if (any(all_equal))
    cat("All trials of ", paste(names(all_equal)[all_equal], collapse = ", "), " had one outcome: ",
        "its coefficient has no finite estimate, and its SE has no meaning.\n", sep = "")
  print(summary(model), correlation = FALSE)
}

# Numbers given to single cubes --------------------------------------------------------------------

# Means over participants of their means; geometric means exclude values of 0.
numbers <- function(rows, task) {
  n_cubes <- table(paste(cubes$log, cubes$trial_id))
  trial <- paste(rows$log, rows$trial_id)
  rows <- rows[n_cubes[trial] == 1, ]
  shown <- cubes[match(paste(rows$log, rows$trial_id), paste(cubes$log, cubes$trial_id)), ]
  own <- !is.na(shown$table_friction)
  rows$cube <- paste0(sprintf("%g_g", shown$mass_g),
                      ifelse(own, sprintf("_friction_%g", shown$table_friction), ""))
  rows <- rows[order(shown$mass_g, shown$table_friction), ]
  mean_of_people <- function(rows, values) mean(tapply(values, rows$person, mean))
  for (condition in sort(unique(rows$condition)))
    for (cube in unique(rows$cube[rows$condition == condition])) {
      here <- rows[rows$condition == condition & rows$cube == cube, ]
      above_0 <- here[here$value > 0, ]
      arithmetic <- mean_of_people(here, here$value)
      geometric <- exp(mean_of_people(above_0, log(above_0$value)))
      cat(sprintf("%s %s %s: mean %s, geometric mean %s; %d trials of %d people\n", task, condition,
                  gsub("_", " ", cube), number(arithmetic), number(geometric), nrow(here),
                  length(unique(here$person))))
      record(sprintf("%s.mean.%s", task, cube), condition, NA, arithmetic)
      record(sprintf("%s.geometric_mean.%s", task, cube), condition, NA, geometric)
    }
}

# The paper's JND: reversals of staircases ---------------------------------------------------------

# As in heft: an estimate that is censored by a bound, the trial limit or fewer than four reversals is
# an upper or lower limit, or unknown.
staircase_results <- function() {
  rows <- estimates[estimates$method == "mean_of_reversals", ]
  rows$censored[is.na(rows$censored)] <- "none"
  with_staircase <- completed[!is.na(completed$staircase) & !is.na(completed$level_g), ]
  courses <- split(with_staircase, paste(key(with_staircase), with_staircase$staircase))
  for (i in seq_len(nrow(rows))) {
    course <- courses[[paste(key(rows[i, ]), rows$staircase[i])]]
    levels <- course$level_g
    rows$reference_g[i] <- course$reference_g[1]
    rows$condition[i] <- course$condition[1]
    rows$start_g[i] <- levels[1]
    cut <- rows$censored[i] != "none" || rows$n_reversals[i] < 4 || rows$reason[i] == "trials"
    direction <- rows$censored[i]
    if (cut && direction %in% c("none", "indeterminate")) {
      at_ceiling <- rows$n_ceiling[i] > 0
      at_floor <- rows$n_floor[i] > 0
      last <- levels[length(levels)]
      direction <- if (at_ceiling != at_floor) { if (at_ceiling) "above" else "below" }
                   else if (at_ceiling || last == levels[1]) "indeterminate"
                   else if (last > levels[1]) "above" else "below"
    }
    rows$direction[i] <- direction
    rows$shown_g[i] <- if (direction == "indeterminate") NA
                       else if (!is.na(rows$jnd_g[i])) rows$jnd_g[i]
                       else if (direction == "above") max(levels)
                       else if (direction == "below") min(levels)
                       else NA
  }
  rows
}

# Mean of estimates; unknown if one is NA or censoring directions are opposite.
mean_estimate <- function(values, directions) {
  censored <- unique(directions[directions != "none"])
  if (length(values) == 0 || anyNA(values) || length(censored) > 1)
    return(list(value = NA, direction = NA))
  list(value = mean(values), direction = if (length(censored) == 1) censored else "none")
}

known_mean <- function(values) if (all(is.na(values))) NA_real_ else mean(values, na.rm = TRUE)

# Mean of a log-normal distribution by maximum likelihood if more than half of the values are exact. A
# value of 0 is below the smallest positive one. With fewer than three exact values: arithmetic mean
# if none is censored.
censored_mean <- function(values, directions, n_missing) {
  n <- length(values) + n_missing
  if (2 * sum(directions == "none") <= n) return(NA)
  plain <- if (all(directions == "none")) mean(values) else NA
  zero <- values <= 0
  if (all(zero)) return(plain)
  known <- !(zero & directions == "above")
  directions[zero] <- "below"
  values[zero] <- min(values[!zero])
  y <- log(values[known]); directions <- directions[known]
  exact <- y[directions == "none"]
  if (length(exact) < 3 || 2 * length(exact) <= n || sd(exact) == 0) return(plain)
  center <- mean(exact); scale <- sd(exact)
  z <- (y - center) / scale
  loss <- function(p) {
    sigma <- exp(p[2])
    -sum(ifelse(directions == "none", dnorm(z, p[1], sigma, log = TRUE),
         ifelse(directions == "above", pnorm(z, p[1], sigma, lower.tail = FALSE, log.p = TRUE),
                pnorm(z, p[1], sigma, log.p = TRUE))))
  }
  best <- optim(c(0, 0), loss, method = "BFGS", control = list(reltol = 1e-14, maxit = 1000))
  exp(center + scale * best$par[1] + (scale * exp(best$par[2]))^2 / 2)
}

jnds <- function() {
  results <- staircase_results()
  began <- unique(trials[!is.na(trials$staircase),
                         c("log", "session_id", "person", "staircase", "reference_g", "condition")])
  began <- began[!duplicated(paste(key(began), began$staircase)), ]
  for (condition in sort(unique(began$condition)))
    for (reference in sort(unique(began$reference_g[began$condition == condition]))) {
      here <- began[began$condition == condition & began$reference_g == reference, ]
      people <- lapply(split(here, here$person), function(theirs) {
        sessions <- lapply(split(theirs, key(theirs)), function(session) {
          found <- results[match(paste(key(session), session$staircase),
                                 paste(key(results), results$staircase)), ]
          c(mean_estimate(found$shown_g, found$direction), as_logged = mean(found$jnd_g))
        })
        known <- Filter(function(one) !is.na(one$value), sessions)
        c(mean_estimate(vapply(known, function(one) one$value, 0),
                        vapply(known, function(one) one$direction, "")),
          as_logged = known_mean(vapply(sessions, function(one) one$as_logged, 0)))
      })
      report_jnds(people, "jnd", "all staircases", condition, reference)
      for (side in c("from_above", "from_below")) {
        of_side <- by_start(here, results, side)
        if (any(vapply(of_side, function(one) !is.na(one$value), NA)))
          report_jnds(of_side, paste0("jnd.", side), sub("_", " ", side), condition, reference)
      }
    }
}

report_jnds <- function(people, figure, staircases, condition, reference) {
  value <- vapply(people, function(one) as.numeric(one$value), 0)
  direction <- vapply(people, function(one) as.character(one$direction), "")
  n_missing <- sum(is.na(value))
  n_above <- sum(direction == "above", na.rm = TRUE)
  n_below <- sum(direction == "below", na.rm = TRUE)
  mean_g <- censored_mean(value[!is.na(value)], direction[!is.na(value)], n_missing)
  paper_mean_g <- known_mean(vapply(people, function(one) one$as_logged, 0))
  cat(sprintf("%s %g g, %s: mean %s g, the paper's own %s g; %d people, %d above, %d below, %d unknown\n",
              condition, reference, staircases, number(mean_g), number(paper_mean_g), length(value),
              n_above, n_below, n_missing))
  record(paste0(figure, ".mean_g"), condition, reference, mean_g)
  record(paste0(figure, ".paper_mean_g"), condition, reference, paper_mean_g)
  record(paste0(figure, ".n"), condition, reference, length(value))
  record(paste0(figure, ".n_censored_above"), condition, reference, n_above)
  record(paste0(figure, ".n_censored_below"), condition, reference, n_below)
  record(paste0(figure, ".n_missing"), condition, reference, n_missing)
}

# Staircases that started on one side of the middle, in sessions with several start levels.
by_start <- function(here, results, side) {
  lapply(split(here, here$person), function(theirs) {
    own <- do.call(rbind, lapply(split(theirs, key(theirs)), function(session) {
      found <- results[paste(key(results), results$staircase) %in%
                       paste(key(session), session$staircase), ]
      if (length(unique(found$start_g)) < 2) return(found[0, ])
      found[(found$start_g > mean(range(found$start_g))) == (side == "from_above"), ]
    }))
    c(mean_estimate(own$shown_g, own$direction), as_logged = mean(own$jnd_g))
  })
}

# Sensitivity: comparison, none or reference -------------------------------------------------------

# The indecision model: D = s x + b + N(0, 1); comparison if D > tau, reference if D < -tau, otherwise
# none. 75 %-correct threshold of a forced choice: qnorm(0.75) / s.

compared_choices <- function(compared) {
  here <- choices[choices$compared == compared, ]
  here$answer <- factor(here$answer, c("reference", "none", "comparison"), ordered = TRUE)
  here$person <- factor(here$person)
  here$unit <- max(abs(here$level_g))
  here$x <- here$level_g / here$unit
  here
}
can_be_fitted <- function(here) all(table(here$answer) > 0) && length(unique(here$level_g)) > 1

# Mixed model: the sensitivity s varies over participants. heft analyse's model also has lapses, and
# criteria and biases that vary; see the last lines of this part for it.
mixed_fits <- function() {
  if (!requireNamespace("ordinal", quietly = TRUE)) return(cat("ordinal is not installed: no fit.\n"))
  for (compared in unique(choices$compared)) {
    here <- compared_choices(compared)
    n <- nlevels(here$person)
    if (!can_be_fitted(here) || n < 5 || n > 100) {
      cat(compared, ": ", n, " participants; mixed fits are of 5 to 100, with all three answers\n", sep = "")
      next
    }
    fit <- tryCatch(suppressWarnings(ordinal::clmm(answer ~ x + (0 + x | person), data = here,
                                                   link = "probit", threshold = "symmetric")),
                    error = identity)
    if (inherits(fit, "error")) {
      cat(compared, ": ", conditionMessage(fit), "\n", sep = "")
      next
    }
    unit <- here$unit[1]
    s <- fit$beta[["x"]] / unit
    se <- tryCatch(coef(summary(fit))["x", "Std. Error"], error = function(e) NA) / unit
    spread <- unname(unlist(fit$ST)[1]) / unit
    # Not identifiable if the interval of the sensitivity holds 0.
    threshold_g <- if (isTRUE(s > qnorm(0.975) * se)) qnorm(0.75) / s else NA
    cat(sprintf("%s: sensitivity %s per g (SE %s, SD between participants %s), ", compared, number(s),
                number(se), number(spread)),
        sprintf("threshold %s g; %d participants\n", trimws(number(threshold_g)), n), sep = "")
    record_mixed <- function(figure, value)
      record(paste0("mixed.", figure), here$condition[1], here$reference_g[1], value)
    record_mixed("sensitivity", s)
    record_mixed("sensitivity_se", se)
    record_mixed("sd_sensitivity", spread)
    record_mixed("threshold_75_g", threshold_g)
  }
}

# Pools all trials, as `heft fit choices.csv --model indecision --by compared`. Staircases show larger
# differences to less sensitive participants, so that pooled thresholds are too large.
pooled_fits <- function() {
  if (!requireNamespace("ordinal", quietly = TRUE)) return(cat("ordinal is not installed: no fit.\n"))
  for (compared in unique(choices$compared)) {
    here <- compared_choices(compared)
    condition <- here$condition[1]
    reference <- here$reference_g[1]
    if (!can_be_fitted(here)) {
      cat(compared, ": not all answers or too few levels, no fit\n", sep = "")
      next
    }
    fit <- tryCatch(ordinal::clm(answer ~ x, data = here, link = "probit",
                                 control = list(gradTol = 1e-8, maxIter = 200)), error = identity)
    if (inherits(fit, "error")) {
      cat(compared, ": ", conditionMessage(fit), "\n", sep = "")
      next
    }
    theta <- fit$alpha
    s <- unname(fit$beta) / here$unit[1]
    cat(sprintf("%s: sensitivity %s per g, indecision %s, bias %s, log likelihood %s, %d trials\n",
                compared, number(s), number((theta[[2]] - theta[[1]]) / 2),
                number(-(theta[[1]] + theta[[2]]) / 2), number(as.numeric(logLik(fit))),
                nrow(here)))
    record("indecision.sensitivity", condition, reference, s)
    record("indecision.indecision", condition, reference, (theta[[2]] - theta[[1]]) / 2)
    record("indecision.bias", condition, reference, -(theta[[1]] + theta[[2]]) / 2)
    record("indecision.log_likelihood", condition, reference, as.numeric(logLik(fit)))
  }
}

# For posteriors instead of maximum likelihood: the mixed indecision model of heft analyse, without
# lapses, in brms (Stan), one reference and condition at a time. With lapses in the data, sensitivities
# come out too small.
#
#   P(left)  = pnorm(-tau - (s x + b)),   P(left or none) = pnorm(tau - (s x + b))
#   cumulative("probit"): P(answer <= k) = pnorm(disc * (threshold_k - eta))
#
# Both are equal with thresholds of -1 and 1, disc = tau and eta = (s x + b) / tau. Terms:
#   ls, lt          log s and log tau, so that both are positive and differ by factors
#   nlf(disc ~ lt)  disc = exp(lt), since brms models the logarithm of disc
#   exp(ls - lt)*x  s x / tau
#   b * exp(-lt)    b / tau; b, a preference for the right side, is 0 in the mean of participants
#   (1 |p| person)  log s and log tau of a person, correlated because they share the name p
#   constant(-1)    holds the first threshold, and constant(2) its distance to the second one, as
#                   their place and distance are in b and tau
#   lkj(2)          the weak prior on that correlation that heft analyse has
#
# library(brms)
# here <- compared_choices(choices$compared[1])
# here$x <- here$right_minus_left_g / here$unit
# here$side <- factor(here$side, c("left", "none", "right"), ordered = TRUE)
# model <- bf(side ~ exp(ls - lt) * x + b * exp(-lt), nlf(disc ~ lt),
#             ls + lt ~ 1 + (1 |p| person), b ~ 0 + (1 | person), nl = TRUE)
# priors <- c(prior(constant(-1), class = "Intercept"), prior(constant(2), class = "delta"),
#             prior(normal(1, 1.5), nlpar = "ls"), prior(normal(0, 1), nlpar = "lt"),
#             prior(normal(0, 0.7), class = "sd", nlpar = "ls"),
#             prior(normal(0, 0.7), class = "sd", nlpar = "lt"),
#             prior(normal(0, 0.5), class = "sd", nlpar = "b"),
#             prior(lkj(2), class = "cor"))
# fit <- brm(model, here, family = cumulative("probit", threshold = "equidistant"), prior = priors,
#            cores = 4, seed = 1, control = list(adapt_delta = 0.95))
# summary(fit)
# threshold_g <- qnorm(0.75) * here$unit[1] * exp(-as_draws_df(fit)$b_ls_Intercept)
# quantile(threshold_g, c(0.5, 0.025, 0.975))  # of the median participant

# --------------------------------------------------------------------------------------------------

sink("analysis.txt", split = TRUE)
cat("heft export:", length(unique(trials$person)), "participants,", nrow(completed),
    "completed trials of", nrow(trials), "\n")
if (any(!is.na(models$responder))) cat("SIMULATED: a model answered", nrow(models), "sessions.\n")
for (task in unique(completed$task)) {
  rows <- completed[completed$task == task, ]
  with_value <- rows[!is.na(rows$value), ]
  heading(paste0(task, ": ", if (nrow(with_value) > 0) "numbers by mass" else "shares of people's trials"))
  if (nrow(with_value) > 0) numbers(with_value, task) else shares(task)
  if (all(c("correct", "incorrect") %in% rows$outcome)) {
    heading(paste0(task, ": mixed logistic regression of correct on condition"))
    correctness_model(task)
  }
}
if (any(!is.na(trials$staircase))) {
  heading("Staircases: the paper's JND, by condition and reference (it moves with the criterion)")
  jnds()
}
if (nrow(choices) > 0) {
  heading("Sensitivity by condition and reference: mixed indecision model")
  mixed_fits()
  heading("The same, all trials pooled (thresholds are too large)")
  pooled_fits()
}
sink()
write.csv(format(figures, digits = 15, trim = TRUE), "figures.csv", row.names = FALSE, quote = FALSE)
