// The probability of a rank order, by recursion along the axis of percepts.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "inference/rankings/Thurstone.h"

namespace heft {

namespace {
using Curve = Eigen::ArrayXd;  // at equal steps from left to right

constexpr double step = 0.04, margin = 6;  // SDs of a difference

// A function and its slope.
struct Sloped {
  Curve value, slope;
};

// Integral from the left end to each point: trapezoids with the next Euler-Maclaurin term.
Curve integral_up_to(const Sloped& of) {
  Curve sum(of.value.size());
  double trapezoids = 0;
  sum[0] = 0;
  for (Eigen::Index i = 1; i < sum.size(); ++i) {
    trapezoids += step / 2 * (of.value[i - 1] + of.value[i]);
    sum[i] = trapezoids - step * step / 12 * (of.slope[i] - of.slope[0]);
  }
  return sum;
}

/// The percepts of the items, in their order.
class Percepts {
 public:
  explicit Percepts(const Eigen::VectorXd& values) : n_(values.size()) {
    const double left = values.minCoeff() - margin, right = values.maxCoeff() + margin;
    const auto n_points = static_cast<Eigen::Index>(std::ceil((right - left) / step)) + 1;
    const Curve x =
        Curve::LinSpaced(n_points, left, left + step * static_cast<double>(n_points - 1));
    for (Eigen::Index k = 0; k < n_; ++k) {
      const Curve z = x - values[k];
      const Curve density = (-z * z).exp() / std::sqrt(std::numbers::pi);
      density_.push_back(density);
      first_.push_back(-2 * z * density);
      second_.push_back((4 * z * z - 2) * density);
    }
  }

  RankingProbability of_order() const {
    const std::vector<Sloped> below = all_below();
    const std::vector<Curve> above = all_above();
    const double p = std::max(integral(density_[0] * above[0]), 1e-300);
    RankingProbability found{std::log(p), Eigen::VectorXd(n_), Eigen::MatrixXd(n_, n_)};
    for (Eigen::Index k = 0; k < n_; ++k) {
      const Curve others = below[at(k)].value * above[at(k)];
      found.gradient[k] = -integral(first_[at(k)] * others) / p;
      found.hessian(k, k) = integral(second_[at(k)] * others) / p;
      put_later(found.hessian, k, below[at(k)], above, p);
    }
    found.hessian -= found.gradient * found.gradient.transpose();
    return found;
  }

 private:
  static std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }
  static double integral(const Curve& of) { return step * of.sum(); }  // it vanishes at both ends

  // For each item, the probability that those before it are in order and all below a point.
  std::vector<Sloped> all_below() const {
    const Curve zero = Curve::Zero(density_[0].size());
    std::vector<Sloped> below{{zero + 1, zero}};
    for (std::size_t k = 0; k + 1 < density_.size(); ++k) {
      const Curve next = density_[k] * below[k].value;
      below.push_back(
          {integral_up_to({next, first_[k] * below[k].value + density_[k] * below[k].slope}),
           next});
    }
    return below;
  }

  // The same of those after it, above the point.
  std::vector<Curve> all_above() const {
    std::vector<Curve> above(density_.size(), Curve::Ones(density_[0].size()));
    Curve slope = Curve::Zero(density_[0].size());  // to the left
    for (std::size_t k = density_.size() - 1; k > 0; --k) {
      const Curve next = density_[k] * above[k];
      above[k - 1] =
          integral_up_to({next.reverse(), (density_[k] * slope - first_[k] * above[k]).reverse()})
              .reverse();
      slope = next;
    }
    return above;
  }

  // Second derivatives of p by the j-th value and those of later items, over p. A density's
  // derivative by its value is the negative slope.
  void put_later(Eigen::MatrixXd& hessian, Eigen::Index j, const Sloped& below_j,
                 const std::vector<Curve>& above, double p) const {
    Sloped last{-first_[at(j)] * below_j.value,
                -second_[at(j)] * below_j.value - first_[at(j)] * below_j.slope};
    for (Eigen::Index k = j + 1; k < n_; ++k) {
      const Curve below = integral_up_to(last);
      hessian(j, k) = hessian(k, j) = -integral(below * first_[at(k)] * above[at(k)]) / p;
      last = {density_[at(k)] * below, first_[at(k)] * below + density_[at(k)] * last.value};
    }
  }

  Eigen::Index n_;
  std::vector<Curve> density_, first_, second_;  // and its derivatives
};
}  // namespace

RankingProbability ranking_probability(const Eigen::VectorXd& values) {
  return Percepts(values).of_order();
}

}  // namespace heft
