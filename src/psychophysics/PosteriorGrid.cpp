#include "psychophysics/PosteriorGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace heft {

namespace {
constexpr std::size_t n_parameters = 4;

double times_log(double p) {
  return p > 0 ? p * std::log(p) : 0;
}

// Each level has its own sum, so that the compiler can add several levels at a time.
void add_scaled(std::vector<double>& sums, double weight, const float* row) {
  for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += weight * static_cast<double>(row[x]);
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

LikelihoodTable::LikelihoodTable(GridSpace space)
    : space_(std::move(space)), n_points_(space_.n_points()), n_nuisance_(1) {
  std::size_t stride = 1;
  for (const bool nuisance : {true, false})
    for (std::size_t i = n_parameters; i-- > 0;) {
      if (space_.is_nuisance[i] != nuisance) continue;
      stride_[i] = stride;
      stride *= space_.parameters[i].size();
      if (nuisance) n_nuisance_ = stride;
    }
  const std::size_t n_outcomes = space_.model.n_outcomes();
  n_rows_ = n_outcomes - (n_nuisance_ > 1 ? 1 : 0);
  table_.resize(n_points_ * n_rows_ * space_.levels.size());
  auto place = table_.begin();
  visit_points(space_.levels, [&](std::size_t, const std::vector<OutcomeShares>& shares) {
    for (std::size_t k = 1; k < n_outcomes; ++k)
      for (const OutcomeShares& at_level : shares) *place++ = static_cast<float>(at_level[k]);
    if (n_nuisance_ > 1) return;
    for (const OutcomeShares& at_level : shares) {
      double entropy = 0;
      for (const double p : at_level) entropy -= times_log(p);
      *place++ = static_cast<float>(entropy);
    }
  });
}

ParameterValues LikelihoodTable::point(std::size_t i) const {
  ParameterValues values;
  for (std::size_t k = 0; k < n_parameters; ++k) values[k] = space_.parameters[k][position(i, k)];
  return values;
}

// Attentive shares are computed once for successive points that differ in guesses and lapses only.
template <typename Visit>
void LikelihoodTable::visit_points(const std::vector<double>& levels, const Visit& visit) const {
  std::vector<OutcomeShares> attentive(levels.size()), shares(levels.size());
  ParameterValues before{};
  for (std::size_t i = 0; i < n_points_; ++i) {
    const ParameterValues values = point(i);
    if (i == 0 || !space_.model.same_when_attentive(values, before))
      for (std::size_t x = 0; x < levels.size(); ++x)
        attentive[x] = space_.model.attentive(values, levels[x]);
    before = values;
    const OutcomeShares fixed = space_.model.inattentive(values);
    const double attention = 1 - fixed[0] - fixed[1] - fixed[2];
    for (std::size_t x = 0; x < levels.size(); ++x)
      for (std::size_t k = 0; k < fixed.size(); ++k)
        shares[x][k] = fixed[k] + attention * attentive[x][k];
    visit(i, shares);
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
  visit_points({level}, [&](std::size_t i, const std::vector<OutcomeShares>& shares) {
    double p = 0;
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      if (outcomes[k]) p += shares[0][k];
    (*log_likelihood)[i] = finite_log(p);
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

std::vector<double> PosteriorGrid::expected_entropies() const {
  std::vector<double> expected(table_->space().levels.size());
  table_->n_nuisance() > 1 ? add_marginal(expected) : add_joint(expected);
  return expected;
}

// The entropy after a trial is the entropy before, minus the information in its outcome: the
// entropy of the outcome, minus its expected entropy where the parameters are known.
void PosteriorGrid::add_joint(std::vector<double>& expected) const {
  const std::size_t n_levels = expected.size(), n_outcomes = table_->space().model.n_outcomes();
  std::vector<double> second(n_levels), third(n_levels);
  double entropy = 0;
  for (std::size_t i = 0; i < weights().size(); ++i) {
    const double weight = weights()[i];
    if (weight == 0) continue;
    entropy -= times_log(weight);
    add_scaled(second, weight, table_->outcome(i, 1));
    if (n_outcomes > 2) add_scaled(third, weight, table_->outcome(i, 2));
    add_scaled(expected, weight, table_->entropy(i));
  }
  for (std::size_t x = 0; x < n_levels; ++x) {
    const double first = 1 - second[x] - third[x];
    expected[x] += entropy + times_log(first) + times_log(second[x]) + times_log(third[x]);
  }
}

void PosteriorGrid::add_marginal(std::vector<double>& expected) const {
  const std::size_t n_levels = expected.size(), n_outcomes = table_->space().model.n_outcomes();
  const std::size_t n_nuisance = table_->n_nuisance();
  std::vector<double> all_second(n_levels), all_third(n_levels), second(n_levels), third(n_levels);
  for (std::size_t first_point = 0; first_point < weights().size(); first_point += n_nuisance) {
    double total = 0;
    std::fill(second.begin(), second.end(), 0.0);
    std::fill(third.begin(), third.end(), 0.0);
    for (std::size_t i = first_point; i < first_point + n_nuisance; ++i) {
      const double weight = weights()[i];
      if (weight == 0) continue;
      total += weight;
      add_scaled(second, weight, table_->outcome(i, 1));
      if (n_outcomes > 2) add_scaled(third, weight, table_->outcome(i, 2));
    }
    if (total == 0) continue;
    for (std::size_t x = 0; x < n_levels; ++x) {
      expected[x] -=
          times_log(total - second[x] - third[x]) + times_log(second[x]) + times_log(third[x]);
      all_second[x] += second[x];
      all_third[x] += third[x];
    }
  }
  for (std::size_t x = 0; x < n_levels; ++x)
    expected[x] += times_log(1 - all_second[x] - all_third[x]) + times_log(all_second[x]) +
                   times_log(all_third[x]);
}

double PosteriorGrid::best_level() const {
  constexpr double as_good = 1e-7;  // nats
  const std::vector<double> expected = expected_entropies();
  const double least = *std::min_element(expected.begin(), expected.end());
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
