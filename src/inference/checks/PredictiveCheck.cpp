#include "inference/checks/PredictiveCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/Parallel.h"

namespace heft {

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : unknown;
}

struct Shares {
  double n = 0, heavier = 0, lighter = 0, none = 0;
  void add(const MadeChoice& choice) {
    n += 1;
    heavier += choice.heavier() ? 1 : 0;
    lighter += choice.lighter() ? 1 : 0;
    none += choice.choice == Choice::none ? 1 : 0;
  }
};

// The finite values: some people or studies have no figure.
std::vector<double> known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

double known_sd(const std::vector<double>& values) {
  return sample_sd(known(values)).value_or(unknown);
}

double known_kurtosis(const std::vector<double>& all) {
  const std::vector<double> values = known(all);
  const double center = mean(values).value_or(0);
  double square = 0, fourth = 0;
  for (const double value : values) {
    const double from_mean = value - center;
    square += from_mean * from_mean;
    fourth += from_mean * from_mean * from_mean * from_mean;
  }
  return ratio(static_cast<double>(values.size()) * fourth, square * square);
}

// Begins with a space; empty if there is only one range.
std::string range_name(std::span<const double> edges_g, std::size_t range) {
  if (edges_g.empty()) return "";
  if (range == 0) return fmt::format(" up to {:.0f} g", edges_g.front());
  if (range == edges_g.size()) return fmt::format(" from {:.0f} g", edges_g.back());
  return fmt::format(" from {:.0f} to {:.0f} g", edges_g[range - 1], edges_g[range]);
}

// The figures of one study, observed or simulated, that are compared.
class StudyTally {
 public:
  explicit StudyTally(std::span<const double> edges_g)
      : edges_g_(edges_g), by_level_(edges_g.size() + 1) {}

  void add_staircase(const std::vector<MadeChoice>& choices, const Procedure& ended,
                     const std::vector<double>& reversals_g) {
    double first_g = 0, second_g = 0;
    const std::size_t half = choices.size() / 2;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      const MadeChoice& made = choices[i];
      by_level_[level_range(made.level_g)].add(made);
      person_.add(made);
      level_sum_g_ += std::abs(made.level_g);
      if (i < half) {
        first_half_.add(made);
        first_g += made.level_g;
      } else {
        second_half_.add(made);
        second_g += made.level_g;
      }
    }
    if (half > 0) {
      drift_g_ += second_g / static_cast<double>(choices.size() - half) -
                  first_g / static_cast<double>(half);
      n_drifts_ += 1;
    }
    for (const double level_g : reversals_g) reversal_g_ += level_g;
    n_reversals_ += static_cast<double>(reversals_g.size());
    n_trials_ += static_cast<double>(choices.size());
    const auto estimates = ended.estimates();
    if (estimates.empty() || !estimates.front().value) return;
    jnd_g_ += *estimates.front().value;
    n_jnds_ += 1;
  }
  void add_catch(int n, int n_none) {
    n_catch_ += n;
    n_catch_none_ += n_none;
    Shares& at_0 = by_level_[level_range(0)];
    at_0.n += n;
    at_0.none += n_none;
  }
  void end_person() {
    levels_g_.push_back(ratio(level_sum_g_, person_.n));
    nones_.push_back(ratio(person_.none, person_.n));
    lighters_.push_back(ratio(person_.lighter, person_.lighter + person_.heavier));
    jnds_g_.push_back(ratio(jnd_g_, n_jnds_));
    person_ = {};
    level_sum_g_ = jnd_g_ = n_jnds_ = 0;
  }

  const std::vector<Shares>& by_level() const { return by_level_; }
  std::vector<double> figures() const {
    std::vector<double> all;
    for (const Shares& here : by_level_) {
      all.push_back(ratio(here.none, here.n));
      all.push_back(ratio(here.lighter, here.n));
    }
    for (const auto& [name, value] : of_all_levels) all.push_back(value(*this));
    return all;
  }
  /// Names of figures(), in the same order.
  static std::vector<std::string> names(std::span<const double> edges_g) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i <= edges_g.size(); ++i) {
      const std::string where = range_name(edges_g, i);
      all.push_back("share of \"no difference\"" + where);
      all.push_back("share of incorrect choices" + where);
    }
    for (const auto& [name, value] : of_all_levels) all.emplace_back(name);
    return all;
  }

 private:
  struct OfAllLevels {
    std::string_view name;
    double (*value)(const StudyTally& study);
  };
  static const std::array<OfAllLevels, 14> of_all_levels;

  std::size_t level_range(double level_g) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(edges_g_, level_g) - edges_g_.begin());
  }

  std::span<const double> edges_g_;
  std::vector<Shares> by_level_;
  Shares first_half_, second_half_, person_;
  double level_sum_g_ = 0, jnd_g_ = 0, n_jnds_ = 0;  // of this person
  double drift_g_ = 0, n_drifts_ = 0, reversal_g_ = 0, n_reversals_ = 0, n_trials_ = 0;
  double n_catch_ = 0, n_catch_none_ = 0;
  std::vector<double> levels_g_, nones_, lighters_, jnds_g_;  // by person
};

