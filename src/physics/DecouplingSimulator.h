// The plug for simulators of the decoupling technique. One table, in DecouplingSimulator.cpp, names
// them all.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/Error.h"
#include "physics/scene/Scene.h"

namespace heft {

/// Thrown by a simulator that does not model what a scene or a path asks of it.
class OutsideModel : public Error {
 public:
  using Error::Error;
};

/// Thrown for a simulator that this program is built without.
class OnlyForStudies : public Error {
 public:
  explicit OnlyForStudies(const std::string& what) : Error(what, ExitCode::usage) {}
};

class DecouplingSimulator {
 public:
  virtual ~DecouplingSimulator() = default;

  /// A fresh world at rest; the clone starts at target * scene.clone_offset, at rest. Gives the
  /// same bits whether the simulator is new or used.
  virtual void reset(const Scene& scene, const Pose& target) = 0;

  /// One step of h_s seconds while the effector moves from the last target to this one.
  virtual void step(const Pose& target, double h_s) = 0;

  /// Puts the clone on the target, at the target's velocity, without touching anything on the way.
  virtual void teleport_clone(const Pose& target, const Velocity& velocity) = 0;

  /// Whether the clone collides with anything. Off while the effector is out of view.
  virtual void set_clone_solid(bool solid) = 0;

  /// Puts one cube at a pose, at rest.
  virtual void place_cube(int cube, const Pose& pose) = 0;

  /// State after the last step.
  virtual WorldState state() const = 0;

  /// Since the reset; none where the simulator does not count.
  virtual std::optional<SolveCounts> counts() const { return std::nullopt; }
};

using MakeSimulator = std::unique_ptr<DecouplingSimulator> (*)();

/// A row of the table of simulators.
struct SimulatorEntry {
  std::string_view name;
  std::string_view summary;
  MakeSimulator make;  ///< null: only heft-bench is built with it
  /// Where it is known to go wrong, one line; empty for those that do not. Told when it is chosen.
  std::string_view warning = {};
  /// Whether it models all that a person may do; others throw OutsideModel.
  bool for_sessions = true;
  /// Counts up when the same scene and path come to give other bits; a log keeps it.
  int edition = 1;
};

std::span<const SimulatorEntry> simulators();

/// A simulator that the table only names, where this program is linked with it; else null, which is
/// what this weak definition returns. results/physics/stock/linked.cpp has the other one.
MakeSimulator linked_simulator(std::string_view name);

/// @throws Error (usage) naming the nearest simulator when there is none of that name;
///   OnlyForStudies
const SimulatorEntry& simulator_named(std::string_view name);

/// @throws Error as simulator_named
std::unique_ptr<DecouplingSimulator> make_simulator(std::string_view name);

}  // namespace heft
