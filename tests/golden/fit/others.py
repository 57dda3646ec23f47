"""The same fits by other programs: psychometric functions by SciPy, the choice with indecision by
R's ordinal::clm. Independent of heft's code: the formulas are repeated here."""
import csv
import math
import os
import shutil
import subprocess
import tempfile

import numpy
from scipy import optimize, special

MOST_FREE = 0.5  # of guess and lapse, as in heft fit


def share_between(function, scale, x, threshold, slope):
    """F and 1 - F."""
    if function == "cumulative_normal":
        z = (x - threshold) / slope
        return special.ndtr(z), special.ndtr(-z)
    if function == "logistic":
        z = (x - threshold) / slope
        return special.expit(z), special.expit(-z)
    with numpy.errstate(over="ignore", divide="ignore"):
        if function == "gumbel":
            hazard = numpy.exp((x - threshold) / slope)
        elif scale == "linear":
            hazard = (x / threshold) ** slope
        else:
            hazard = 10 ** (slope * (x - threshold) / (20 if scale == "db" else 1))
    return -numpy.expm1(-hazard), numpy.exp(-hazard)


def probabilities(setting, x, parameters):
    threshold, slope, guess, lapse = parameters
    below, above = share_between(setting["function"], setting["scale"], x, threshold, slope)
    return guess + (1 - guess - lapse) * below, lapse + (1 - guess - lapse) * above


def log_likelihood(setting, data, parameters):
    x, n_positive, n = data
    yes, no = probabilities(setting, x, parameters)
    return float(numpy.sum(special.xlogy(n_positive, yes) + special.xlogy(n - n_positive, no)))


def scipy_fit(setting, data):
    """-> parameters [threshold, slope, guess, lapse], log likelihood, standard errors or None"""
    x = data[0]
    logarithmic = setting["function"] == "weibull" and setting["scale"] == "linear"
    free = [0, 1] + [i for i, name in ((2, "guess"), (3, "lapse")) if setting[name] is None]

    def unpacked(values):
        parameters = [0, 0, setting["guess"], setting["lapse"]]
        for i, value in zip(free, values):
            parameters[i] = value
        parameters[1] = math.exp(parameters[1])
        if logarithmic:
            parameters[0] = math.exp(parameters[0])
        return parameters

    def cost(values):
        value = -log_likelihood(setting, data, unpacked(values))
        return value if math.isfinite(value) else 1e10

    axis = numpy.log(x[x > 0]) if logarithmic else x
    low, high = axis.min(), axis.max()
    width = max(high - low, 1e-9)
    if setting["function"] != "weibull":
        slopes = [width / k for k in (2, 6, 20)]
    else:
        factor = {"linear": 1, "log10": math.log(10), "db": math.log(10) / 20}[setting["scale"]]
        slopes = [k / width / factor for k in (2, 6, 20)]
    bounds = [(low - 3 * width, high + 3 * width), (-20, 20)] + [(0, MOST_FREE)] * (len(free) - 2)
    best = None
    for place in numpy.linspace(low, high, 5):
        for slope in slopes:
            for share in (0.02, 0.3)[:1 if len(free) == 2 else 2]:
                start = [place, math.log(slope)] + [share] * (len(free) - 2)
                found = optimize.minimize(cost, start, method="L-BFGS-B", bounds=bounds)
                if best is None or found.fun < best.fun:
                    best = found
    for _ in range(3):
        polished = optimize.minimize(cost, best.x, method="Nelder-Mead", bounds=bounds,
                                     options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 20000,
                                              "maxfev": 20000, "initial_simplex": simplex(best.x)})
        if polished.fun <= best.fun:
            best = polished
    parameters = unpacked(best.x)
    return parameters, -best.fun, standard_errors(setting, data, parameters, free)


def simplex(x):
    points = [x]
    for i in range(len(x)):
        point = x.copy()
        point[i] += 0.01 * max(0.1, abs(point[i])) * (1 if i < 2 or point[i] < 0.25 else -1)
        points.append(point)
    return numpy.array(points)


def standard_errors(setting, data, parameters, free):
    """From a numerical Hessian; None where a parameter lies at a bound."""
    if any(parameters[i] < 1e-4 or parameters[i] > MOST_FREE - 1e-4 for i in free if i > 1):
        return None
    n = len(free)
    steps = [1e-4 * max(abs(parameters[i]), 1e-2) for i in free]

    def value(changes):
        moved = list(parameters)
        for i, change in changes:
            moved[free[i]] += change
        return log_likelihood(setting, data, moved)

    hessian = numpy.empty((n, n))
    for i in range(n):
        for j in range(n):
            a, b = steps[i], steps[j]
            hessian[i, j] = (value([(i, a), (j, b)]) - value([(i, a), (j, -b)]) -
                             value([(i, -a), (j, b)]) + value([(i, -a), (j, -b)])) / (4 * a * b)
    try:
        variances = numpy.diag(numpy.linalg.inv(-hessian))
    except numpy.linalg.LinAlgError:
        return None
    errors = [None] * 4
    for i, variance in zip(free, variances):
        errors[i] = math.sqrt(variance) if variance > 0 else None
    return errors


