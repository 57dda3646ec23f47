// Many simulated sessions, computed in threads. A session is a pure function of protocol, seed and
// its number, so that logs do not depend on the number of threads, nor on how participants are
// distributed over computers (Shards.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "session/Session.h"
#include "session/shards/Shards.h"

namespace heft {

struct SimulationRequest {
  ResolvedConfig config;  ///< with the simulation's seed
  std::string db = {};
  int participants = 1;  ///< of all shards together
  int jobs = 1;
  bool keep_frames = false;
  /// Only these participants; the first of them may already be in the log. None: the next ones that
  /// the log does not have.
  std::optional<Shard> shard = {};
  /// Called once the file is locked, before any computation, with the participants to compute and
  /// the number of earlier ones in the log.
  std::function<void(const ParticipantNumbers&, int)> begins = [](const auto&, int) {};
};

/// @param progress called after each stored session with the number of stored ones
/// @param stop set by a signal handler to stop; running sessions are dropped
/// @return number of stored sessions, stored in the order of their numbers
/// @throws Error if a session fails or cannot be stored; sessions stored before it are kept. Error
///   (usage) if there is a shard and the log has sessions that are not its first ones
int simulate(const SimulationRequest& request, const std::function<void(int)>& progress,
             const std::atomic<bool>& stop);

}  // namespace heft
