// A bank of simulated participants, and populations as weights over it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/Error.h"
#include "base/Parallel.h"
#include "base/Random.h"
#include "base/files/TextFile.h"
#include "population/ResponderFit.h"
#include "responders/ResponderParameters.h"

namespace heft {

namespace {
constexpr double least_spread = 0.05;  // narrower populations have too few of the bank's people
constexpr double reach = 2.5;          // the bank covers so many spreads beyond a median's bounds

bool is_spread(const std::string& name) {
  return name.ends_with(spread_ending);
}

std::string parameter_of(const std::string& name) {
  return is_spread(name) ? name.substr(0, name.size() - spread_ending.size()) : name;
}

const ParameterRow& row_named(const std::string& name, std::span<const ParameterPart> parts) {
  if (const ParameterRow* row = find_row(name, parts)) return *row;
  throw Error(fmt::format("--free {}: the model has no such parameter; heft doctor --responder "
                          "simulated lists them",
                          name),
              ExitCode::usage);
}

std::optional<double> given_value(const ResponderOptions& options, const std::string& name) {
  for (const Parameter& one : options.parameters)
    if (without_median(one.name) == name)
      if (const auto* number = std::get_if<double>(&one.value)) return *number;
  return std::nullopt;
}

// Radical inverse: evenly spread points in any number of dimensions (Halton 1960).
double halton(int i, int base) {
  double fraction = 1, value = 0;
  for (; i > 0; i /= base) {
    fraction /= base;
    value += fraction * (i % base);
  }
  return value;
}

constexpr std::array primes{2, 3, 5, 7, 11, 13, 17};
}  // namespace

std::optional<std::pair<double, double>> positive_range_in(std::string_view text,
                                                           std::string_view unit) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return std::nullopt;
  const auto number = [&](std::string_view part) {
    if (part.ends_with(unit)) part.remove_suffix(unit.size());
    return number_in(part);
  };
  const auto low = number(text.substr(0, dots)), high = number(text.substr(dots + 2));
  if (!low || !high || !(*low > 0) || !(*high > *low)) return std::nullopt;
  return std::pair(*low, *high);
}

FreeParameter read_free_parameter(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto range =
      equals == std::string::npos ? std::nullopt : positive_range_in(text.substr(equals + 1));
  if (!range)
    throw Error(fmt::format("--free {}: expected NAME=LOW..HIGH with numbers above 0, such as "
                            "criterion_mm=1..20 or criterion_mm.spread=0.1..1",
                            text),
                ExitCode::usage);
  return {text.substr(0, equals), range->first, range->second};
}

void Bank::plan(const Request& request) {
  const ResolvedModel& model = request.config->model;
  if (request.free.empty() || request.free.size() > primes.size())
    throw Error("expected one to seven --free parameters", ExitCode::usage);
  free_ = request.free;
  places_ = request.places;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const std::string name = parameter_of(free_[i].name);
    const ParameterRow& row = row_named(name, model.entry->parts);
    auto drawn = std::ranges::find(drawn_, name, &Drawn::name);
    if (drawn == drawn_.end()) {
      Drawn one;
      one.name = name;
      one.fixed_median = given_value(model.options, name).value_or(row.value);
      one.fixed_spread = given_value(model.options, name + ".spread").value_or(row.spread);
      drawn_.push_back(one);
      drawn = drawn_.end() - 1;
    }
    int& at = is_spread(free_[i].name) ? drawn->spread : drawn->median;
    if (at >= 0)
      throw Error(fmt::format("--free {} is given twice", free_[i].name), ExitCode::usage);
    at = static_cast<int>(i);
    if (!is_spread(free_[i].name) && (free_[i].low < row.least || free_[i].high > row.most))
      throw Error(fmt::format("--free {}: {:g}..{:g}, expected bounds within {:g} to {:g} ({})",
                              name, free_[i].low, free_[i].high, row.least, row.most, row.unit),
                  ExitCode::usage);
  }
  for (Drawn& one : drawn_) {
    const ParameterRow& row = row_named(one.name, model.entry->parts);
    const auto bounds = [&](int index, double fixed) {
      if (index < 0) return std::pair(fixed, fixed);
      const FreeParameter& free = free_[static_cast<std::size_t>(index)];
      return std::pair(free.low, free.high);
    };
    const auto [low, high] = bounds(one.median, one.fixed_median);
    const auto spread = std::max(bounds(one.spread, one.fixed_spread).second, least_spread);
    if (!(low > 0))
      throw Error(fmt::format("--free {0}.spread: the median of {0} is 0; give it in the model's "
                              "file, or free it too",
                              one.name),
                  ExitCode::usage);
    one.low = std::log(std::max(low * std::exp(-reach * spread), std::max(row.least, 1e-9)));
    one.high = std::log(std::min(high * std::exp(reach * spread), row.most));
  }
}

