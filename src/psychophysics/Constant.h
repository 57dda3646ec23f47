// The method of constant stimuli as a pure value: every level equally often, in an order that was
// drawn before the first answer and that no answer changes (Fechner 1860; Gescheider 1997, ch. 3).
// What the answers say about a threshold is left to a fit of the whole function.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "base/files/Keys.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// blocks: rounds that hold each level once, each shuffled; shuffled: all trials at once.
enum class ConstantOrder { blocks, shuffled };
template <>
struct EnumNames<ConstantOrder> {
  static constexpr std::array<std::string_view, 2> names{"blocks", "shuffled"};
};

struct ConstantConfig {
  static constexpr bool estimates_nothing = true;  ///< its answers are for a fit
  static constexpr std::string_view kind = "constant";
  using Procedure = class Constant;

  std::vector<double> levels{};  ///< different ones, at least one
  int n_per_level = 1;
  ConstantOrder order = ConstantOrder::blocks;

  ConfigMistakes check() const;
  /// Mistakes where levels are differences from a reference: the comparison must weigh something.
  ConfigMistakes check_beside(double reference) const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, ConstantConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(ConfigKey{"levels", "all levels, each different", true, "constant levels {} g"},
        config.levels, any_number);
  visit(ConfigKey{"n_per_level", "times that each comes", true, "each {} times"},
        config.n_per_level, WholeRange{1});
  visit(ConfigKey{"order", "rounds of all levels, or all trials shuffled", false, "order {}"},
        config.order);
}

/// The level of each trial: a function of the stream alone.
std::vector<double> constant_schedule(const ConstantConfig& config, RandomStream stream);

class Constant {
 public:
  /// @throws InvalidConfig with all that config.check() finds
  explicit Constant(ConstantConfig config) : config_(valid_config(std::move(config))) {}

  /// Undefined after the end.
  double next_level(const RandomStream& stream) const;
  Update respond(const Response& response, double shown);
  std::optional<StopReason> finish() const;
  /// One, without a value: its trials are there, a threshold is none without a fit.
  std::vector<Estimate> estimates() const;

  const ConstantConfig& config() const { return config_; }
  std::optional<int> planned_trials() const;
  std::vector<double> planned_levels() const { return config_.levels; }

 private:
  ConstantConfig config_;
  int n_trials_ = 0;
};

}  // namespace heft
