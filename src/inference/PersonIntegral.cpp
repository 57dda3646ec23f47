#include "inference/PersonIntegral.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace heft {

namespace {
struct QuadratureRule {
  Eigen::VectorXd at, weight;  // of the standard normal distribution
};

// Golub & Welsch (1969): eigenvalues of the Hermite polynomials' Jacobi matrix.
QuadratureRule normal_quadrature(Eigen::Index n) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 1; i < n; ++i)
    jacobi(i, i - 1) = jacobi(i - 1, i) = std::sqrt(static_cast<double>(i));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobi);
  return {solver.eigenvalues(), solver.eigenvectors().row(0).array().square()};
}

// Nodes in three dimensions without those of the least weight, and log(weight / standard normal
// density), so that a sum over exp(log_weight) f(z) is the integral of f.
struct StandardNode {
  Eigen::Vector3d z;
  double log_weight = 0;
};

const std::vector<StandardNode>& standard_nodes() {
  static const std::vector<StandardNode> nodes = [] {
    constexpr double least_weight = 2e-5;
    const auto [at, weight] = normal_quadrature(5);
    std::vector<StandardNode> all;
    for (Eigen::Index i = 0; i < at.size(); ++i)
      for (Eigen::Index j = 0; j < at.size(); ++j)
        for (Eigen::Index k = 0; k < at.size(); ++k) {
          const Eigen::Vector3d z(at[i], at[j], at[k]);
          if (const double product = weight[i] * weight[j] * weight[k]; product > least_weight)
            all.push_back({z, std::log(product) + z.squaredNorm() / 2 +
                                  1.5 * std::log(2 * std::numbers::pi)});
        }
    return all;
  }();
  return nodes;
}

// The normal distribution of effects over people.
struct Distribution {
  explicit Distribution(const Parameters& at)
      : mean_s(at[mean_log_sensitivity]),
        mean_t(at[mean_log_criterion]),
        sd_s(std::exp(at[log_sd_sensitivity])),
        sd_t(std::exp(at[log_sd_criterion])),
        sd_b(std::exp(at[log_sd_bias])),
        rho(std::tanh(at[arctanh_correlation])),
        kappa(1 / (1 - rho * rho)),
        log_density_at_mean(std::log(kappa) / 2 - std::log(sd_s * sd_t * sd_b) -
                            1.5 * std::log(2 * std::numbers::pi)) {}

  Eigen::Vector3d standardized(const PersonEffects& effects) const {
    return {(effects[0] - mean_s) / sd_s, (effects[1] - mean_t) / sd_t, effects[2] / sd_b};
  }
  double log_density(const Eigen::Vector3d& z) const {
    return log_density_at_mean - kappa * (z[0] * z[0] - 2 * rho * z[0] * z[1] + z[1] * z[1]) / 2 -
           z[2] * z[2] / 2;
  }
  Eigen::Matrix3d precision() const {
    Eigen::Matrix3d all = Eigen::Matrix3d::Zero();
    all(0, 0) = kappa / (sd_s * sd_s);
    all(1, 1) = kappa / (sd_t * sd_t);
    all(0, 1) = all(1, 0) = -rho * kappa / (sd_s * sd_t);
    all(2, 2) = 1 / (sd_b * sd_b);
    return all;
  }

  double mean_s, mean_t, sd_s, sd_t, sd_b, rho, kappa, log_density_at_mean;
};

// Slopes of the log density by the population.
using Slopes = Eigen::Matrix<double, n_population_parameters, 1>;
using Bends = Eigen::Matrix<double, n_population_parameters, n_population_parameters>;

Slopes density_slopes(const Distribution& of, const Eigen::Vector3d& z) {
  const double rho = of.rho, kappa = of.kappa, s = z[0] - rho * z[1], t = z[1] - rho * z[0];
  const double square = z[0] * z[0] - 2 * rho * z[0] * z[1] + z[1] * z[1];
  Slopes slopes;
  slopes << kappa * s / of.sd_s, kappa * t / of.sd_t, kappa * z[0] * s - 1, kappa * z[1] * t - 1,
      rho + z[0] * z[1] - square * rho * kappa, z[2] * z[2] - 1, 0;
  return slopes;
}

// Sums over nodes that give the mean of the second derivatives, which are quadratic in z.
struct Moments {
  double s = 0, t = 0, ss = 0, st = 0, tt = 0, bb = 0;
  void add(double weight, const Eigen::Vector3d& z) {
    s += weight * z[0];
    t += weight * z[1];
    ss += weight * z[0] * z[0];
    st += weight * z[0] * z[1];
    tt += weight * z[1] * z[1];
    bb += weight * z[2] * z[2];
  }
};