constexpr std::array<StudyTally::OfAllLevels, 14> StudyTally::of_all_levels{{
    {"share of \"no difference\" in catch trials",
     [](const StudyTally& of) { return ratio(of.n_catch_none_, of.n_catch_); }},
    {"mean level of reversals (g)",
     [](const StudyTally& of) { return ratio(of.reversal_g_, of.n_reversals_); }},
    {"mean JND by the paper's rule (g)",
     [](const StudyTally& of) { return mean(known(of.jnds_g_)).value_or(unknown); }},
    {"number of trials", [](const StudyTally& of) { return of.n_trials_; }},
    {"SD between people of their mean level (g)",
     [](const StudyTally& of) { return known_sd(of.levels_g_); }},
    {"kurtosis between people of their mean level",
     [](const StudyTally& of) { return known_kurtosis(of.levels_g_); }},
    {"SD between people of their share of \"no difference\"",
     [](const StudyTally& of) { return known_sd(of.nones_); }},
    {"kurtosis between people of their share of \"no difference\"",
     [](const StudyTally& of) { return known_kurtosis(of.nones_); }},
    {"SD between people of the share of incorrect ones among their choices",
     [](const StudyTally& of) { return known_sd(of.lighters_); }},
    {"kurtosis between people of the share of incorrect ones among their choices",
     [](const StudyTally& of) { return known_kurtosis(of.lighters_); }},
    {"SD between people of their JND (g)",
     [](const StudyTally& of) { return known_sd(of.jnds_g_); }},
    {"change of level from the first to the second half of a staircase (g)",
     [](const StudyTally& of) { return ratio(of.drift_g_, of.n_drifts_); }},
    {"change of the share of \"no difference\" from the first to the second half",
     [](const StudyTally& of) {
       return ratio(of.second_half_.none, of.second_half_.n) -
              ratio(of.first_half_.none, of.first_half_.n);
     }},
    {"change of the share of incorrect choices from the first to the second half",
     [](const StudyTally& of) {
       return ratio(of.second_half_.lighter, of.second_half_.n) -
              ratio(of.first_half_.lighter, of.first_half_.n);
     }},
}};

// Runs a staircase from its first trial with given choices, and adds it to the tally at its end.
class Walk {
 public:
  Walk(const StaircaseRun& run, StudyTally& tally) : run_(run), tally_(tally) {}
  ~Walk() { tally_.add_staircase(choices_, procedure_, reversals_g_); }
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  bool finished() const { return procedure_.finished(); }
  std::size_t n() const { return choices_.size(); }
  double next_level_g(const RandomStream& stream) const { return procedure_.next_level(stream); }
  void respond(const MadeChoice& made) {
    Response response = response_of(made.choice);
    if (run_.correct_choices) response.positive = made.heavier();
    if (const Update update = procedure_.respond(response, made.level_g); update.reversal)
      reversals_g_.push_back(update.reversal->level);
    choices_.push_back(made);
  }

