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
using Mix = Eigen::RowVector4d;  // a row of LikelihoodTable::mixes

// The entropy of the outcome, in nats, if attentive trials have these shares.
double entropy_of(const Mix& mix, const OutcomeShares& attentive) {
  double entropy = 0;
  for (std::size_t k = 0; k < attentive.size(); ++k)
    entropy -= times_log(mix[static_cast<Eigen::Index>(k)] + mix[3] * attentive[k]);
  return entropy;
}

// Shares of the outcomes of attentive trials: all that a normal variable cut at two places gives.
std::vector<OutcomeShares> any_attentive() {
  std::vector<OutcomeShares> any;
  for (double low = -6; low <= 6; low += 0.25)
    for (double high = low; high <= 6; high += 0.25)
      any.push_back({normal_cdf(low), normal_cdf(high) - normal_cdf(low), normal_cdf(-high)});
  return any;
}

// Shares and entropies that are as good as 0 are 0: products of smaller ones with weights are
// denormal, and those take a hundred times longer.
float in_table(double value) {
  constexpr double least = 1e-10;
  return value < least ? 0 : static_cast<float>(value);
}
}  // namespace

LikelihoodTable::LikelihoodTable(GridSpace space)
    : space_(std::move(space)), n_points_(space_.n_points()) {
  order_points();
  put_mixes();
  std::vector<Eigen::Index> mixes;
  if (n_nuisance_ == 1) mixes = choose_mixes();
  const auto n_levels = static_cast<Eigen::Index>(space_.levels.size());
  const auto n_mixes = static_cast<Eigen::Index>(mixes.size());
  const std::size_t n_outcomes = space_.model.n_outcomes();
  const Eigen::Index n_groups = static_cast<Eigen::Index>(n_points_) / n_alike_;
  attentive_.resize(n_levels * static_cast<Eigen::Index>(n_outcomes - 1), n_groups);
  entropies_.resize(n_levels, n_mixes * n_groups);
  float *attentive = attentive_.data(), *entropy = entropies_.data();
  visit_attentive(space_.levels, [&](Eigen::Index, const std::vector<OutcomeShares>& at_levels) {
    for (std::size_t k = 1; k < n_outcomes; ++k)
      for (const OutcomeShares& shares : at_levels) *attentive++ = in_table(shares[k]);
    for (const Eigen::Index mix : mixes)
      for (const OutcomeShares& shares : at_levels)
        *entropy++ = in_table(entropy_of(mixes_.row(mix), shares));
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
      if (alike) n_alike_ = static_cast<Eigen::Index>(stride);
    }
    if (nuisance) n_nuisance_ = stride;
    alike = alike && n_nuisance_ == 1;  // not beyond a group of nuisance parameters
  }
}

