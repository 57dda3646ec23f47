# The expected figures of tests/analysis/censored_mean_test.cpp, by R's own optimizers.
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
