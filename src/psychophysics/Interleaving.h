// Interleaving: the staircase that the next trial belongs to, and whole runs of several.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "base/files/Keys.h"
#include "psychophysics/Procedure.h"

namespace heft {

/// Uniform draw among the unfinished staircases; each in turn, in file order; one after the other.
enum class Interleave { random, round_robin, sequential };
template <>
struct EnumNames<Interleave> {
  static constexpr std::array<std::string_view, 3> names{"random", "round_robin", "sequential"};
};

struct InterleaveConfig {
  static constexpr std::string_view kind = "interleaving";

  Interleave interleave = Interleave::random;
  /// Largest lead, in completed trials, over the least advanced unfinished staircase; 0: no limit.
  int max_lag = 0;

  ConfigMistakes check() const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, InterleaveConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(ConfigKey{"interleave", "random draw, each in turn, or one after the other"},
        config.interleave);
  visit(ConfigKey{"max_lag", "largest lead over the least advanced, in trials; 0: any"},
        config.max_lag, WholeRange{});
}

/// Contents of a procedure file.
struct InterleavedProcedures {
  std::uint64_t seed = 1;
  InterleaveConfig interleaving;
  std::vector<Procedure> staircases;
};

/// Index of the staircase that the next trial belongs to; none when all are finished. round_robin
/// and sequential skip staircases whose lead has reached max_lag.
/// @param previous index of the last completed trial's staircase, for round_robin
/// @param stream used by `random` only, and only if there is a choice
/// @throws InvalidConfig
std::optional<std::size_t> next_staircase(std::span<const Procedure> staircases,
                                          const InterleaveConfig& config,
                                          std::optional<std::size_t> previous,
                                          RandomStream& stream);

/// A run of interleaved procedures: the open trial, its response, the next trial. Trials are the
/// same for the same procedures, seed and responses.
class InterleavedRun {
 public:
  /// @throws InvalidConfig
  explicit InterleavedRun(InterleavedProcedures procedures);

  bool finished() const { return !current_; }  ///< all staircases are
  int trial() const { return trial_; }  ///< number of the open trial, from 1, void ones count
  // Undefined once finished.
  const Procedure& staircase() const { return procedures_.staircases[*current_]; }
  double level() const { return level_; }

  /// Records the response to the open trial, and opens the next one.
  /// @param shown the presented level if it differs from level(), within +-largest_level
  Update respond(const Response& response, std::optional<double> shown = std::nullopt);
  /// The staircases are unchanged; the next trial is drawn again.
  void void_trial() { open_trial(); }

  const std::vector<Procedure>& staircases() const { return procedures_.staircases; }

 private:
  void open_trial();

  InterleavedProcedures procedures_;
  std::optional<std::size_t> current_;   ///< staircase of the open trial
  std::optional<std::size_t> previous_;  ///< of the last completed trial
  int trial_ = 0;
  double level_ = 0;
};

}  // namespace heft
