# The expected intervals of tests/analysis/proportion_test.cpp.
# Rscript tests/golden/analysis/shares.R
score <- function(p, n, t) {
  half <- t * sqrt(p * (1 - p) / n + t^2 / (4 * n^2))
  100 * (p + t^2 / (2 * n) + c(-half, half)) / (1 + t^2 / n)
}
of_means <- function(hits, trials, confidence = 0.95) {
  x <- hits / trials
  n <- length(x)
  p <- mean(x)
  score(p, max(n, p * (1 - p) / (var(x) / n)), qt((1 + confidence) / 2, n - 1))
}
of_ratio <- function(hits, trials) {
  n <- length(hits)
  p <- sum(hits) / sum(trials)
  v <- n / (n - 1) * sum((hits - p * trials)^2) / sum(trials)^2
  score(p, max(n, p * (1 - p) / v), qt(0.975, n - 1))
}
options(digits = 12)
print(of_means(c(6, 8, 10, 8), rep(10, 4)))
print(of_means(c(0, 1, 0, 3), c(5, 5, 5, 5)))
print(of_means(c(0, 1, 0, 3), c(5, 5, 5, 5), 0.9))
print(of_ratio(c(5, 0, 3), c(13, 4, 6)))
print(100 * qbeta(0.975, 1, 3))  # nobody of three: over people
