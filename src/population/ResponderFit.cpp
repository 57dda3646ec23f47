#include "population/ResponderFit.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/Error.h"
#include "base/Random.h"

namespace heft {

namespace {
// Reported figures are rounded and shares come in steps: a standard deviation of 0 is not exact.
constexpr double least_sd = 0.5;
constexpr double few_people = 2;   // fewer say nothing about a population
constexpr double at_bound = 1e-4;  // of a logarithm

double normal_log_density(double z, double sd) {
  return -z * z / 2 - std::log(sd * std::sqrt(2 * std::numbers::pi));
}

double standard_error(const Bank::Moments& found, int n) {
  const double sd = std::max(found.sd, least_sd);
  return sd * std::sqrt(1.0 / n + 1 / found.effective);
}

// Standard error of the logarithm of a standard deviation.
double log_sd_error(const Bank::Moments& found, int n) {
  const double excess = std::max(found.kurtosis - 1, 0.5);
  return std::sqrt(excess / 4 * (1.0 / n + 1 / found.effective));
}

ComparedFigure compared(const ReportedFigure& reported, const Bank::Moments& found) {
  ComparedFigure figure{reported, found, {}, {}, 0};
  if (!found.exists()) return figure;
  if (reported.mean) {
    const double error = standard_error(found, reported.n);
    figure.z_mean = (*reported.mean - found.mean) / error;
    figure.log_likelihood += normal_log_density(*figure.z_mean, error);
  }
  if (reported.sd) {
    const double error = log_sd_error(found, reported.n);
    figure.z_sd = std::log(*reported.sd / std::max(found.sd, least_sd)) / error;
    figure.log_likelihood += normal_log_density(*figure.z_sd, error);
  }
  return figure;
}

// The search is over logarithms, in which the likelihood is closest to a parabola.
Parameters exponentials(const Parameters& logs) {
  return logs.array().exp();
}

using ValueAt = std::function<double(const Parameters& at)>;

ValueAt likelihood_of(const Bank& bank, std::span<const ReportedFigure> figures) {
  return [&bank, figures, moments = std::vector<Bank::Moments>()](const Parameters& at) mutable {
    bank.moments(at, moments);
    double sum = 0;
    for (std::size_t f = 0; f < figures.size(); ++f) {
      if (!figures[f].fitted || !figures[f].mean) continue;
      if (!(moments[f].effective > few_people)) return -1e9;
      sum += compared(figures[f], moments[f]).log_likelihood;
    }
    return sum;
  };
}

class BankLikelihood {
 public:
  explicit BankLikelihood(ValueAt value_at) : value_at_(std::move(value_at)) {}

  double operator()(const Parameters& logs, Derivatives* derivatives) {
    const double here = value(logs);
    if (derivatives) differentiate(logs, here, *derivatives);
    return here;
  }

 private:
  double value(const Parameters& logs) { return value_at_(exponentials(logs)); }

  // Central differences.
  void differentiate(const Parameters& at, double here, Derivatives& derivatives) {
    constexpr double h = 1e-3;
    const auto shifted = [&](Eigen::Index i, double by, Eigen::Index j, double by_j) {
      Parameters there = at;
      there[i] += by;
      there[j] += by_j;
      return value(there);
    };
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const double up = shifted(i, h, i, 0), down = shifted(i, -h, i, 0);
      derivatives.gradient[i] = (up - down) / (2 * h);
      derivatives.hessian(i, i) = (up - 2 * here + down) / (h * h);
      for (Eigen::Index j = 0; j < i; ++j)
        derivatives.hessian(i, j) = derivatives.hessian(j, i) =
            (shifted(i, h, j, h) - shifted(i, h, j, -h) - shifted(i, -h, j, h) +
             shifted(i, -h, j, -h)) /
            (4 * h * h);
    }
  }