void LikelihoodTable::put_mixes() {
  Eigen::Index n_mixes = 1;
  for (std::size_t i = space_.model.n_attentive(); i < n_parameters; ++i)
    n_mixes *= static_cast<Eigen::Index>(space_.parameters[i].size());
  mixes_.resize(n_mixes == n_alike_ ? n_alike_ : static_cast<Eigen::Index>(n_points_), 4);
  for (Eigen::Index i = 0; i < mixes_.rows(); ++i) {
    const OutcomeShares shares = space_.model.inattentive(point(static_cast<std::size_t>(i)));
    mixes_.row(i) << shares[0], shares[1], shares[2], attention(shares);
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
std::vector<Eigen::Index> LikelihoodTable::choose_mixes() {
  constexpr double near_enough = 1e-8;
  const std::vector<OutcomeShares> attentive = any_attentive();
  Eigen::MatrixXd rest(static_cast<Eigen::Index>(attentive.size()), n_alike_);
  double* entropy = rest.data();
  for (Eigen::Index mix = 0; mix < n_alike_; ++mix)
    for (const OutcomeShares& shares : attentive) *entropy++ = entropy_of(mixes_.row(mix), shares);

  std::vector<Eigen::Index> chosen;
  Eigen::MatrixXd projections(0, n_alike_);
  while (chosen.empty() || rest.cwiseAbs().maxCoeff() > near_enough) {
    rest.colwise().squaredNorm().maxCoeff(&chosen.emplace_back());
    const Eigen::VectorXd direction = rest.col(chosen.back()).normalized();
    projections.conservativeResize(projections.rows() + 1, Eigen::NoChange);
    projections.bottomRows(1) = direction.transpose() * rest;
    rest -= direction * projections.bottomRows(1);
  }
  combinations_ = projections(Eigen::all, chosen).triangularView<Eigen::Upper>().solve(projections);
  return chosen;
}

// By group of points that are alike.
template <typename Visit>
void LikelihoodTable::visit_attentive(const std::vector<double>& levels, const Visit& visit) const {
  std::vector<OutcomeShares> attentive(levels.size());
  const auto n_alike = static_cast<std::size_t>(n_alike_);
  for (std::size_t i = 0; i < n_points_; i += n_alike) {
    const ParameterValues values = point(i);
    for (std::size_t x = 0; x < levels.size(); ++x)
      attentive[x] = space_.model.attentive(values, levels[x]);
    visit(static_cast<Eigen::Index>(i / n_alike), attentive);
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
  Eigen::Map<Eigen::VectorXd> p(log_likelihood->data(), static_cast<Eigen::Index>(n_points_));
  visit_attentive({level}, [&](Eigen::Index group, const std::vector<OutcomeShares>& attentive) {
    Eigen::Vector4d counted = Eigen::Vector4d::Zero();
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      if (outcomes[k]) {
        counted[static_cast<Eigen::Index>(k)] = 1;
        counted[3] += attentive[0][k];
      }
    p.segment(group * n_alike_, n_alike_) = mixes(group).lazyProduct(counted);
  });
  take_finite_log(*log_likelihood);
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

namespace {
// The table's columns times weights, added up in double precision after every 64 columns.
Eigen::VectorXd sum_of(const Eigen::Ref<const Eigen::MatrixXf>& table,
                       const Eigen::VectorXd& weights) {
  constexpr Eigen::Index at_once = 64;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(table.rows());
  Eigen::VectorXf some(table.rows());
  for (Eigen::Index first = 0; first < weights.size(); first += at_once) {
    some.setZero();
    for (Eigen::Index i = first; i < std::min(first + at_once, weights.size()); ++i)
      if (weights[i] != 0) some += static_cast<float>(weights[i]) * table.col(i);
    sum += some.cast<double>();
  }
  return sum;
}
}  // namespace

// Total weight of some points, and that of their outcomes but the first: a row for each level.
struct PosteriorGrid::Outcomes {
  double total = 0;
  Eigen::ArrayXXd others;

  Eigen::ArrayXd entropy() const {
    return -times_log(total - others.rowwise().sum()) - times_log(others).rowwise().sum();
  }
};

// Of groups of points that are alike.
PosteriorGrid::Outcomes PosteriorGrid::outcomes(Eigen::Index first, Eigen::Index n) const {
  Eigen::Matrix4Xd shares(4, n);  // as in a table's mixes
  for (Eigen::Index i = 0; i < n; ++i)
    shares.col(i) = table_->mixes(first + i).transpose().lazyProduct(groups().col(first + i));
  const Eigen::Vector4d all = shares.rowwise().sum();
  const Eigen::VectorXd attentive =
      sum_of(table_->attentive().middleCols(first, n), shares.row(3).transpose());
  const auto n_levels = static_cast<Eigen::Index>(table_->space().levels.size());
  Outcomes sums{all.sum(), attentive.reshaped(n_levels, attentive.size() / n_levels)};
  sums.others.rowwise() += all.segment(1, sums.others.cols()).transpose().array();
  return sums;
}

// The entropy after a trial is the entropy before, minus the information in its outcome: the
// entropy of the outcome, minus its expected entropy where the parameters are known.
Eigen::ArrayXd PosteriorGrid::joint_entropies() const {
  const Eigen::MatrixXd of_mixes = table_->combinations() * groups();
  return posterior_.entropy() - outcomes(0, groups().cols()).entropy() +
         sum_of(table_->entropies(), of_mixes.reshaped()).array();
}

Eigen::ArrayXd PosteriorGrid::marginal_entropies() const {
  const Eigen::Index n = static_cast<Eigen::Index>(table_->n_nuisance()) / table_->n_alike();
  Outcomes all = outcomes(0, n);
  Eigen::ArrayXd expected = all.entropy();
  for (Eigen::Index i = n; i < groups().cols(); i += n) {
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
