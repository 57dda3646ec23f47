#include "inference/rankings/Thurstone.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <set>

#include "inference/Fit.h"

namespace heft {

namespace {
using Eigen::Index;

// Who was ranked above whom, directly or by way of others.
class Chains {
 public:
  Chains(const std::vector<double>& stimuli, const OrdersByPerson& people)
      : stimuli_(stimuli), above_(stimuli.size(), std::vector<bool>(stimuli.size())) {
    for (const auto& [person, orders] : people)
      for (const auto& [order, n] : orders)
        for (std::size_t k = 1; k < order.size(); ++k)
          above_[place(order[k])][place(order[k - 1])] = true;
    for (std::size_t by = 0; by < above_.size(); ++by)
      for (std::size_t i = 0; i < above_.size(); ++i)
        for (std::size_t k = 0; k < above_.size(); ++k)
          if (above_[i][by] && above_[by][k]) above_[i][k] = true;
  }

  bool above(double one, double other) const { return above_[place(one)][place(other)]; }
  bool linked(double one, double other) const {
    return one == other || (above(one, other) && above(other, one));
  }

 private:
  std::size_t place(double stimulus) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(stimuli_, stimulus) -
                                    stimuli_.begin());
  }

  const std::vector<double>& stimuli_;
  std::vector<std::vector<bool>> above_;
};

// Lower bound of the ratio of the variance over people to that of independent trials, so that the
// interval does not vanish if people happen to be nearly equal.
double least_ratio(double n_people) {
  const boost::math::chi_squared chance(n_people - 1);
  return quantile(chance, 0.025) / (n_people - 1);
}

/// Of the log likelihood around a point, to second order.
struct Expansion {
  double value = 0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd information;
};

/// Maximum-likelihood values of linked stimuli, relative to the first one's, from their orders.
class Scale {
 public:
  Scale(std::vector<double> stimuli, const OrdersByPerson& people) : stimuli_(std::move(stimuli)) {
    for (const auto& [person, orders] : people) {
      std::map<RankOrder, int> own;
      for (const auto& [order, n] : orders) {
        RankOrder shown;
        std::ranges::copy_if(order, std::back_inserter(shown), [&](double stimulus) {
          return std::ranges::binary_search(stimuli_, stimulus);
        });
        if (shown.size() < 2) continue;
        own[shown] += n;
        n_by_order_[shown] += n;
        n_orders_ += n;
      }
      if (!own.empty()) people_.emplace(person, std::move(own));
    }
    if (n_by_order_.empty()) return;
    at_ = climb(Eigen::VectorXd::Zero(static_cast<Index>(stimuli_.size()) - 1), {});
    for (const auto& [order, n] : n_by_order_) by_order_[order] = part(order, at_);
    best_ = expansion(at_);
  }

  int n_orders() const { return n_orders_; }
  std::size_t n_people() const { return people_.size(); }

  double distance(double low, double high) const { return direction(low, high).dot(at_); }

  using Influences = std::map<std::string, double>;  // by person

  /// @param n number of people  @param each influences()
  Interval interval(double low, double high, int n, const Influences& each) const {
    const Eigen::VectorXd along = direction(low, high);
    const double variance = along.dot(best_.information.ldlt().solve(along));
    double ratio = 1;
    if (n_people() > 1)
      ratio = std::max(variance_of(each) / variance, least_ratio(static_cast<double>(n_people())));
    const double t = student_t_quantile((n_people() > 1 ? n : n_orders_) - 1);
    const double fall = t * std::sqrt(ratio);
    return {end(along, -fall, variance), end(along, fall, variance)};
  }

  /// Change of the estimate without each person, to first order; empty for a single person. None:
  /// if some person is left out, there is no estimate.
  std::optional<Influences> influences(double low, double high) const {
    if (n_people() <= 1) return Influences();
    const Eigen::VectorXd along = direction(low, high);
    Influences changes;
    double mean = 0;
    for (const auto& [person, orders] : people_) {
      Expansion own{0, Eigen::VectorXd::Zero(at_.size()),
                    Eigen::MatrixXd::Zero(at_.size(), at_.size())};
      for (const auto& [order, n] : orders) add(own, by_order_.at(order), n);
      const auto others = (best_.information - own.information).eval().ldlt();
      if (others.vectorD().minCoeff() < 1e-9 * best_.information.diagonal().maxCoeff())
        return std::nullopt;
      mean += (changes[person] = along.dot(others.solve(own.slope))) /
              static_cast<double>(people_.size());
    }
    for (auto& [person, change] : changes) change -= mean;
    return changes;
  }

