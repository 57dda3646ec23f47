// QUEST (Watson & Pelli 1983), as its authors' program (Psychtoolbox: QuestCreate, QuestUpdate,
// QuestQuantile...): a posterior distribution of the threshold T alone, of a Weibull function of
// log10 intensity with known slope,
//   p(x) = delta gamma + (1 - delta) (1 - (1 - gamma) exp(-10^(beta (x - T + xT)))),
// where xT makes p(T) = p_threshold. The prior is normal. Both are on a grid of spacing `grain`,
// centered on the guess; a level counts as the nearest one of the grid.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "base/files/Keys.h"
#include "psychophysics/Marginal.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// The next level: the most informative quantile of the posterior (Pelli 1987), its mean
/// (King-Smith et al. 1994) or its mode (Watson & Pelli 1983).
enum class QuestPlacement { quantile, mean, mode };
template <>
struct EnumNames<QuestPlacement> {
  static constexpr std::array<std::string_view, 3> names{"quantile", "mean", "mode"};
};

struct QuestConfig {
  static constexpr std::string_view kind = "quest";
  using Procedure = class Quest;

  double guess = 0, guess_sd = 0;  ///< mean and SD of the prior, in the unit of levels
  double p_threshold = 0.82;       ///< proportion of positive responses at the threshold
  double beta = 3.5;               ///< slope, per decade where levels are decimal logarithms
  double delta = 0.01;             ///< proportion of blind responses
  double gamma = 0.5;              ///< positive responses far below the threshold
  double grain = 0.01;             ///< spacing of the grid
  std::optional<double> range{};   ///< width of the grid; none: 500 grains
  QuestPlacement placement = QuestPlacement::quantile;
  std::optional<double> start{}, floor{}, ceiling{};
  int stop_trials = 0;
  std::optional<double> stop_ci_width{};

  /// The grid has 2 of these plus 1 values.
  int half_size() const;
  ConfigMistakes check() const;
  ConfigMistakes check_beside(double reference, bool either_sign = false) const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, QuestConfig>
void visit_keys(Config& config, Visit&& visit) {
  const Range share{0, 1, true, true};
  visit(ConfigKey{"guess", "threshold expected before the first trial", true, "QUEST, guess {} g"},
        config.guess, any_number);
  visit(ConfigKey{"guess_sd", "SD of that guess; better too large", true, "SD {} g"},
        config.guess_sd, above_zero);
  visit(ConfigKey{"p_threshold", "positive answers at the threshold", false, "at p = {}"},
        config.p_threshold, share);
  visit(ConfigKey{"beta", "slope per unit of level", false, "beta {}"}, config.beta, above_zero);
  visit(ConfigKey{"delta", "proportion of blind responses", false, "delta {}"}, config.delta,
        Range{0, 1, false, true});
  visit(ConfigKey{"gamma", "positive answers far below the threshold", false, "gamma {}"},
        config.gamma, Range{0, 1, false, true});
  visit(ConfigKey{"grain", "spacing of the grid of thresholds"}, config.grain, above_zero);
  visit(ConfigKey{"range", "width of that grid, around guess; missing: 500 grains"}, config.range,
        above_zero);
  visit(ConfigKey{"placement", "next level: quantile, mean or mode of the posterior", false, "{}"},
        config.placement);
  visit(ConfigKey{"start", "first level, if not by the placement"}, config.start, any_number);
  visit(ConfigKey{"floor", "lowest level", false, "floor {} g"}, config.floor, any_number);
  visit(ConfigKey{"ceiling", "highest level", false, "ceiling {} g"}, config.ceiling, any_number);
  visit(ConfigKey{"stop_trials", "trials that end it", true, "at most {} trials"},
        config.stop_trials, WholeRange{1, 10'000});
  visit(ConfigKey{"stop_ci_width", "width of the estimate's 95 % interval that ends it", false,
                  "interval width {} g"},
        config.stop_ci_width, above_zero);
}

class Quest {
 public:
  /// @throws InvalidConfig with all mistakes of config.check()
  explicit Quest(QuestConfig config);

  double next_level(const RandomStream&) const { return next_level_; }
  Update respond(const Response& response, double shown);
  std::optional<StopReason> finish() const { return finish_; }
  std::vector<Estimate> estimates() const;
  std::vector<ParameterPosterior> posterior() const;
  std::optional<int> planned_trials() const;
  int most_trials() const { return config_.stop_trials; }
  std::vector<double> planned_levels() const;

  const QuestConfig& config() const { return config_; }
  const Marginal& threshold() const { return threshold_; }
  double mode() const;
  /// Quantile of the posterior. @param order none: QUEST's own
  double quantile(std::optional<double> order = {}) const;

 private:
  double placed() const;
  PosteriorStop stop() const { return {config_.stop_trials, config_.stop_ci_width}; }
  Estimate estimate() const;

  QuestConfig config_;
  /// Log probabilities of a negative and a positive response at levels above the threshold, from
  /// -2 half_size to 2 half_size grains.
  std::array<std::vector<double>, 2> log_likelihood_;
  double best_order_ = 0.5;
  LogWeights log_weights_;
  Marginal threshold_;
  LevelEvidence evidence_{2};
  double first_level_ = 0, next_level_ = 0;
  int n_trials_ = 0;
  std::optional<StopReason> finish_;
};

}  // namespace heft