 private:
  const StaircaseRun& run_;
  StudyTally& tally_;
  Procedure procedure_ = *run_.before;
  std::vector<MadeChoice> choices_;
  std::vector<double> reversals_g_;
};

/// @return whether it ended
bool walk_again(const StaircaseRun& run, StudyTally& tally) {
  Walk walk(run, tally);
  for (const MadeChoice& made : run.choices)
    if (!walk.finished()) walk.respond(made);
  return walk.finished();
}

class SimulatedStudy {
 public:
  SimulatedStudy(const MixedFit& fit, std::uint64_t seed, std::uint64_t number)
      : fit_(fit), stream_(seed, "predictive check", number), levels_(seed, "levels", number) {}

  void add_person() {
    const double rho = *fit_.correlation, z = stream_.normal();
    const double other = rho * z + std::sqrt(1 - rho * rho) * stream_.normal();
    person_ = {fit_.sensitivity->value * std::exp(*fit_.sd_log_sensitivity * z),
               fit_.indecision->value * std::exp(*fit_.sd_log_indecision * other),
               *fit_.sd_bias * stream_.normal(), fit_.lapse->value};
  }
  // The comparison is on either side, and a bias is for a side.
  Choice choose(double level_g) {
    if (stream_.coin(0.5)) person_.bias = -person_.bias;
    const IndecisionShares shares = indecision_shares(person_, level_g);
    const double u = stream_.uniform();
    return u < shares.reference                 ? Choice::reference
           : u < shares.reference + shares.none ? Choice::none
                                                : Choice::comparison;
  }
  // Runs until the staircase ends; if the person's staircase did not end, for as many trials.
  void run(const StaircaseRun& run, bool ended, StudyTally& tally) {
    const std::size_t most = ended ? 1000 + 10 * run.choices.size() : run.choices.size();
    Walk walk(run, tally);
    while (!walk.finished() && walk.n() < most) {
      const double level_g = walk.next_level_g(levels_);
      walk.respond({level_g, choose(level_g)});
    }
  }
  void catch_trials(int n, StudyTally& tally) {
    int n_none = 0;
    for (int i = 0; i < n; ++i) n_none += choose(0) == Choice::none ? 1 : 0;
    tally.add_catch(n, n_none);
  }

 private:
  const MixedFit& fit_;
  RandomStream stream_, levels_;
  IndecisionParameters person_;
};

// Distribution of a figure over studies; unknown for fewer than 20.
struct Distribution {
  double mean = unknown, sd = unknown, low = unknown, high = unknown;
  explicit Distribution(const std::vector<double>& of_studies) {
    std::vector<double> values = known(of_studies);
    if (values.size() < 20) return;
    std::ranges::sort(values);
    mean = *heft::mean(values);
    sd = *sample_sd(values);
    const auto at = [&](double share) {
      const auto last = static_cast<double>(values.size() - 1);
      return values[static_cast<std::size_t>(std::lround(share * last))];
    };
    low = at(0.025);
    high = at(0.975);
  }
};

std::optional<PredictedShares::Band> band(const std::vector<std::vector<Shares>>& studies,
                                          std::size_t place, double Shares::*count) {
  std::vector<double> shares;
  for (const auto& by_level : studies)
    shares.push_back(ratio(by_level[place].*count, by_level[place].n));
  const Distribution of(shares);
  if (!std::isfinite(of.mean)) return std::nullopt;
  return PredictedShares::Band{of.mean, of.low, of.high};
}

