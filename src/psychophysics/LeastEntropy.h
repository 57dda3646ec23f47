// Procedures that present the level of least expected entropy of the posterior distribution:
// QUEST+ (Watson 2017: any parameters of any model) and Psi (Kontsevich & Tyler 1999: threshold and
// slope; with nuisance parameters, that is, marginalized: Prins 2013). The prior is uniform over
// the points of the grid, so that a grid in equal ratios has a log-uniform prior.
//
// Both take the psychometric functions and the indecision model. The estimate is the posterior mean
// of the threshold; of the indecision model, that of the 75 % threshold of forced choices without
// bias, 0.6745 / sensitivity, which does not depend on the criterion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/Random.h"
#include "base/files/Keys.h"
#include "psychophysics/PosteriorGrid.h"

namespace heft {

/// The keys of both kinds.
struct LeastEntropyConfig {
  ResponseFunction function = ResponseFunction::cumulative_normal;
  LevelScale scale = LevelScale::linear;
  ValueGrid levels{};
  ValueGrid threshold{}, slope{}, guess{};        ///< of the psychometric functions
  ValueGrid sensitivity{}, indecision{}, bias{};  ///< of the indecision model
  ValueGrid lapse{};
  std::vector<std::string> nuisance{};  ///< names of parameters
  std::optional<double> start{}, floor{}, ceiling{};
  int stop_trials = 0;
  std::optional<double> stop_ci_width{};

  bool is_indecision() const { return function == ResponseFunction::indecision; }
  ResponseModel model() const { return {function, scale}; }
  /// Grids of the model's parameters, in its order.
  std::array<const ValueGrid*, 4> grids() const;
  /// The grid, without levels beyond floor and ceiling.
  GridSpace space() const;

  ConfigMistakes check_beside(double reference, bool either_sign = false) const;

 protected:
  ConfigMistakes mistakes() const;  ///< of the keys that both kinds have, in range
};

struct QuestPlusConfig : LeastEntropyConfig {
  static constexpr std::string_view kind = "quest_plus";
  using Procedure = class QuestPlus;
  ConfigMistakes check() const;
};

struct PsiConfig : LeastEntropyConfig {
  static constexpr std::string_view kind = "psi";
  using Procedure = class Psi;
  ConfigMistakes check() const;
};

template <typename Config, typename Visit>
requires ConfigOf<Config, QuestPlusConfig> || ConfigOf<Config, PsiConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(ConfigKey{"function", "response model: psychometric function or indecision", true,
                  ConfigOf<Config, PsiConfig> ? "Psi, function {}" : "QUEST+, function {}"},
        config.function);
  visit(ConfigKey{"scale", "unit of levels in the Weibull function"}, config.scale);
  const bool is_ratio = !config.is_indecision() && config.model().psychometric().takes_logarithm();
  visit(
      ConfigKey{"levels", "levels to choose from: a grid, as every parameter", true, "levels {} g"},
      config.levels, is_ratio ? zero_or_more : any_number);
  // Which parameters a file needs depends on the function, see check().
  const auto report = [&](bool of_indecision, std::string_view text) {
    return config.is_indecision() == of_indecision ? text : std::string_view();
  };
  visit(ConfigKey{"threshold", "psychometric functions: with slope, guess and lapse", false,
                  report(false, "threshold {}")},
        config.threshold, is_ratio ? above_zero : any_number);
  visit(ConfigKey{"slope", "spread of the function; exponent of the Weibull function", false,
                  report(false, "slope {}")},
        config.slope, above_zero);
  visit(ConfigKey{"guess", "positive answers far below the threshold", false,
                  report(false, "guess {}")},
        config.guess, Range{0, 1, false, true});
  visit(ConfigKey{"sensitivity", "indecision: noise SDs per unit of level; with", false,
                  report(true, "sensitivity {}")},
        config.sensitivity, above_zero);
  visit(ConfigKey{"indecision", "half-width of the criterion in noise SDs,", false,
                  report(true, "indecision {}")},
        config.indecision, zero_or_more);
  visit(ConfigKey{"bias", "bias to the comparison in noise SDs, and lapse", false,
                  report(true, "bias {}")},
        config.bias, any_number);
  visit(ConfigKey{"lapse", "proportion of lapses", false, "lapse {}"}, config.lapse,
        Range{0, 1, false, true});
  if constexpr (ConfigOf<Config, PsiConfig>)
    visit(ConfigKey{"nuisance", "parameters that levels are not chosen to estimate", false,
                    "nuisance {}"},
          config.nuisance);
  visit(ConfigKey{"start", "first level, if not the one of least expected entropy"}, config.start,
        any_number);
  visit(ConfigKey{"floor", "lowest level"}, config.floor, any_number);
  visit(ConfigKey{"ceiling", "highest level"}, config.ceiling, any_number);
  visit(ConfigKey{"stop_trials", "trials that end it", true, "at most {} trials"},
        config.stop_trials, WholeRange{1, 10'000});
  visit(ConfigKey{"stop_ci_width", "width of the estimate's 95 % interval that ends it", false,
                  "interval width {} g"},
        config.stop_ci_width, above_zero);
}

class LeastEntropy {
 public:
  double next_level(const RandomStream&) const { return next_level_; }
  Update respond(const Response& response, double shown);
  std::optional<StopReason> finish() const { return finish_; }
  std::vector<Estimate> estimates() const;
  std::vector<ParameterPosterior> posterior() const;
  std::optional<int> planned_trials() const;
  int most_trials() const { return stop_.trials; }
  std::vector<double> planned_levels() const;

  const PosteriorGrid& grid() const { return posterior_; }

 protected:
  LeastEntropy(const LeastEntropyConfig& config, std::string_view method);

 private:
  Marginal threshold() const;
  Estimate estimate() const;

  std::string method_;
  PosteriorStop stop_;
  PosteriorGrid posterior_;
  LevelEvidence evidence_;
  double first_level_, next_level_;
  int n_trials_ = 0;
  std::optional<StopReason> finish_;
};

class QuestPlus : public LeastEntropy {
 public:
  /// @throws InvalidConfig with all mistakes of config.check()
  explicit QuestPlus(QuestPlusConfig config);
  const QuestPlusConfig& config() const { return config_; }

 private:
  QuestPlusConfig config_;
};

class Psi : public LeastEntropy {
 public:
  /// @throws InvalidConfig with all mistakes of config.check()
  explicit Psi(PsiConfig config);
  const PsiConfig& config() const { return config_; }

 private:
  PsiConfig config_;
};

}  // namespace heft