std::optional<Bank> Bank::simulate(const Request& request,
                                   const std::function<void(double)>& progress,
                                   const std::atomic<bool>& stop) {
  Bank bank;
  bank.plan(request);
  const auto n_drawn = static_cast<Eigen::Index>(bank.drawn_.size());
  const auto n_places = static_cast<Eigen::Index>(request.places.size());
  bank.logs_.resize(request.people, n_drawn);
  bank.figures_.setConstant(request.people, n_places, std::numeric_limits<double>::quiet_NaN());
  bank.answers_.resize(request.people, static_cast<Eigen::Index>(request.logged.size()));
  const ResolvedModel& model = request.config->model;

  const auto simulate_one = [&](int i) {
    ResponderOptions options = model.options;
    options.seed =
        RandomStream(request.config->seed, "bank", static_cast<std::uint64_t>(i)).bits() >> 1;
    for (Eigen::Index k = 0; k < n_drawn; ++k) {
      const Drawn& drawn = bank.drawn_[static_cast<std::size_t>(k)];
      const double u = halton(i + 1, primes[static_cast<std::size_t>(k)]);
      bank.logs_(i, k) = drawn.low + u * (drawn.high - drawn.low);
      std::erase_if(options.parameters, [&](const Parameter& one) {
        return without_median(parameter_of(one.name)) == drawn.name;
      });
      options.parameters.push_back({drawn.name, std::exp(bank.logs_(i, k)), {}});
      options.parameters.push_back({drawn.name + ".spread", 0.0, {}});
    }
    const auto responder = model.entry->make(options);
    if (!request.logged.empty()) {
      const AnswerCounts answers = answers_of_one(request.config, *responder, options.seed);
      for (Eigen::Index k = 0; k < bank.answers_.cols(); ++k)
        bank.answers_(i, k) = log_likelihood(request.logged[static_cast<std::size_t>(k)], answers);
      return;
    }
    const auto figures = figures_of_one(request.config, *responder, options.seed, request.places);
    for (Eigen::Index f = 0; f < n_places; ++f)
      if (const auto value = figures[static_cast<std::size_t>(f)]) bank.figures_(i, f) = *value;
  };
  const auto work = [&](int i) {
    if (!stop) simulate_one(i);
    return !stop;
  };
  if (!run_jobs(request.people, request.jobs, work, progress)) return std::nullopt;
  return bank;
}

Eigen::ArrayXd Bank::weights(const Parameters& at) const {
  Eigen::ArrayXd exponents = Eigen::ArrayXd::Zero(logs_.rows());
  for (std::size_t k = 0; k < drawn_.size(); ++k) {
    const Drawn& drawn = drawn_[k];
    const double median = drawn.median < 0 ? drawn.fixed_median : at[drawn.median];
    const double spread =
        std::max(drawn.spread < 0 ? drawn.fixed_spread : at[drawn.spread], least_spread);
    exponents -=
        ((logs_.col(static_cast<Eigen::Index>(k)).array() - std::log(median)) / spread).square() /
        2;
  }
  return (exponents - exponents.maxCoeff()).exp();
}

Bank::AnswersLikelihood Bank::of_answers(const Parameters& at) const {
  const Eigen::ArrayXd density = weights(at);
  AnswersLikelihood found{0, static_cast<double>(people())};
  for (Eigen::Index k = 0; k < answers_.cols(); ++k) {
    const double most = answers_.col(k).maxCoeff();
    const Eigen::ArrayXd fitting = density * (answers_.col(k).array() - most).exp();
    found.log_likelihood += most + std::log(fitting.sum() / density.sum());
    found.effective =
        std::min(found.effective, fitting.sum() * fitting.sum() / fitting.square().sum());
  }
  return found;
}

void Bank::moments(const Parameters& at, std::vector<Moments>& moments) const {
  const Eigen::ArrayXd weights = this->weights(at);
  moments.assign(places_.size(), {});
  for (std::size_t f = 0; f < places_.size(); ++f) {
    const auto column = figures_.col(static_cast<Eigen::Index>(f)).array();
    double sum = 0, squares = 0, first = 0;
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      if (std::isnan(column[i])) continue;
      sum += weights[i];
      squares += weights[i] * weights[i];
      first += weights[i] * column[i];
    }
    Moments& of = moments[f];
    of.mean = first / sum;  // NaN where no one has the figure
    if (!(sum > 0)) continue;
    double second = 0, fourth = 0;
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      if (std::isnan(column[i])) continue;
      const double square = (column[i] - of.mean) * (column[i] - of.mean);
      second += weights[i] * square;
      fourth += weights[i] * square * square;
    }
    of.effective = sum * sum / squares;
    of.sd = std::sqrt(second / sum);
    if (second > 0) of.kurtosis = fourth / sum / (second / sum * second / sum);
  }
}

}  // namespace heft