 private:
  Eigen::VectorXd direction(double low, double high) const {
    Eigen::VectorXd along = Eigen::VectorXd::Zero(at_.size());
    if (place(high) > 0) along[place(high) - 1] = 1;
    if (place(low) > 0) along[place(low) - 1] = -1;
    return along;
  }

  Index place(double stimulus) const {
    return std::ranges::lower_bound(stimuli_, stimulus) - stimuli_.begin();
  }

  // Log probability of one order, with gradient and information.
  Expansion part(const RankOrder& order, const Eigen::VectorXd& at) const {
    const auto n = static_cast<Index>(order.size());
    Eigen::VectorXd values(n);
    Eigen::MatrixXd where = Eigen::MatrixXd::Zero(n, at.size());  // the values are where * at
    for (Index k = 0; k < n; ++k)
      if (const Index of = place(order[static_cast<std::size_t>(k)]); of > 0) where(k, of - 1) = 1;
    values = where * at;
    const RankingProbability found = ranking_probability(values);
    return {found.log_p, where.transpose() * found.gradient,
            -where.transpose() * found.hessian * where};
  }

  Expansion expansion(const Eigen::VectorXd& at) const {
    Expansion sum{0, Eigen::VectorXd::Zero(at.size()), Eigen::MatrixXd::Zero(at.size(), at.size())};
    for (const auto& [order, n] : n_by_order_) add(sum, part(order, at), n);
    return sum;
  }

  static void add(Expansion& sum, const Expansion& one, double n) {
    sum.value += n * one.value;
    sum.slope += n * one.slope;
    sum.information += n * one.information;
  }

  // Newton's method on a concave function. @param held direction in which `from` does not move;
  // empty: none
  Eigen::VectorXd climb(Eigen::VectorXd from, const Eigen::VectorXd& held) const {
    constexpr int most_steps = 100;
    Expansion here = expansion(from);
    for (int i = 0; i < most_steps; ++i) {
      const auto solver = here.information.ldlt();
      Eigen::VectorXd step = solver.solve(here.slope);
      if (held.size() > 0) {
        const Eigen::VectorXd off = solver.solve(held);
        step -= held.dot(step) / held.dot(off) * off;
      }
      const double gain = step.dot(here.slope);
      if (gain < 1e-12) break;
      double part_of_step = 1;
      Expansion next = expansion(from + step);
      while (next.value < here.value + 1e-4 * part_of_step * gain && part_of_step > 1e-9) {
        part_of_step /= 2;
        next = expansion(from + part_of_step * step);
      }
      from += part_of_step * step;
      here = std::move(next);
    }
    return from;
  }

  // Jackknife variance.
  static double variance_of(const Influences& influences) {
    double sum = 0;
    for (const auto& [person, change] : influences) sum += change * change;
    const auto n = static_cast<double>(influences.size());
    return sum * (n - 1) / n;
  }

  // Where the signed root of the likelihood ratio is `fall`: nearly a line in the distance.
  double end(const Eigen::VectorXd& along, double fall, double variance) const {
    const Eigen::VectorXd tangent = best_.information.ldlt().solve(along) / variance;
    const double best = along.dot(at_);
    double distance = best + fall * std::sqrt(variance);
    Eigen::VectorXd at = at_;
    for (int i = 0; i < 50; ++i) {
      at = climb(at + (distance - along.dot(at)) * tangent, along);
      const Expansion here = expansion(at);
      const double root =
          std::copysign(std::sqrt(2 * std::max(best_.value - here.value, 0.0)), fall);
      const double slope =  // of the profile
          along.dot(here.information.ldlt().solve(here.slope)) /
          along.dot(here.information.ldlt().solve(along));
      const double correction = (fall - root) * root / -slope;
      if (!(std::abs(correction) > 1e-7 * std::abs(distance - best))) break;
      distance += correction;
    }
    return distance;
  }

  std::vector<double> stimuli_;
  OrdersByPerson people_;
  std::map<RankOrder, int> n_by_order_;
  int n_orders_ = 0;
  Eigen::VectorXd at_;
  Expansion best_;
  std::map<RankOrder, Expansion> by_order_;  // part() of each order at the maximum
};

using Ranked = std::map<double, std::set<std::string>>;  // who ranked a stimulus

