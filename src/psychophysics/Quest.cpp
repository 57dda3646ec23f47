#include "psychophysics/Quest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace heft {

namespace {
constexpr int most_grains = 20'000;

// p(x) of Quest.h at x - T = from_threshold, without xT.
double positive_share(const QuestConfig& config, double from_threshold) {
  return config.delta * config.gamma +
         (1 - config.delta) *
             (1 - (1 - config.gamma) * std::exp(-std::pow(10, config.beta * from_threshold)));
}

// At -2 half_size ... 2 half_size grains.
std::vector<double> shares(const QuestConfig& config, double shift) {
  std::vector<double> shares;
  const int n = 2 * config.half_size();
  for (int i = -n; i <= n; ++i) shares.push_back(positive_share(config, i * config.grain + shift));
  return shares;
}

// Interpolated in the table as QuestRecompute does, without the places where it is flat.
double shift_to_p_threshold(const QuestConfig& config) {
  const std::vector<double> table = shares(config, 0);
  const int n = 2 * config.half_size();
  std::size_t before = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (table[i] == table[i - 1]) continue;
    if (table[i] >= config.p_threshold) {
      before = i - 1;
      break;
    }
  }
  const double fraction =
      (config.p_threshold - table[before]) / (table[before + 1] - table[before]);
  return (static_cast<double>(before) - n + fraction) * config.grain;
}

// The quantile whose response is the most informative (Pelli 1987), as QuestRecompute computes it.
double best_quantile_order(double lowest, double highest) {
  constexpr double eps = 1e-14;
  const double entropy_change = highest * std::log(highest + eps) -
                                lowest * std::log(lowest + eps) +
                                (1 - highest + eps) * std::log(1 - highest + eps) -
                                (1 - lowest + eps) * std::log(1 - lowest + eps);
  const double share = 1 / (1 + std::exp(entropy_change / (lowest - highest)));
  return (share - lowest) / (highest - lowest);
}

std::vector<double> grid_of(const QuestConfig& config) {
  std::vector<double> values;
  for (int i = -config.half_size(); i <= config.half_size(); ++i)
    values.push_back(config.guess + i * config.grain);
  return values;
}

std::vector<double> log_prior(const QuestConfig& config) {
  std::vector<double> logs;
  for (int i = -config.half_size(); i <= config.half_size(); ++i) {
    const double z = i * config.grain / config.guess_sd;
    logs.push_back(-z * z / 2);
  }
  return logs;
}

double within(double level, std::optional<double> floor, std::optional<double> ceiling) {
  if (floor) level = std::max(level, *floor);
  if (ceiling) level = std::min(level, *ceiling);
  return level;
}
}  // namespace

int QuestConfig::half_size() const {
  constexpr double default_grains = 500;
  return static_cast<int>(std::ceil((range ? *range / grain : default_grains) / 2));
}

ConfigMistakes QuestConfig::check() const {
  ConfigMistakes mistakes = out_of_range(*this);
  if (!mistakes.empty()) return mistakes;
  if (range && (*range > grain * most_grains || *range < 2 * grain))
    return {{{"range", "grain"},
             fmt::format("range is {} and grain {}", *range, grain),
             fmt::format("2 to {} grains", most_grains)}};
  const int n = 2 * half_size();
  const double lowest = positive_share(*this, -n * grain),
               highest = positive_share(*this, n * grain);
  if (p_threshold <= lowest || p_threshold >= highest)
    mistakes.push_back({{"p_threshold", "gamma", "delta", "beta", "range"},
                        fmt::format("p_threshold is {}", p_threshold),
                        fmt::format("between the function's ends on the grid, {:.4g} and {:.4g}",
                                    lowest, highest)});
  if (floor && ceiling && *floor >= *ceiling)
    mistakes.push_back({{"floor", "ceiling"},
                        fmt::format("floor is {}", *floor),
                        fmt::format("below the ceiling {}", *ceiling)});
  if (start && within(*start, floor, ceiling) != *start)
    mistakes.push_back({{"start"}, fmt::format("start is {}", *start), "within floor and ceiling"});
  return mistakes;
}

ConfigMistakes QuestConfig::check_beside(double reference, bool either_sign) const {
  if (either_sign && floor && *floor > -reference) return {};
  if (floor && *floor >= 0) return {};
  return {{{"floor"},
           floor ? fmt::format("floor is {}", *floor) : std::string(R"(lacks "floor")"),
           fmt::format("0 or more: for a comparison lighter than the reference of {} g a positive "
                       "response has the opposite meaning",
                       reference)}};
}

Quest::Quest(QuestConfig config)
    : config_(valid_config(std::move(config))),
      log_weights_(log_prior(config_)),
      threshold_{grid_of(config_), log_weights_.weights()} {
  const std::vector<double> positive = shares(config_, shift_to_p_threshold(config_));
  best_order_ = best_quantile_order(positive.front(), positive.back());
  for (const double p : positive) {
    log_likelihood_[0].push_back(1 - p);
    log_likelihood_[1].push_back(p);
  }
  for (auto& log_likelihood : log_likelihood_) take_finite_log(log_likelihood);
  first_level_ = next_level_ = config_.start ? *config_.start : placed();
}

Update Quest::respond(const Response& response, double shown) {
  assert(!finish_);
  ++n_trials_;
  const int n = config_.half_size();
  const double grains = std::round((shown - config_.guess) / config_.grain);
  const int shift = static_cast<int>(std::clamp(grains, -1.0 * n, 1.0 * n));
  const std::vector<double>& log_likelihood = log_likelihood_[response.positive ? 1 : 0];
  std::vector<double> at_thresholds;
  for (int i = -n; i <= n; ++i)
    at_thresholds.push_back(log_likelihood[static_cast<std::size_t>(shift - i + 2 * n)]);
  log_weights_.add(at_thresholds);
  threshold_.weights = log_weights_.weights();
  evidence_.add({!response.positive, response.positive, false});
  finish_ = stop().after(n_trials_, [this] { return estimate(); });
  if (!finish_) next_level_ = placed();
  return {std::nullopt, finish_};
}

double Quest::mode() const {
  const auto& weights = threshold_.weights;
  const auto most = std::max_element(weights.begin(), weights.end());
  return threshold_.values[static_cast<std::size_t>(most - weights.begin())];
}

double Quest::quantile(std::optional<double> order) const {
  return threshold_.quantile(order.value_or(best_order_));
}

double Quest::placed() const {
  const double level = config_.placement == QuestPlacement::quantile ? quantile()
                       : config_.placement == QuestPlacement::mean   ? threshold_.mean()
                                                                     : mode();
  return within(level, config_.floor, config_.ceiling);
}

Estimate Quest::estimate() const {
  Estimate estimate =
      threshold_estimate(threshold_, evidence_.for_model(log_weights_.log_evidence()));
  estimate.method = QuestConfig::kind;
  estimate.n_trials = n_trials_;
  return estimate;
}

std::vector<Estimate> Quest::estimates() const {
  return {estimate()};
}

std::vector<ParameterPosterior> Quest::posterior() const {
  return {{"threshold", threshold_.mean(), threshold_.sd(), mode(), threshold_.low(),
           threshold_.high()}};
}

std::optional<int> Quest::planned_trials() const {
  return stop().planned_trials();
}

std::vector<double> Quest::planned_levels() const {
  return {first_level_};
}

}  // namespace heft
