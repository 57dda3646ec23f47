#include "psychophysics/PosteriorGrid.h"

#include <algorithm>
#include <cmath>

#include "psychophysics/ObserverModels.h"

namespace heft {

namespace {
constexpr std::size_t n_parameters = 4;

double times_log(double p) {
  return p > 0 ? p * std::log(p) : 0;
}

Eigen::ArrayXXd times_log(const Eigen::ArrayXXd& p) {
  return (p > 0).select(p * p.log(), 0);
}
}  // namespace

std::size_t GridSpace::n_points() const {
  std::size_t n = 1;
  for (const auto& values : parameters) n *= values.size();
  return n;
}

std::shared_ptr<const LikelihoodTable> LikelihoodTable::shared(GridSpace space) {
  static std::mutex mutex;
  static std::vector<std::weak_ptr<const LikelihoodTable>> tables;
  const std::lock_guard lock(mutex);
  std::erase_if(tables, [](const auto& table) { return table.expired(); });
  for (const auto& table : tables)
    if (auto held = table.lock(); held && held->space() == space) return held;
  auto made = std::make_shared<const LikelihoodTable>(std::move(space));
  tables.push_back(made);
  return made;
}

namespace {
OutcomeShares mixed(const OutcomeShares& inattentive, OutcomeShares shares) {
  for (std::size_t k = 0; k < shares.size(); ++k)
    shares[k] = inattentive[k] + attention(inattentive) * shares[k];
  return shares;
}

double entropy_of(const OutcomeShares& shares) {
  return -times_log(shares[0]) - times_log(shares[1]) - times_log(shares[2]);
}

// Shares of the outcomes of attentive trials: all that a normal variable cut at two places gives.
std::vector<OutcomeShares> any_attentive() {
  std::vector<OutcomeShares> any;
  for (double low = -6; low <= 6; low += 0.25)
    for (double high = low; high <= 6; high += 0.25)
      any.push_back({normal_cdf(low), normal_cdf(high) - normal_cdf(low), normal_cdf(-high)});
  return any;
}
}  // namespace

LikelihoodTable::LikelihoodTable(GridSpace space)
    : space_(std::move(space)), n_points_(space_.n_points()) {
  order_points();
  inattentive_.reserve(n_points_);
  for (std::size_t i = 0; i < n_points_; ++i)
    inattentive_.push_back(space_.model.inattentive(point(i)));
  std::vector<std::size_t> mixes;
  if (n_nuisance_ == 1) mixes = choose_mixes();
  const std::size_t n_outcomes = space_.model.n_outcomes(), n_levels = space_.levels.size();
  attentive_.reserve(n_points_ / n_alike_ * (n_outcomes - 1) * n_levels);
  entropies_.reserve(n_points_ / n_alike_ * mixes.size() * n_levels);
  visit_attentive(space_.levels, [&](std::size_t i, const std::vector<OutcomeShares>& attentive) {
    for (std::size_t k = 1; k < n_outcomes; ++k)
      for (const OutcomeShares& shares : attentive)
        attentive_.push_back(static_cast<float>(shares[k]));
    for (const std::size_t mix : mixes)
      for (const OutcomeShares& shares : attentive)
        entropies_.push_back(static_cast<float>(entropy_of(mixed(inattentive_[i + mix], shares))));
  });
}

// Nuisance parameters vary fastest; among them and among the others, guesses and lapses do.
void LikelihoodTable::order_points() {
  std::size_t stride = 1;
  bool alike = true;
  for (const bool nuisance : {true, false}) {
    for (std::size_t i = n_parameters; i-- > 0;) {
      if (space_.is_nuisance[i] != nuisance) continue;
      stride_[i] = stride;
      stride *= space_.parameters[i].size();
      alike = alike && i >= space_.model.n_attentive();
      if (alike) n_alike_ = stride;
    }
    if (nuisance) n_nuisance_ = stride;
    alike = alike && n_nuisance_ == 1;  // not beyond a group of nuisance parameters
  }
}

ParameterValues LikelihoodTable::point(std::size_t i) const {
  ParameterValues values;
  for (std::size_t k = 0; k < n_parameters; ++k) values[k] = space_.parameters[k][position(i, k)];
  return values;
}

// The entropy depends so smoothly on the shares of guesses and lapses that the entropies of a few
// mixes give those of all others, in linear combinations, within 1e-8 nats (an interpolative
// decomposition; Cheng et al. 2005). Each mix that is chosen is the one farthest from all
// combinations of those before, by Gram-Schmidt.
std::vector<std::size_t> LikelihoodTable::choose_mixes() {
  constexpr double near_enough = 1e-8;
  const std::vector<OutcomeShares> attentive = any_attentive();
  const auto n_alike = static_cast<Eigen::Index>(n_alike_);
  Eigen::MatrixXd rest(static_cast<Eigen::Index>(attentive.size()), n_alike);
  double* entropy = rest.data();
  for (std::size_t mix = 0; mix < n_alike_; ++mix)
    for (const OutcomeShares& shares : attentive)
      *entropy++ = entropy_of(mixed(inattentive_[mix], shares));

  std::vector<Eigen::Index> chosen;
  Eigen::MatrixXd projections(0, n_alike);
  while (chosen.empty() || rest.cwiseAbs().maxCoeff() > near_enough) {
    rest.colwise().squaredNorm().maxCoeff(&chosen.emplace_back());
    const Eigen::VectorXd direction = rest.col(chosen.back()).normalized();
    projections.conservativeResize(projections.rows() + 1, Eigen::NoChange);
    projections.bottomRows(1) = direction.transpose() * rest;
    rest -= direction * projections.bottomRows(1);
  }
  combinations_ = projections(Eigen::all, chosen).triangularView<Eigen::Upper>().solve(projections);
  return {chosen.begin(), chosen.end()};
}

template <typename Visit>
void LikelihoodTable::visit_attentive(const std::vector<double>& levels, const Visit& visit) const {
  std::vector<OutcomeShares> attentive(levels.size());
  for (std::size_t alike = 0; alike < n_points_; alike += n_alike_) {
    const ParameterValues values = point(alike);
    for (std::size_t x = 0; x < levels.size(); ++x)
      attentive[x] = space_.model.attentive(values, levels[x]);
    visit(alike, attentive);
  }
}

std::shared_ptr<const std::vector<double>> LikelihoodTable::log_likelihood(
    double level, const Response& response) const {
  constexpr std::size_t most_kept = 4'000'000;  // numbers: 32 MB
  const auto outcomes = space_.model.outcomes_of(response);
  {
    const std::lock_guard lock(kept_mutex_);
    if (const auto found = kept_.find({level, outcomes}); found != kept_.end())
      return found->second;
  }
  auto log_likelihood = std::make_shared<std::vector<double>>(n_points_);
  visit_attentive({level}, [&](std::size_t alike, const std::vector<OutcomeShares>& attentive) {
    for (std::size_t i = alike; i < alike + n_alike_; ++i) {
      const OutcomeShares shares = mixed(inattentive_[i], attentive[0]);
      double p = 0;
      for (std::size_t k = 0; k < outcomes.size(); ++k)
        if (outcomes[k]) p += shares[k];
      (*log_likelihood)[i] = finite_log(p);
    }
  });
  const std::lock_guard lock(kept_mutex_);
  if ((kept_.size() + 1) * n_points_ <= most_kept)
    kept_.try_emplace({level, outcomes}, log_likelihood);
  return log_likelihood;
}

PosteriorGrid::PosteriorGrid(std::shared_ptr<const LikelihoodTable> table)
    : table_(std::move(table)), posterior_(std::vector<double>(table_->n_points())) {}

void PosteriorGrid::update(double level, const Response& response) {
  posterior_.add(*table_->log_likelihood(level, response));
}

Eigen::ArrayXd PosteriorGrid::expected_entropies() const {
  return table_->n_nuisance() > 1 ? marginal_entropies() : joint_entropies();
}

// Total weight of some points, and that of their outcomes but the first: a row for each level.
struct PosteriorGrid::Outcomes {
  double total = 0;
  Eigen::ArrayXXd others;