std::string why_none(const Chains& chains, double low, double high, int n, const Scale& scale) {
  if (n == 0) return "no participant ranked both";
  if (n < least_people && scale.n_people() > 1)
    return fmt::format(
        "{} participants are too few for an interval over people, expected {} or "
        "more",
        n, least_people);
  const auto never_above = [](double above, double below) {
    return fmt::format(
        "complete separation: {:g} g was never ranked above {:g} g, directly or by way of others, "
        "so that their distance has no bound",
        above, below);
  };
  if (!chains.above(low, high))
    return chains.above(high, low) ? never_above(low, high)
                                   : "they were never ranked together, nor linked by others";
  if (!chains.above(high, low)) return never_above(high, low);
  if (scale.n_orders() < least_trials_to_fit)
    return fmt::format("{} rankings are too few, expected {:g} or more", scale.n_orders(),
                       least_trials_to_fit);
  return "";
}

PerceivedDistance distance_of(const Chains& chains, const Scale& scale, const Ranked& ranked,
                              double low, double high) {
  PerceivedDistance found;
  found.n = static_cast<int>(std::ranges::count_if(
      ranked.at(low), [&](const std::string& one) { return ranked.at(high).contains(one); }));
  found.why = why_none(chains, low, high, found.n, scale);
  if (!found.why.empty()) return found;
  const auto influences = scale.influences(low, high);
  if (!influences) {
    found.why = "one participant's orders alone link them";
    return found;
  }
  found.value = scale.distance(low, high);
  found.interval = scale.interval(low, high, found.n, *influences);
  if (found.n > 1) found.influence = *influences;
  return found;
}
}  // namespace

std::vector<PerceivedStimulus> perceived_values(const OrdersByPerson& people) {
  Ranked ranked;
  for (const auto& [person, orders] : people)
    for (const auto& [order, n] : orders)
      for (const double stimulus : order) ranked[stimulus].insert(person);
  std::vector<double> stimuli;
  for (const auto& [stimulus, by] : ranked) stimuli.push_back(stimulus);
  const Chains chains(stimuli, people);

  std::vector<PerceivedStimulus> found;
  std::map<double, Scale> scales;  // by the lowest stimulus of those that are linked
  const auto scale_of = [&](double stimulus) -> const Scale& {
    std::vector<double> together;
    std::ranges::copy_if(stimuli, std::back_inserter(together),
                         [&](double other) { return chains.linked(stimulus, other); });
    return scales.try_emplace(together.front(), together, people).first->second;
  };
  for (std::size_t k = 0; k < stimuli.size(); ++k) {
    PerceivedStimulus& one = found.emplace_back(PerceivedStimulus{stimuli[k]});
    if (k == 0) {
      one.from_lowest.n = static_cast<int>(ranked.at(stimuli[k]).size());
      continue;
    }
    const Scale& scale = scale_of(stimuli[k]);
    one.from_lowest = distance_of(chains, scale, ranked, stimuli.front(), stimuli[k]);
    one.from_previous = distance_of(chains, scale, ranked, stimuli[k - 1], stimuli[k]);
  }
  if (std::ranges::any_of(
          found, [](const PerceivedStimulus& one) { return one.from_lowest.value.has_value(); }))
    found.front().from_lowest.value = 0;
  else if (found.size() > 1)
    found.front().from_lowest.why = "no other has a distance to it";
  return found;
}

Contrast perceived_contrast(const PerceivedDistance& from, const PerceivedDistance& to) {
  const auto standard_error = [](const PerceivedDistance& one) {
    return (one.interval->high - one.interval->low) / 2 / student_t_quantile(one.n - 1);
  };
  Contrast contrast{*to.value - *from.value};
  std::set<std::string> people;
  double both = 0, of_from = 0, of_to = 0;
  for (const auto& [person, change] : from.influence) {
    of_from += change * change;
    people.insert(person);
  }
  for (const auto& [person, change] : to.influence) {
    of_to += change * change;
    people.insert(person);
    if (const auto other = from.influence.find(person); other != from.influence.end())
      both += change * other->second;
  }
  constexpr double all_equal = 1e-12;
  const bool have_correlation = std::min(of_from, of_to) > all_equal;
  const double correlation = have_correlation ? both / std::sqrt(of_from * of_to) : 0;
  const double a = standard_error(from), b = standard_error(to);
  contrast.standard_error = std::sqrt(a * a + b * b - 2 * correlation * a * b);
  contrast.n = static_cast<int>(people.size());
  return contrast;
}

}  // namespace heft
