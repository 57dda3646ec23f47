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

// Nodes in three dimensions, and log(weight / standard normal density), so that a sum over
// exp(log_weight) f(z) is the integral of f. No node is left out for a small weight: if answers
// have little information, second derivatives are small differences of large sums.
struct StandardNodes {
  Eigen::Matrix3Xd z;
  Eigen::ArrayXd log_weight;
};

const StandardNodes& standard_nodes() {
  static const StandardNodes nodes = [] {
    constexpr Eigen::Index n = 5;
    const auto [at, weight] = normal_quadrature(n);
    StandardNodes all{Eigen::Matrix3Xd(3, n * n * n), Eigen::ArrayXd(n * n * n)};
    for (Eigen::Index node = 0; node < n * n * n; ++node) {
      const Eigen::Index i = node / (n * n), j = node / n % n, k = node % n;
      all.z.col(node) << at[i], at[j], at[k];
      all.log_weight[node] = std::log(weight[i] * weight[j] * weight[k]) +
                             all.z.col(node).squaredNorm() / 2 +
                             1.5 * std::log(2 * std::numbers::pi);
    }
    return all;
  }();
  return nodes;
}

// The normal distribution's lower tail by cubic interpolation: to 1e-10, and to 3e-6 of itself down
// to -12 (then 0). A fit needs it some million times, and spent half of its time on erfc.
class TailTable {
 public:
  TailTable() {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const double z = -static_cast<double>(i) * step;
      at_[i] = {normal_cdf(z), -step * normal_density(z)};
    }
  }
  // @param z not above 0
  double operator()(double z) const {
    if (!(z > -12)) return 0;
    const double place = -z / step;
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    const Point &from = at_[i], &to = at_[i + 1];
    const double rise = to.value - from.value;
    return from.value +
           t * (rise + (1 - t) * ((1 - t) * (from.slope - rise) - t * (to.slope - rise)));
  }

 private:
  struct Point {
    double value = 0, slope = 0;  // per step
  };
  static constexpr double step = 1.0 / 64;
  std::array<Point, 12 * 64 + 2> at_;
};