def scipy_interval(setting, data, index, best, log_likelihood_there):
    """95 % profile interval of threshold (0) or slope (1) where guess and lapse are fixed."""
    other = 1 - index

    def fall(value):
        def cost(values):
            parameters = list(best)
            parameters[index], parameters[other] = value, values[0]
            if parameters[1] <= 0:
                return 1e10
            result = -log_likelihood(setting, data, parameters)
            return result if math.isfinite(result) else 1e10
        scale = abs(best[other]) or 1
        found = optimize.minimize(cost, [best[other]], method="Nelder-Mead",
                                  options={"xatol": 1e-9 * scale, "fatol": 1e-12, "maxiter": 2000})
        return 2 * (log_likelihood_there + found.fun) - 3.841458820694124

    ends = []
    for sign in (-1, 1):
        distance = 0.02 * abs(best[1] if index == 0 else best[index])
        for _ in range(60):
            outer = best[index] + sign * distance
            if index == 1 and outer <= 0:
                outer = best[1] * 1e-3
            if fall(outer) > 0:
                ends.append(optimize.brentq(fall, best[index], outer, xtol=1e-8 * abs(outer)))
                break
            distance *= 1.5
        else:
            ends.append(None)
    return ends


R_SCRIPT = r"""
suppressMessages(library(ordinal))
all <- read.csv(commandArgs(TRUE)[1], stringsAsFactors = FALSE)
cat("dataset,log_likelihood,sensitivity,indecision,bias,sensitivity_se,low,high,seconds\n")
for (name in unique(all$dataset)) {
  data <- all[all$dataset == name, ]
  data$answer <- factor(data$answer, levels = c("reference", "none", "comparison"), ordered = TRUE)
  unit <- max(abs(data$level_g))
  data$x <- data$level_g / unit
  seconds <- sum(system.time({
    fit <- clm(answer ~ x, data = data, link = "probit",
               control = clm.control(gradTol = 1e-10, maxIter = 1000))
    interval <- tryCatch(suppressMessages(confint(fit, type = "profile")["x", ]),
                         error = function(e) c(NA, NA))
  })[c("user.self", "sys.self")])
  cuts <- fit$alpha
  cat(sprintf("%s,%.15g,%.15g,%.15g,%.15g,%.15g,%.15g,%.15g,%.6g\n", name, as.numeric(logLik(fit)),
              fit$beta[["x"]] / unit, (cuts[[2]] - cuts[[1]]) / 2, -(cuts[[1]] + cuts[[2]]) / 2,
              sqrt(vcov(fit)["x", "x"]) / unit, interval[[1]] / unit, interval[[2]] / unit, seconds))
}
"""


def fall_of_choices(answers, sensitivity, log_likelihood):
    """How far twice the log likelihood of the indecision model falls from its maximum where the
    sensitivity is held, the other two searched from many places. Its 95 % interval ends at 3.8415.

    @param answers level -> how often reference, none, comparison
    """
    def cost(others):
        half, bias = math.exp(others[0]), others[1]
        total = 0
        for level, (reference, none, comparison) in answers.items():
            up, down = sensitivity * level + bias - half, sensitivity * level + bias + half
            if up > 0:  # the smaller tails
                up, down, reference, comparison = -down, -up, comparison, reference
            between = special.ndtr(down) - special.ndtr(up)
            total -= reference * special.log_ndtr(-down) + comparison * special.log_ndtr(up)
            total -= none * math.log(max(between, 1e-300))
        return total
    best = min(optimize.minimize(cost, [math.log(half), bias], method="Nelder-Mead",
                                 options={"xatol": 1e-7, "fatol": 1e-9, "maxiter": 2000}).fun
               for half in (0.1, 0.5, 1, 2, 4, 8) for bias in (-8, -4, -2, -0.5, 0, 0.5, 2, 4, 8))
    return 2 * (best + log_likelihood)


def have_r():
    """Whether R and its package ordinal are installed."""
    return shutil.which("Rscript") is not None and subprocess.run(
        ["Rscript", "-e", "library(ordinal)"], capture_output=True).returncode == 0


def clm_fits(path):
    """Of a CSV with columns dataset, level_g, answer. -> {dataset: {figure: value or None}}"""
    with tempfile.NamedTemporaryFile("w", suffix=".R") as script:
        script.write(R_SCRIPT)
        script.flush()
        done = subprocess.run(["Rscript", script.name, os.fspath(path)], capture_output=True,
                              text=True, check=True)
    rows = csv.DictReader(done.stdout.splitlines())
    number = lambda text: None if text in ("NA", "NaN") else float(text)
    return {row.pop("dataset"): {name: number(text) for name, text in row.items()} for row in rows}


MIXED_R_SCRIPT = r"""
suppressMessages(library(ordinal))
data <- read.csv(commandArgs(TRUE)[1], stringsAsFactors = TRUE)
data$answer <- factor(data$answer, levels = c("reference", "none", "comparison"), ordered = TRUE)
unit <- max(abs(data$level_g))
data$x <- data$level_g / unit
for (formula in c(answer ~ x + (0 + x | person), answer ~ x + (1 + x | person))) {
  seconds <- sum(system.time(
    fit <- clmm(formula, data = data, link = "probit", threshold = "symmetric")
  )[c("user.self", "sys.self")])
  cat(sprintf("%.15g,%.6g\n", fit$beta[["x"]] / unit, seconds))
}
"""


def clmm_fits(path):
    """Of a CSV with columns person, level_g, answer. -> sensitivity and processor time of a fit whose
    sensitivity varies over people, and of one whose bias varies, too"""
    with tempfile.NamedTemporaryFile("w", suffix=".R") as script:
        script.write(MIXED_R_SCRIPT)
        script.flush()
        done = subprocess.run(["Rscript", script.name, os.fspath(path)], capture_output=True,
                              text=True, check=True)
    return [tuple(map(float, line.split(","))) for line in done.stdout.splitlines()]
