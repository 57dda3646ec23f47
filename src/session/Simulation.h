// Many simulated sessions, computed in threads. Every session is a pure function of protocol, seed
// and its number, so the number of threads changes nothing but the time it takes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "session/Session.h"

namespace heft {

struct SimulationRequest {
  ResolvedConfig config;  ///< its seed is that of the simulation
  std::string db = "heft.db";
  int participants = 1;
  int jobs = 1;
  bool keep_frames = false;
  /// Told the first participant's number once the file is held, before anything is computed.
  std::function<void(int)> numbered = [](int) {};
};

/// Participant n (from 1) of a simulation: "sim-0001". A file that holds simulated participants of
/// the protocol already gets the numbers after theirs, so that no two share an id.
std::string simulated_participant(int n);

/// @param progress called after each stored session with how many are stored
/// @param stop set from a signal handler to stop; sessions that are running are dropped
/// @return how many sessions were stored, in the order of their numbers
/// @throws Error when a session fails or can't be stored; those stored before it are kept
int simulate(const SimulationRequest& request, const std::function<void(int)>& progress,
             const std::atomic<bool>& stop);

}  // namespace heft
