# The expected figures of tests/inference/censored_mean_test.cpp, by R's own optimizers.
# Rscript tests/golden/analysis/tobit.R
v <- c(212, 305, 148, 402, 267, 331, 500, 500, 190, 15)
cens <- c(0, 0, 0, 0, 0, 0, 1, 1, 0, -1)  # 1: above, -1: below
loglik <- function(mu, s) sum(dnorm(v[cens == 0], mu, s, log = TRUE)) +
  sum(pnorm(v[cens == 1], mu, s, lower.tail = FALSE, log.p = TRUE)) +
  sum(pnorm(v[cens == -1], mu, s, log.p = TRUE))
fit <- optim(c(280, log(150)), function(p) -loglik(p[1], exp(p[2])), method = "BFGS",
             control = list(reltol = 1e-15, maxit = 1000))
n <- length(v)
n_exact <- sum(cens == 0)
profile <- function(mu) optimize(function(ls) loglik(mu, exp(ls)), c(2, 9), maximum = TRUE,
                                 tol = 1e-12)$objective
drop <- n_exact / 2 * log(1 + qt(0.975, n_exact - 1)^2 / (n_exact - 1))
end <- function(a, b) uniroot(function(mu) profile(mu) + fit$value + drop, c(a, b), tol = 1e-9)$root
print(c(mean = fit$par[1], sd = exp(fit$par[2]) * sqrt(n / (n - 1)),
        low = end(fit$par[1] - 400, fit$par[1]), high = end(fit$par[1], fit$par[1] + 600)),
      digits = 12)

# The same of logarithms: the mean of a log-normal distribution, exp(mu + sigma^2/2), over its logarithm.
log_normal <- function(v, cens) {
  y <- log(v)
  n <- length(y)
  n_exact <- sum(cens == 0)
  loss <- function(mu, ls) -sum(dnorm(y[cens == 0], mu, exp(ls), log = TRUE)) -
    sum(pnorm(y[cens == 1], mu, exp(ls), lower.tail = FALSE, log.p = TRUE)) -
    sum(pnorm(y[cens == -1], mu, exp(ls), log.p = TRUE))
  fit <- optim(c(mean(y), log(sd(y))), function(p) loss(p[1], p[2]), method = "BFGS",
               control = list(reltol = 1e-15, maxit = 1000))
  best <- fit$par[1] + exp(2 * fit$par[2]) / 2
  profile <- function(m) -optimize(function(ls) loss(m - exp(2 * ls) / 2, ls), fit$par[2] + c(-3, 3),
                                   tol = 1e-12)$objective
  drop <- n_exact / 2 * log(1 + qt(0.975, n_exact - 1)^2 / (n_exact - 1))
  end <- function(a, b) uniroot(function(m) profile(m) + fit$value + drop, c(a, b), tol = 1e-11)$root
  print(c(mean = exp(best), sd = exp(best) * sqrt(exp(exp(2 * fit$par[2]) * n / (n - 1)) - 1),
          low = exp(end(best - 3, best)), high = exp(end(best, best + 20))), digits = 12)
}
log_normal(v, cens)
log_normal(c(60, 80, 100, 80), rep(0, 4))
