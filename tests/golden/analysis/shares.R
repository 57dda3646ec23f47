# The expected intervals of tests/analysis/proportion_test.cpp.
# Rscript tests/golden/analysis/shares.R
score <- function(p, n, t) {
  half <- t * sqrt(p * (1 - p) / n + t^2 / (4 * n^2))
  100 * (p + t^2 / (2 * n) + c(-half, half)) / (1 + t^2 / n)
}
# Satterthwaite's, from the unbiased excess kurtosis of how far each one's absence moves the share.
df_of <- function(moves) {
  n <- length(moves)
  if (n < 10) return(n - 1)
  g <- n * sum(moves^4) / sum(moves^2)^2 - 3
  G <- (n - 1) / ((n - 2) * (n - 3)) * ((n + 1) * g + 6)
  2 / (2 / (n - 1) + max(G, 0) / n)
}
interval <- function(p, without, confidence) {
  n <- length(without)
  v <- (n - 1) / n * sum((without - p)^2)
  score(p, max(n, p * (1 - p) / v), qt((1 + confidence) / 2, df_of(without - p)))
}
of_means <- function(hits, trials, confidence = 0.95) {
  x <- hits / trials
  interval(mean(x), sapply(seq_along(x), function(i) mean(x[-i])), confidence)
}
of_ratio <- function(hits, trials) {
  without <- sapply(seq_along(hits), function(i) sum(hits[-i]) / sum(trials[-i]))
  interval(sum(hits) / sum(trials), without, 0.95)
}
options(digits = 12)
print(of_means(c(6, 8, 10, 8), rep(10, 4)))
print(of_means(c(0, 1, 0, 3), c(5, 5, 5, 5)))
print(of_means(c(0, 1, 0, 3), c(5, 5, 5, 5), 0.9))
print(of_ratio(c(5, 0, 3), c(13, 4, 6)))
print(of_means(c(0, 1, 0, 0, 4, 0, 0, 1, 0, 0, 0), rep(5, 11)))
print(of_ratio(c(0, 1, 0, 0, 7, 0, 0, 1, 0, 0, 0), c(5:14, 20)))
print(100 * qbeta(0.975, 1, 3))  # nobody of three: over people
