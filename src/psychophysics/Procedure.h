// A procedure of any kind as one value: which level comes next, what an answer does, when it ends
// and what it estimates. Pure: chance comes in as a stream. Files, logs and traces call each
// procedure that runs a "staircase", whatever its kind.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/Random.h"
#include "psychophysics/Constant.h"
#include "psychophysics/ProcedureConfig.h"
#include "psychophysics/UpDown.h"

namespace heft {

template <typename... KindConfig>
struct KindsOfProcedure {
  using Config = std::variant<KindConfig...>;
  using Value = std::variant<typename KindConfig::Procedure...>;
  static constexpr std::array<std::string_view, sizeof...(KindConfig)> names{KindConfig::kind...};

  /// The defaults of the kind of that name, one of `names`.
  static Config defaults(std::string_view name) {
    Config config;
    ((name == KindConfig::kind ? void(config = KindConfig{}) : void()), ...);
    return config;
  }
};

/// The table of kinds; the first is what a file means that names none. A further one is a line
/// here, a file beside this one, and a reader (protocol/KindReaders.h).
using ProcedureKinds = KindsOfProcedure<UpDownConfig, ConstantConfig>;

struct KindConfig : ProcedureKinds::Config {
  using variant::variant;
  KindConfig(const ProcedureKinds::Config& config) : variant(config) {}
};

class Procedure {
 public:
  explicit Procedure(const ProcedureConfig& config);

  const std::string& name() const { return name_; }

  /// The level to present next; the same until an answer comes. Undefined after the end.
  /// @param stream the procedure's own and always the same: level_stream()
  double next_level(const RandomStream& stream) const;

  /// Takes the answer to a trial. Undefined after the end.
  /// @param shown the level really shown, within +-largest_level
  Update respond(const Response& response, double shown);

  bool finished() const { return finish().has_value(); }
  std::optional<Finish> finish() const;  ///< none: it goes on
  /// One a method, whether finished or not.
  std::vector<Estimate> estimates() const;

  int n_trials() const;
  /// How many trials it takes in all; none where that depends on the answers.
  std::optional<int> planned_trials() const;
  /// The levels that are known before any answer: all of a fixed kind, the first of an adaptive
  /// one.
  std::vector<double> planned_levels() const;

 private:
  std::string name_;
  ProcedureKinds::Value value_;
};

/// What the staircase of that name draws its levels from.
RandomStream level_stream(std::uint64_t seed, const std::string& staircase);

}  // namespace heft