Bends density_bends(const Distribution& of, const Moments& m) {
  const double rho = of.rho, kappa = of.kappa;
  const double square = m.ss - 2 * rho * m.st + m.tt;
  Bends bend = Bends::Zero();
  const auto put = [&](Eigen::Index i, Eigen::Index j, double value) {
    bend(i, j) = bend(j, i) = value;
  };
  put(mean_log_sensitivity, mean_log_sensitivity, -kappa / (of.sd_s * of.sd_s));
  put(mean_log_criterion, mean_log_criterion, -kappa / (of.sd_t * of.sd_t));
  put(mean_log_sensitivity, mean_log_criterion, kappa * rho / (of.sd_s * of.sd_t));
  put(mean_log_sensitivity, log_sd_sensitivity, -kappa * (2 * m.s - rho * m.t) / of.sd_s);
  put(mean_log_criterion, log_sd_criterion, -kappa * (2 * m.t - rho * m.s) / of.sd_t);
  put(mean_log_sensitivity, log_sd_criterion, kappa * rho * m.t / of.sd_s);
  put(mean_log_criterion, log_sd_sensitivity, kappa * rho * m.s / of.sd_t);
  put(mean_log_sensitivity, arctanh_correlation,
      (2 * rho * kappa * (m.s - rho * m.t) - m.t) / of.sd_s);
  put(mean_log_criterion, arctanh_correlation,
      (2 * rho * kappa * (m.t - rho * m.s) - m.s) / of.sd_t);
  put(log_sd_sensitivity, log_sd_sensitivity, kappa * (rho * m.st - 2 * m.ss));
  put(log_sd_criterion, log_sd_criterion, kappa * (rho * m.st - 2 * m.tt));
  put(log_sd_sensitivity, log_sd_criterion, kappa * rho * m.st);
  put(log_sd_sensitivity, arctanh_correlation, 2 * rho * kappa * (m.ss - rho * m.st) - m.st);
  put(log_sd_criterion, arctanh_correlation, 2 * rho * kappa * (m.tt - rho * m.st) - m.st);
  put(arctanh_correlation, arctanh_correlation,
      1 / kappa + 2 * m.st * rho - square - 2 * square * rho * rho * kappa);
  put(log_sd_bias, log_sd_bias, -2 * m.bb);
  return bend;
}

struct PersonLikelihood {
  double value = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
};

IndecisionParameters own_parameters(const PersonEffects& effects, double lapse) {
  return {std::exp(effects[0]), std::exp(effects[1]), effects[2], lapse};
}

PersonLikelihood person_likelihood(std::span<const LevelAnswers> answers,
                                   const PersonEffects& effects, double lapse) {
  const IndecisionParameters own = own_parameters(effects, lapse);
  PersonLikelihood sum;
  for (const LevelAnswers& level : answers) {
    const LevelLikelihood by = level_likelihood(own, level);
    const double felt = own.sensitivity * level.level, tau = own.indecision;
    Eigen::Matrix<double, 3, 2> change;  // of up and down with each effect
    change << felt, felt, -tau, tau, 1, 1;
    const Eigen::Vector2d first = by.first.head<2>();
    sum.value += by.value;
    sum.slope += change * first;
    sum.bend += change * by.second.topLeftCorner<2, 2>() * change.transpose();
    sum.bend(0, 0) += felt * (first[0] + first[1]);
    sum.bend(1, 1) += tau * (first[1] - first[0]);
  }
  return sum;
}

// Newton's step; where the function bends upwards, as far as if it bent down as much.
Eigen::Vector3d uphill(const Eigen::Matrix3d& bend, const Eigen::Vector3d& slope) {
  if (const Eigen::LLT<Eigen::Matrix3d> factor(-bend); factor.info() == Eigen::Success)
    return factor.solve(slope);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(bend);
  const Eigen::Array3d values = solver.eigenvalues().array().abs().max(1e-6);
  return solver.eigenvectors() *
         ((solver.eigenvectors().transpose() * slope).array() / values).matrix();
}
}  // namespace

PersonIntegral::PersonIntegral(std::vector<LevelAnswers> answers)
    : answers_(std::move(answers)), score_(Parameters::Zero(n_population_parameters)) {
  for (const LevelAnswers& level : answers_)
    for (const IndecisionAnswer answer : {reference_answer, none_answer, comparison_answer})
      if (level.n[answer] > 0) given_.push_back({level.level, level.n[answer], answer});
}