inline double fast_normal_cdf(const TailTable& tail, double z) {
  const double beyond = tail(-std::abs(z));
  return z > 0 ? 1 - beyond : beyond;
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

  // Standardizes each row.
  Eigen::ArrayX3d standardized(const Eigen::ArrayX3d& effects) const {
    Eigen::ArrayX3d z(effects.rows(), 3);
    z << (effects.col(0) - mean_s) / sd_s, (effects.col(1) - mean_t) / sd_t, effects.col(2) / sd_b;
    return z;
  }
  Eigen::ArrayXd log_density(const Eigen::ArrayX3d& z) const {
    const auto s = z.col(0), t = z.col(1), b = z.col(2);
    return log_density_at_mean - kappa / 2 * (s * s - 2 * rho * s * t + t * t) - b * b / 2;
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

// Derivatives of the log density by the population.
using Slopes = Eigen::Matrix<double, Eigen::Dynamic, n_population_parameters>;  // a row each
using Hessian = Eigen::Matrix<double, n_population_parameters, n_population_parameters>;

Slopes density_slopes(const Distribution& of, const Eigen::ArrayX3d& z) {
  const double rho = of.rho, kappa = of.kappa;
  const Eigen::ArrayXd s = z.col(0) - rho * z.col(1), t = z.col(1) - rho * z.col(0);
  const Eigen::ArrayXd square = z.col(0) * s + z.col(1) * t;
  Slopes slopes(z.rows(), Eigen::Index{n_population_parameters});
  slopes.col(mean_log_sensitivity) = kappa / of.sd_s * s;
  slopes.col(mean_log_criterion) = kappa / of.sd_t * t;
  slopes.col(log_sd_sensitivity) = kappa * z.col(0) * s - 1;
  slopes.col(log_sd_criterion) = kappa * z.col(1) * t - 1;
  slopes.col(arctanh_correlation) = rho + z.col(0) * z.col(1) - rho * kappa * square;
  slopes.col(log_sd_bias) = z.col(2).square() - 1;
  slopes.col(shared_lapse).setZero();
  return slopes;
}

// Means over nodes that give the mean of the second derivatives, which are quadratic in z.
struct Moments {
  Moments(const Eigen::ArrayXd& weights, const Eigen::ArrayX3d& z)
      : s((weights * z.col(0)).sum()),
        t((weights * z.col(1)).sum()),
        ss((weights * z.col(0).square()).sum()),
        st((weights * z.col(0) * z.col(1)).sum()),
        tt((weights * z.col(1).square()).sum()),
        bb((weights * z.col(2).square()).sum()) {}
  double s, t, ss, st, tt, bb;
};

Hessian density_hessian(const Distribution& of, const Moments& m) {
  const double rho = of.rho, kappa = of.kappa;
  const double square = m.ss - 2 * rho * m.st + m.tt;
  Hessian hessian = Hessian::Zero();
  const auto put = [&](Eigen::Index i, Eigen::Index j, double value) {
    hessian(i, j) = hessian(j, i) = value;
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
  return hessian;
}

struct PersonLikelihood {
  double value = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
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
    sum.hessian += change * by.second.topLeftCorner<2, 2>() * change.transpose();
    sum.hessian(0, 0) += felt * (first[0] + first[1]);
    sum.hessian(1, 1) += tau * (first[1] - first[0]);
  }
  return sum;
}

// Newton's step, with the absolute values of the Hessian's eigenvalues, so that it leads uphill.
Eigen::Vector3d uphill(const Eigen::Matrix3d& hessian, const Eigen::Vector3d& slope) {
  if (const Eigen::LLT<Eigen::Matrix3d> factor(-hessian); factor.info() == Eigen::Success)
    return factor.solve(slope);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(hessian);
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
    all.hessian -= precision;
    return all;
  };
  constexpr double longest_step = 2, small_gain = 1e-9;
  PersonLikelihood here = posterior(has_mode_ ? mode_ : mean);
  if (!has_mode_ || !here.hessian.allFinite()) {  // or so far from the last that no digits are left
    mode_ = mean;
    here = posterior(mode_);
  }
  has_mode_ = true;
  for (int i = 0; i < 50; ++i) {
    Eigen::Vector3d step = uphill(here.hessian, here.slope);
    if (step.dot(here.slope) < small_gain) break;
    step *= std::min(1.0, longest_step / step.cwiseAbs().maxCoeff());
    PersonLikelihood there = posterior(mode_ + step);
    for (int halving = 0; halving < 30 && !(there.value > here.value); ++halving)
      there = posterior(mode_ + (step /= 2));
    if (!(there.value > here.value)) break;
    mode_ += step;
    here = there;
  }
  curvature_ = -here.hessian;
}

void PersonIntegral::center(const Parameters& population) {
  find_mode(population);
  put_nodes(population);
  put_shares();
}

void PersonIntegral::put_nodes(const Parameters& population) {
  Eigen::LLT<Eigen::Matrix3d> factor(curvature_);
  if (factor.info() != Eigen::Success || !curvature_.allFinite())
    factor.compute(Distribution(population).precision());
  const auto& [z, log_weight] = standard_nodes();
  effects_ = (factor.matrixU().solve(z).colwise() + mode_).transpose();
  log_weights_ = log_weight - factor.matrixLLT().diagonal().array().log().sum();
}

// Answer by answer: neighboring nodes mostly lie on the same side of 0.
void PersonIntegral::put_shares() {
  static const TailTable tail;
  const auto cdf = [](double z) { return fast_normal_cdf(tail, z); };
  std::vector<IndecisionParameters> own;
  for (Eigen::Index node = 0; node < effects_.rows(); ++node)
    own.push_back(own_parameters(effects_.row(node), 0));
  shares_.resize(effects_.rows(), static_cast<Eigen::Index>(given_.size()));
  double* share = shares_.data();  // a column for each answer
  for (const Given& given : given_)
    for (const IndecisionParameters& at : own) {
      const double felt = at.sensitivity * given.level + at.bias;
      const double up = felt - at.indecision, down = felt + at.indecision;
      if (given.answer != none_answer)
        *share++ = cdf(given.answer == comparison_answer ? up : -down);
      else
        *share++ = up > 0 ? cdf(-up) - cdf(-down) : cdf(down) - cdf(up);
    }
}

PersonIntegral::AtNodes PersonIntegral::at_nodes(double lapse, bool with_derivatives) const {
  constexpr double least_share = 1e-30;
  constexpr int trials_at_once = 10;  // a product of so many does not underflow
  const Eigen::Index n_nodes = shares_.rows();
  AtNodes sum{Eigen::ArrayXd::Zero(n_nodes), Eigen::ArrayXd::Zero(n_nodes),
              Eigen::ArrayXd::Zero(n_nodes)};
  Eigen::ArrayXd product = Eigen::ArrayXd::Ones(n_nodes), p(n_nodes), slope(n_nodes);
  int n_in_product = 0;
  for (Eigen::Index i = 0; const Given& given : given_) {
    const auto share = shares_.col(i++);
    p = (lapse / 3 + (1 - lapse) * share).max(least_share);
    if (with_derivatives) {
      slope = (1.0 / 3 - share) / p;
      sum.slope += given.n * slope;
      sum.curvature -= given.n * slope.square();
    }
    for (double n = given.n; n > 0; n -= 1) {
      product *= p;
      if (++n_in_product < trials_at_once) continue;
      sum.value += product.log();
      product.setOnes();
      n_in_product = 0;
    }
  }
  sum.value += product.log();
  return sum;
}

double PersonIntegral::log_likelihood(const Parameters& population, Derivatives* derivatives) {
  const Distribution people(population);
  const AtNodes given = at_nodes(population[shared_lapse], derivatives != nullptr);
  const Eigen::ArrayX3d z = people.standardized(effects_);
  Eigen::ArrayXd weights = log_weights_ + given.value + people.log_density(z);
  const double most = weights.maxCoeff();
  weights = (weights - most).exp();
  const double sum = weights.sum(), value = most + std::log(sum);
  if (!derivatives) return value;
  weights /= sum;
  Slopes slopes = density_slopes(people, z);
  slopes.col(shared_lapse) = given.slope;
  score_ = slopes.transpose() * weights.matrix();
  Hessian hessian = slopes.transpose() * weights.matrix().asDiagonal() * slopes;
  hessian(shared_lapse, shared_lapse) += (weights * given.curvature).sum();
  derivatives->gradient = score_;
  derivatives->hessian =
      hessian - score_ * score_.transpose() + density_hessian(people, Moments(weights, z));
  return value;
}

}  // namespace heft
