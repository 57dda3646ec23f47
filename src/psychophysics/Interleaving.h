// Which of several staircases the next trial belongs to.
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

/// Uniform among the unfinished; each unfinished in file order; finish one first.
enum class Interleave { random, round_robin, sequential };
template <>
struct EnumNames<Interleave> {
  static constexpr std::array<std::string_view, 3> names{"random", "round_robin", "sequential"};
};

struct InterleaveConfig {
  static constexpr std::string_view kind = "interleaving";

  Interleave interleave = Interleave::random;
  /// > 0: no staircase more than this many completed trials ahead of the least advanced unfinished
  /// one
  int max_lag = 0;

  ConfigMistakes check() const;
};
template <typename Config, typename Visit>
requires ConfigOf<Config, InterleaveConfig>
void visit_keys(Config& config, Visit&& visit) {
  visit(
      ConfigKey{"interleave", "a draw among the unfinished, each in turn, or one after the other"},
      config.interleave);
  visit(ConfigKey{"max_lag", "most trials that one may be ahead of the least advanced; 0: any"},
        config.max_lag, WholeRange{});
}

/// Keys of a procedure file: seed, how to interleave, and the staircases.
struct InterleavedProcedures {
  std::uint64_t seed = 1;
  InterleaveConfig interleaving;
  std::vector<Procedure> staircases;
};

/// Index of the staircase that the next trial belongs to; none when all are finished. Where
/// max_lag holds a staircase back, round_robin and sequential go on to the next one that may run.
/// @throws InvalidConfig
/// @param previous index chosen for the last completed trial, for round_robin
/// @param stream drawn from only by `random`, and only where there is a choice
std::optional<std::size_t> next_staircase(std::span<const Procedure> staircases,
                                          const InterleaveConfig& config,
                                          std::optional<std::size_t> previous,
                                          RandomStream& stream);

}  // namespace heft