void PersonIntegral::find_mode(const Parameters& population) {
  const Distribution people(population);
  const Eigen::Matrix3d precision = people.precision();
  const PersonEffects mean(people.mean_s, people.mean_t, 0);
  const double lapse = population[shared_lapse];
  const auto posterior = [&](const PersonEffects& at) {
    PersonLikelihood all = person_likelihood(answers_, at, lapse);
    const Eigen::Vector3d pull = precision * (at - mean);
    all.value -= pull.dot(at - mean) / 2;
    all.slope -= pull;
    all.bend -= precision;
    return all;
  };
  constexpr double longest_step = 2, small_gain = 1e-9;
  PersonLikelihood here = posterior(has_mode_ ? mode_ : mean);
  if (!has_mode_ || !here.bend.allFinite()) {  // or so far from the last that no digits are left
    mode_ = mean;
    here = posterior(mode_);
  }
  has_mode_ = true;
  for (int i = 0; i < 50; ++i) {
    Eigen::Vector3d step = uphill(here.bend, here.slope);
    if (step.dot(here.slope) < small_gain) break;
    step *= std::min(1.0, longest_step / step.cwiseAbs().maxCoeff());
    PersonLikelihood there = posterior(mode_ + step);
    for (int halving = 0; halving < 30 && !(there.value > here.value); ++halving)
      there = posterior(mode_ + (step /= 2));
    if (!(there.value > here.value)) break;
    mode_ += step;
    here = there;
  }
  curvature_ = -here.bend;
}

void PersonIntegral::center(const Parameters& population) {
  find_mode(population);
  Eigen::LLT<Eigen::Matrix3d> factor(curvature_);
  if (factor.info() != Eigen::Success || !curvature_.allFinite())
    factor.compute(Distribution(population).precision());
  const double log_scale = -factor.matrixLLT().diagonal().array().log().sum();
  nodes_.clear();
  shares_.clear();
  nodes_.reserve(standard_nodes().size());
  shares_.reserve(standard_nodes().size() * given_.size());
  for (const auto& [z, log_weight] : standard_nodes()) {
    nodes_.push_back({mode_ + factor.matrixU().solve(z), log_weight + log_scale});
    const IndecisionParameters own = own_parameters(nodes_.back().effects, 0);
    for (const Given& given : given_) {
      const double felt = own.sensitivity * given.level + own.bias;
      const double up = felt - own.indecision, down = felt + own.indecision;
      shares_.push_back(given.answer == comparison_answer  ? normal_cdf(up)
                        : given.answer == reference_answer ? normal_cdf(-down)
                        : up > 0                           ? normal_cdf(-up) - normal_cdf(-down)
                                                           : normal_cdf(down) - normal_cdf(up));
    }
  }
}

PersonIntegral::AtNode PersonIntegral::at_node(const double* share, double lapse) const {
  AtNode sum;
  double product = 1;  // of probabilities: its logarithm is taken before it underflows
  for (const Given& given : given_) {
    const double p = std::max(lapse / 3 + (1 - lapse) * *share, 1e-100);
    const double slope = (1.0 / 3 - *share) / p;
    for (double n = given.n; n > 0; n -= 1) {
      product *= p;
      if (product < 1e-150) sum.value += std::log(std::exchange(product, 1.0));
    }
    sum.slope += given.n * slope;
    sum.bend -= given.n * slope * slope;
    ++share;
  }
  sum.value += std::log(product);
  return sum;
}

double PersonIntegral::log_likelihood(const Parameters& population, Derivatives* derivatives) {
  const Distribution people(population);
  struct Term {
    AtNode at;
    Eigen::Vector3d z;
    double value = 0;
  };
  std::vector<Term> terms;
  terms.reserve(nodes_.size());
  double most = -infinity;
  for (const Node& node : nodes_) {
    Term& term = terms.emplace_back(
        Term{at_node(shares_.data() + terms.size() * given_.size(), population[shared_lapse]),
             people.standardized(node.effects)});
    term.value = node.log_weight + term.at.value + people.log_density(term.z);
    most = std::max(most, term.value);
  }
  double sum = 0;
  for (Term& term : terms) sum += term.value = std::exp(term.value - most);
  const double value = most + std::log(sum);
  if (!derivatives) return value;
  Moments moments;
  Slopes slope = Slopes::Zero();
  Bends bend = Bends::Zero();
  for (const Term& term : terms) {
    const double weight = term.value / sum;
    Slopes slopes = density_slopes(people, term.z);
    slopes[shared_lapse] = term.at.slope;
    slope += weight * slopes;
    bend.noalias() += (weight * slopes) * slopes.transpose();
    bend(shared_lapse, shared_lapse) += weight * term.at.bend;
    moments.add(weight, term.z);
  }
  score_ = slope;
  derivatives->gradient = slope;
  derivatives->hessian = bend - slope * slope.transpose() + density_bends(people, moments);
  return value;
}

}  // namespace heft