// Many studies for few people; 100 for many people or Bayesian procedures, which are slow. 100
// distinguish a share of .05 from .1.
std::size_t studies_for(std::span<const PersonRuns> people) {
  const bool any_bayesian = std::ranges::any_of(people, [](const PersonRuns& person) {
    return std::ranges::any_of(person.staircases,
                               [](const StaircaseRun& run) { return run.before->is_bayesian(); });
  });
  return std::clamp<std::size_t>(100'000 / people.size(), 100, any_bayesian ? 100 : 500);
}

// By person and staircase.
using Ended = std::vector<std::vector<bool>>;

Ended walk_all_again(std::span<const PersonRuns> people, StudyTally& seen) {
  Ended ended;
  for (const PersonRuns& person : people) {
    std::vector<bool>& of_person = ended.emplace_back();
    for (const StaircaseRun& run : person.staircases) of_person.push_back(walk_again(run, seen));
    seen.add_catch(person.n_catch, person.n_catch_none);
    seen.end_person();
  }
  return ended;
}

// By study.
struct PredictedStudies {
  std::vector<std::vector<double>> figures;
  std::vector<std::vector<Shares>> by_level;
};

PredictedStudies simulate_studies(const MixedFit& fit, std::span<const PersonRuns> people,
                                  const Ended& ended, std::span<const double> edges_g,
                                  std::uint64_t seed) {
  const std::size_t n_studies = studies_for(people);
  PredictedStudies predicted{std::vector<std::vector<double>>(n_studies),
                             std::vector<std::vector<Shares>>(n_studies)};
  in_parallel(n_studies, 20, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      SimulatedStudy study(fit, seed, i);
      StudyTally tally(edges_g);
      for (std::size_t k = 0; k < people.size(); ++k) {
        study.add_person();
        for (std::size_t j = 0; j < people[k].staircases.size(); ++j)
          study.run(people[k].staircases[j], ended[k][j], tally);
        study.catch_trials(people[k].n_catch, tally);
        tally.end_person();
      }
      predicted.figures[i] = tally.figures();
      predicted.by_level[i] = tally.by_level();
    }
  });
  return predicted;
}
}  // namespace

const PredictedFigure& PredictiveCheck::farthest() const {
  return *std::ranges::max_element(
      figures, {}, [](const PredictedFigure& one) { return std::abs(one.deviation()); });
}

PredictiveCheck check_predictions(const MixedFit& fit, std::span<const PersonRuns> people,
                                  std::span<const double> edges_g, std::uint64_t seed) {
  StudyTally seen(edges_g);
  const Ended ended = walk_all_again(people, seen);
  const auto [predicted, by_level] = simulate_studies(fit, people, ended, edges_g, seed);
  PredictiveCheck check;
  for (std::size_t place = 0; place < by_level.front().size(); ++place)
    check.by_level.push_back({band(by_level, place, &Shares::heavier),
                              band(by_level, place, &Shares::lighter),
                              band(by_level, place, &Shares::none)});
  const std::vector<double> figures = seen.figures();
  const std::vector<std::string> names = StudyTally::names(edges_g);
  check.farthest_of_studies.resize(predicted.size());
  for (std::size_t i = 0; i < figures.size(); ++i) {
    std::vector<double> values;
    for (const auto& study : predicted) values.push_back(study[i]);
    const Distribution of(values);
    if (!std::isfinite(figures[i]) || !(of.sd > 0)) continue;
    check.figures.push_back({names[i], figures[i], of.mean, of.sd, of.low, of.high});
    for (std::size_t k = 0; k < values.size(); ++k)
      if (std::isfinite(values[k]))
        check.farthest_of_studies[k] =
            std::max(check.farthest_of_studies[k], std::abs(values[k] - of.mean) / of.sd);
  }
  return check;
}

std::vector<double> joint_p(std::span<const PredictiveCheck> checks) {
  std::vector<double> farthest;  // of all checks; as many studies as the smallest has
  for (const PredictiveCheck& check : checks) {
    const std::vector<double>& here = check.farthest_of_studies;
    farthest.resize(farthest.empty() ? here.size() : std::min(farthest.size(), here.size()));
    for (std::size_t i = 0; i < farthest.size(); ++i) farthest[i] = std::max(farthest[i], here[i]);
  }
  std::vector<double> all;
  for (const PredictiveCheck& check : checks) {
    const double seen = std::abs(check.farthest().deviation());
    const auto n_as_far = std::ranges::count_if(farthest, [&](double far) { return far >= seen; });
    all.push_back((1 + static_cast<double>(n_as_far)) / (1 + static_cast<double>(farthest.size())));
  }
  return all;
}

}  // namespace heft
