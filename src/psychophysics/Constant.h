// The method of constant stimuli (Fechner 1860; Gescheider 1997, ch. 3): every level equally often,
// in a random order that does not depend on the responses. A threshold requires a fit of a
// psychometric function.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "base/files/Keys.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// blocks: rounds with each level once, each round shuffled; shuffled: all trials shuffled
/// together.
enum class ConstantOrder { blocks, shuffled };
template <>
struct EnumNames<ConstantOrder> {
  static constexpr std::array<std::string_view, 2> names{"blocks", "shuffled"};
};

struct ConstantConfig {
  static constexpr bool estimates_nothing = true;  ///< needs a fit
  static constexpr std::string_view kind = "constant";
  using Procedure = class Constant;

  std::vector<double> levels{};  ///< at least one, all different
  int n_per_level = 1;
  ConstantOrder order = ConstantOrder::blocks;

  ConfigMistakes check() const;
  /// Mistakes if levels are differences from a reference in grams: the comparison's mass must be
  /// positive.
  ConfigMistakes check_beside(double reference, bool either_sign = false) const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, ConstantConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(ConfigKey{"levels", "all levels, each different", true, "constant levels {} g"},
        config.levels, any_number);
  visit(ConfigKey{"n_per_level", "trials of each level", true, "each {} times"}, config.n_per_level,
        WholeRange{1});
  visit(ConfigKey{"order", "shuffled rounds of all levels, or all trials shuffled", false,
                  "order {}"},
        config.order);
}

/// The level of each trial, determined by the stream.
std::vector<double> constant_schedule(const ConstantConfig& config, RandomStream stream);

class Constant {
 public:
  /// @throws InvalidConfig with all that config.check() finds
  explicit Constant(ConstantConfig config) : config_(valid_config(std::move(config))) {}

  /// Undefined after the end.
  double next_level(const RandomStream& stream) const;
  Update respond(const Response& response, double shown);
  std::optional<StopReason> finish() const;
  /// One, with the number of trials and without a value.
  std::vector<Estimate> estimates() const;

  const ConstantConfig& config() const { return config_; }
  std::optional<int> planned_trials() const;
  std::vector<double> planned_levels() const { return config_.levels; }

 private:
  ConstantConfig config_;
  int n_trials_ = 0;
};

}  // namespace heft
