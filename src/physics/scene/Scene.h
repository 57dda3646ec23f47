// A simulated world: a table, an effector clone coupled to a target, boxes; and its state at one
// time. World frame and SI units as in base/PoseTypes.h.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/PoseTypes.h"
#include "physics/techniques/Displacement.h"

namespace heft {

struct Scene;

/// Spring-damper between clone and effector (paper, section 3.1): F = -k d - c v with
/// c = damping_ratio * 2 sqrt(k m); likewise about each axis with kappa and the moment of inertia.
struct Coupling {
  bool decoupled = true;  ///< false: condition C1, the clone stays on the effector
  double stiffness_n_per_m = 50;
  double torsional_stiffness_nm_per_rad = 150;
  double clone_mass_kg = 0.010;
  double damping_ratio = 1;
};

/// A pseudo-haptic technique under the name that conditions use.
struct Technique {
  std::string name;
  std::variant<Coupling, Displacement> law;
  /// As Scene::contact_compliance_m_per_n, which it replaces; none: the scene keeps its own.
  std::optional<double> contact_compliance_m_per_n = {};

  void apply_to(Scene& scene) const;
};

/// A declared technique, or one of the paper's: C1 is coupled, C2 a spring with these defaults.
/// @throws std::out_of_range for any other name
Technique technique_named(const std::string& name, const std::vector<Technique>& declared,
                          const Coupling& defaults);

struct Cube {
  double mass_kg = 0.2;
  Eigen::Vector3d size_m{0.035, 0.035, 0.035};
  Eigen::Vector3d position_m{0, 0, 0.0175};  ///< of the center
  double yaw_rad = 0;
  /// Coulomb coefficient between the cube and the table; none: Scene::friction.
  std::optional<double> table_friction = {};
};

/// Largest errors of a simulator that `auto` chooses, see auto/Choice.h.
struct Tolerance {
  double clone_rms_m = 0.1e-3;
  double lag_g = 0.5;  ///< error of the lag, as the difference in mass that causes it
  double cubes_rms_m = 1e-3;
  double turn_rms_rad = 0.01;  ///< of the clone's orientation
};

struct Scene {
  double gravity_m_s2 = 9.81;
  double friction = 0.8;  ///< Coulomb coefficient between two surfaces, see Cube::table_friction
  /// Deflection of a contact point per load; 0: rigid. The load of a rigid box is statically
  /// indeterminate at its corners, so that a push beside a cube's middle, or by an effector that
  /// turns, has no unique result; with compliance it has. Modeled by `boxes` only.
  double contact_compliance_m_per_n = 0;
  Eigen::Vector3d effector_size_m{0.09, 0.04, 0.04};
  Coupling coupling;
  /// Displaces the target of a coupled clone from the effector.
  std::optional<Displacement> displacement;
  /// effector_from_clone at the first sample, released at rest. Ignored for a coupled clone.
  Pose clone_offset;
  std::vector<Cube> cubes;
  Tolerance tolerance;

  double table_friction(std::size_t cube) const {
    return cubes[cube].table_friction.value_or(friction);
  }
};

/// Start pose of the clone for a target.
inline Pose clone_start(const Scene& scene, const Pose& target) {
  return scene.coupling.decoupled ? target * scene.clone_offset : target;
}

/// Moments of inertia of a homogeneous box about its axes through the center, kg m^2.
inline Eigen::Vector3d box_inertia_kg_m2(double mass_kg, const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d squares = size_m.cwiseAbs2();
  return mass_kg / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
}

struct BodyState {
  Pose pose;
  Velocity velocity;
};

/// Mean contact force between the clone and one cube over the last step.
struct CubeContact {
  int cube = 0;                                       ///< index into WorldState::cubes
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< on the cube, world frame
};

struct WorldState {
  bool clone_present = true;  ///< false: the effector is out of view; the clone touches nothing
  BodyState clone;
  std::vector<BodyState> cubes;
  std::vector<CubeContact> contacts;  ///< one for each cube that the clone touches
};

/// Hash of the bits of all poses and velocities, as 16 hexadecimal digits.
std::string state_hash(const WorldState& state);

struct SolveCounts {
  long not_converged = 0;  ///< solves that ended before convergence
  long hits = 0;           ///< impacts
};

}  // namespace heft
