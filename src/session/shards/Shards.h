// Simulations in parts. Shard I of N has participants I, I + N, I + 2 N... of the simulation, each
// with the id, seed and session of one run. Simulation.h computes a shard; merge_shards() joins
// them to the log that one run would have written. It folds the sessions again from their events
// and stores them as simulate() does, so that rows, ids, seals and head are the same.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiment/SessionConfig.h"
#include "record/reader/LogReader.h"

namespace heft {

struct Shard {
  int number = 1, of = 1;  ///< 1 <= number <= of
};

/// Participants by their numbers, from 1: first, first + step, ...
struct ParticipantNumbers {
  int first = 1, step = 1, count = 0;

  int at(int place) const { return first + place * step; }
  /// The numbers after the first n.
  ParticipantNumbers after(int n) const { return {at(n), step, count - n}; }
};

/// @param participants of the whole simulation
ParticipantNumbers numbers_of(const Shard& shard, int participants);

/// Participant n of a simulation: "sim-0001". In a file with simulated participants of the protocol
/// the numbers continue, so that ids are unique.
std::string simulated_participant(int n);

/// The number in a simulated participant's id; 0 for other ids.
int number_in_id(const std::string& participant);

/// The seed of participant n's session. @param seed of the simulation
std::uint64_t session_seed(std::uint64_t seed, int n);

/// What all sessions of a simulation have in common.
struct SimulationKey {
  std::string protocol, protocol_sha256;
  SessionConfig config;  ///< without a participant's own parameters
};

/// @throws Error if the session was not made by simulate(), or its data were withdrawn
SimulationKey simulation_key(const SessionHeader& header);

/// What differs, for messages: "seed 1, not 2". Empty: nothing.
std::string difference(const SimulationKey& found, const SimulationKey& expected);

/// The number of a log's sessions, which must be those of the first of these participants, in
/// order.
/// @param db the log, for messages  @throws Error (usage) naming the first other session
int n_stored(const LogReader& log, const std::string& db, const SimulationKey& key,
             const ParticipantNumbers& numbers);

struct MergeRequest {
  std::string db;                   ///< new, or left unfinished by an earlier merge of these shards
  std::vector<std::string> shards;  ///< in any order
};

struct MergeResult {
  int n_expected = 0;      ///< participants of the simulation
  int n_participants = 0;  ///< in the log; fewer: stopped
  int n_new = 0;           ///< of them, stored by this call
  std::string head;        ///< of the log
};

/// Verifies all shards, then writes.
/// @param progress called with what is done, and the fraction of it
/// @param stop set by a signal handler to stop between two participants
/// @throws Error (usage) if shards are not of one simulation, or a participant is missing or there
///   twice; Error (diverged) if a shard was changed; nothing is written then. Error if the log
///   cannot be written; participants stored before are kept, and another call continues
MergeResult merge_shards(const MergeRequest& request,
                         const std::function<void(const char*, double)>& progress,
                         const std::atomic<bool>& stop);

}  // namespace heft
