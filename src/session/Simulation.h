// Many simulated sessions, computed in threads. A session is a pure function of protocol, seed and
// its number, so that results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "session/Session.h"

namespace heft {

struct SimulationRequest {
  ResolvedConfig config;  ///< with the simulation's seed
  std::string db = "heft.db";
  int participants = 1;
  int jobs = 1;
  bool keep_frames = false;
  /// Called with the first participant's number once the file is locked, before any computation.
  std::function<void(int)> numbered = [](int) {};
};

/// Participant n (from 1) of a simulation: "sim-0001". In a file with simulated participants of the
/// protocol the numbers continue, so that ids are unique.
std::string simulated_participant(int n);

/// @param progress called after each stored session with the number of stored ones
/// @param stop set by a signal handler to stop; running sessions are dropped
/// @return number of stored sessions, stored in the order of their numbers
/// @throws Error if a session fails or cannot be stored; sessions stored before it are kept
int simulate(const SimulationRequest& request, const std::function<void(int)>& progress,
             const std::atomic<bool>& stop);

}  // namespace heft
