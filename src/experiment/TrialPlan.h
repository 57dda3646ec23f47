// What one attempt at a trial is made of. Drawn by the engine; the runner sets the scene from it.
// Nothing of it but the number of slots may reach a responder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/SimulationChoices.h"
#include "experiment/Task.h"

namespace heft {

struct TrialPlan {
  int trial_number = 0;  ///< planned trial, from 1; attempts share it
  int attempt = 1;       ///< from 1; +1 after a veto or a lost camera, unchanged after a crash
  std::string block;
  Task task;
  std::string condition = spring_technique;  ///< name of the technique
  std::string staircase;                     ///< empty: none (sorting, introduction, catch trials)
  std::optional<double> reference_g;         ///< comparisons only
  std::optional<double> level_g;             ///< comparison - reference, as presented
  bool is_catch = false;
  bool is_practice = false;
  std::vector<double> masses_g;       ///< by slot, leftmost first
  std::optional<int> reference_slot;  ///< comparisons only; slots count from 1
  int n_reshuffles = 0;               ///< times the cubes were newly shuffled in this attempt

  int n_slots() const { return static_cast<int>(masses_g.size()); }
};

}  // namespace heft