  ValueAt value_at_;
};

// Starts spread over the bounds, one group each: there may be several maxima.
std::vector<std::vector<Parameters>> starts_within(const std::vector<ParameterBounds>& bounds) {
  constexpr int per_group = 40, n_groups = 3;
  std::vector<std::vector<Parameters>> groups(n_groups);
  RandomStream stream(1, "starts");
  for (auto& group : groups)
    for (int i = 0; i < per_group; ++i) {
      Parameters at(static_cast<Eigen::Index>(bounds.size()));
      for (std::size_t k = 0; k < bounds.size(); ++k)
        at[static_cast<Eigen::Index>(k)] =
            bounds[k].low + stream.uniform() * (bounds[k].high - bounds[k].low);
      group.push_back(at);
    }
  return groups;
}

std::vector<ResponderFit::Pair> pairs_alike(const Bank& bank, const Curvature& hessian) {
  constexpr double alike = 0.8;
  const Curvature covariance = (-hessian).inverse();
  std::vector<ResponderFit::Pair> pairs;
  for (Eigen::Index i = 0; i < hessian.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double r = covariance(i, j) / std::sqrt(std::abs(covariance(i, i) * covariance(j, j)));
      if (std::abs(r) > alike && std::abs(r) <= 1)
        pairs.push_back({bank.free()[static_cast<std::size_t>(j)].name,
                         bank.free()[static_cast<std::size_t>(i)].name, r});
    }
  return pairs;
}

void require_figures(const Bank& bank, std::span<const ReportedFigure> figures) {
  for (std::size_t f = 0; f < figures.size(); ++f)
    if (figures[f].fitted && figures[f].mean && !bank.has(f))
      throw Error(fmt::format("no simulated participant has the figure \"{}\"; expected a protocol "
                              "with such trials, or fitted = false",
                              text_of(figures[f].place)),
                  ExitCode::usage);
}

// The parameters and what the data do not separate. @param at put there: the estimates
ResponderFit fit_parameters(const Bank& bank, ValueAt value_at, bool with_intervals,
                            Parameters& at) {
  std::vector<ParameterBounds> bounds;
  for (const FreeParameter& free : bank.free())
    bounds.push_back({std::log(free.low), std::log(free.high), with_intervals});
  BankLikelihood likelihood(std::move(value_at));
  const LogLikelihood function = [&](const Parameters& there, Derivatives* derivatives) {
    return likelihood(there, derivatives);
  };
  const LikelihoodFit found = maximize_likelihood(function, bounds, starts_within(bounds));

  ResponderFit fit;
  Parameters logs(static_cast<Eigen::Index>(bounds.size()));
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const LikelihoodParameter& one = found.parameters[k];
    logs[static_cast<Eigen::Index>(k)] = one.value;
    const auto end = [](std::optional<double> log, double bound) {
      const bool is_open = !log || std::abs(*log - bound) < at_bound;
      return is_open ? std::nullopt : std::optional(std::exp(*log));
    };
    fit.parameters.push_back({bank.free()[k], std::exp(one.value), end(one.low, bounds[k].low),
                              end(one.high, bounds[k].high)});
  }
  Derivatives derivatives{Parameters(logs.size()), Curvature(logs.size(), logs.size())};
  likelihood(logs, &derivatives);
  fit.alike = pairs_alike(bank, derivatives.hessian);
  at = exponentials(logs);
  return fit;
}

}  // namespace

ResponderFit fit_responder(const Bank& bank, std::span<const ReportedFigure> figures,
                           bool with_intervals) {
  require_figures(bank, figures);
  Parameters at;
  ResponderFit fit = fit_parameters(bank, likelihood_of(bank, figures), with_intervals, at);
  std::vector<Bank::Moments> moments;
  bank.moments(at, moments);
  fit.effective = bank.people();
  for (std::size_t f = 0; f < figures.size(); ++f) {
    const ComparedFigure figure = compared(figures[f], moments[f]);
    const int n = (figure.z_mean ? 1 : 0) + (figure.z_sd ? 1 : 0);
    (figures[f].fitted ? fit.fitted : fit.held_out) += figure.log_likelihood;
    (figures[f].fitted ? fit.n_fitted : fit.n_held_out) += n;
    if (figures[f].fitted && n > 0) fit.effective = std::min(fit.effective, moments[f].effective);
    fit.figures.push_back(figure);
  }
  return fit;
}

ResponderFit fit_responder_to_answers(const Bank& bank) {
  const auto value = [&bank](const Parameters& at) { return bank.of_answers(at).log_likelihood; };
  Parameters at;
  ResponderFit fit = fit_parameters(bank, value, true, at);
  const Bank::AnswersLikelihood found = bank.of_answers(at);
  fit.fitted = found.log_likelihood;
  fit.effective = found.effective;
  return fit;
}

}  // namespace heft