  Eigen::ArrayXd entropy() const {
    return -times_log(total - others.rowwise().sum()) - times_log(others).rowwise().sum();
  }
};

PosteriorGrid::Outcomes PosteriorGrid::outcomes(std::size_t first, std::size_t n) const {
  const std::size_t n_others = table_->space().model.n_outcomes() - 1;
  Outcomes sums;
  sums.others.setZero(static_cast<Eigen::Index>(table_->space().levels.size()),
                      static_cast<Eigen::Index>(n_others));
  OutcomeShares fixed{};
  for (std::size_t alike = first; alike < first + n; alike += table_->n_alike()) {
    double attentive = 0;
    for (std::size_t i = alike; i < alike + table_->n_alike(); ++i) {
      const double weight = weights()[i];
      const OutcomeShares& shares = table_->inattentive(i);
      sums.total += weight;
      for (std::size_t k = 0; k < fixed.size(); ++k) fixed[k] += weight * shares[k];
      attentive += weight * attention(shares);
    }
    if (attentive == 0) continue;
    for (std::size_t k = 1; k <= n_others; ++k)
      sums.others.col(static_cast<Eigen::Index>(k - 1)) +=
          attentive * table_->attentive(alike, k).cast<double>();
  }
  for (std::size_t k = 1; k <= n_others; ++k)
    sums.others.col(static_cast<Eigen::Index>(k - 1)) += fixed[k];
  return sums;
}

// The entropy after a trial is the entropy before, minus the information in its outcome: the
// entropy of the outcome, minus its expected entropy where the parameters are known.
Eigen::ArrayXd PosteriorGrid::joint_entropies() const {
  Eigen::ArrayXd expected = posterior_.entropy() - outcomes(0, weights().size()).entropy();
  const auto n_alike = static_cast<Eigen::Index>(table_->n_alike());
  for (std::size_t i = 0; i < weights().size(); i += table_->n_alike()) {
    const Eigen::Map<const Eigen::VectorXd> alike(&weights()[i], n_alike);
    if ((alike.array() == 0).all()) continue;
    const Eigen::VectorXd of_mixes = table_->combinations() * alike;
    for (Eigen::Index mix = 0; mix < of_mixes.size(); ++mix)
      expected += of_mixes[mix] * table_->entropy(i, static_cast<std::size_t>(mix)).cast<double>();
  }
  return expected;
}

Eigen::ArrayXd PosteriorGrid::marginal_entropies() const {
  const std::size_t n = table_->n_nuisance();
  Outcomes all = outcomes(0, n);
  Eigen::ArrayXd expected = all.entropy();
  for (std::size_t i = n; i < weights().size(); i += n) {
    const Outcomes some = outcomes(i, n);
    if (some.total == 0) continue;
    expected += some.entropy();
    all.total += some.total;
    all.others += some.others;
  }
  return expected - all.entropy();
}

double PosteriorGrid::best_level() const {
  constexpr double as_good = 1e-7;  // nats
  const Eigen::ArrayXd expected = expected_entropies();
  const double least = expected.minCoeff();
  const auto first = std::find_if(expected.begin(), expected.end(),
                                  [&](double entropy) { return entropy <= least + as_good; });
  return table_->space().levels[static_cast<std::size_t>(first - expected.begin())];
}

Marginal PosteriorGrid::marginal(std::size_t parameter) const {
  const std::vector<double>& values = table_->space().parameters[parameter];
  Marginal marginal{values, std::vector<double>(values.size())};
  for (std::size_t i = 0; i < weights().size(); ++i)
    marginal.weights[table_->position(i, parameter)] += weights()[i];
  return marginal;
}

ParameterValues PosteriorGrid::mode() const {
  const auto most = std::max_element(weights().begin(), weights().end());
  return table_->point(static_cast<std::size_t>(most - weights().begin()));
}

}  // namespace heft
