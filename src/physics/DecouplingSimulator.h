// Interface of the simulators of the decoupling technique. DecouplingSimulator.cpp has their table.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/Error.h"
#include "physics/scene/Scene.h"

namespace heft {

/// Thrown when a scene or a path is outside a simulator's model.
class OutsideModel : public Error {
 public:
  using Error::Error;
};

/// Thrown for a simulator that only heft-bench is linked with.
class OnlyForStudies : public Error {
 public:
  explicit OnlyForStudies(const std::string& message) : Error(message, ExitCode::usage) {}
};

class DecouplingSimulator {
 public:
  virtual ~DecouplingSimulator() = default;

  /// Starts a new world at rest, with the clone at target * scene.clone_offset. The state after a
  /// reset does not depend on earlier use.
  virtual void reset(const Scene& scene, const Pose& target) = 0;

  /// Makes one step of h_s seconds, in which the effector moves from the last target to this one.
  virtual void step(const Pose& target, double h_s) = 0;

  /// Moves the clone to the target and its velocity, without contacts on the way.
  virtual void teleport_clone(const Pose& target, const Velocity& velocity) = 0;

  /// Turns collisions of the clone on or off. They are off while the effector is out of view.
  virtual void set_clone_solid(bool solid) = 0;

  /// Moves one cube to a pose, at rest.
  virtual void place_cube(int cube, const Pose& pose) = 0;

  /// State after the last step.
  virtual WorldState state() const = 0;

  /// Counts since the reset; none if the simulator does not count.
  virtual std::optional<SolveCounts> counts() const { return std::nullopt; }
};

using MakeSimulator = std::unique_ptr<DecouplingSimulator> (*)();

/// What a simulator models without a known failure. Tests run each through the scenes with closed
/// forms of these kinds.
struct Fitness {
  bool straight = false;  ///< a straight push of one cube
  bool coupled = false;   ///< the same by a clone that stays on the effector
  bool turning = false;   ///< a torsional spring, hands that turn, cubes that turn
  bool several_cubes = false;
  bool compliant = false;  ///< Scene::contact_compliance_m_per_n
};

/// A row of the table of simulators.
struct SimulatorEntry {
  std::string_view name;
  std::string_view summary;
  MakeSimulator make;  ///< null: only heft-bench is built with it
  Fitness fit_for;
  /// Known failures, in one line; printed when the simulator is chosen. Empty: none.
  std::string_view warning = {};
  /// Whether it models every hand movement; others throw OutsideModel.
  bool for_sessions = true;
  /// Incremented when results for the same scene and path change; recorded in the log.
  int edition = 1;
};

std::span<const SimulatorEntry> simulators();

/// The factory of a simulator that is only in heft-bench, or null. The definition in
/// DecouplingSimulator.cpp is weak and returns null; results/physics/stock/linked.cpp overrides it.
MakeSimulator linked_simulator(std::string_view name);

/// @throws Error (usage) with the nearest name if there is no such simulator; OnlyForStudies
const SimulatorEntry& simulator_named(std::string_view name);

/// @throws Error as simulator_named
std::unique_ptr<DecouplingSimulator> make_simulator(std::string_view name);

}  // namespace heft
