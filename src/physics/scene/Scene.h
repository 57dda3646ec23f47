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

/// The law that ties the clone to the real effector (paper, section 3.1): F = -k d - c v, with
/// c = damping_ratio * 2 sqrt(k m); the same per axis in rotation with kappa and the inertia.
struct Coupling {
  bool decoupled = true;  ///< false: condition C1, the clone stays on the effector
  double stiffness_n_per_m = 50;
  double torsional_stiffness_nm_per_rad = 150;
  double clone_mass_kg = 0.010;
  double damping_ratio = 1;
};

/// A way to render mass, under the name that conditions call it by.
struct Technique {
  std::string name;
  std::variant<Coupling, Displacement> law;

  /// Has the scene's clone follow the effector that way.
  void apply_to(Scene& scene) const;
};

/// One of the declared techniques, or the paper's: C1 is coupled, C2 a spring with these defaults.
/// @throws std::out_of_range for any other name
Technique technique_named(const std::string& name, const std::vector<Technique>& declared,
                          const Coupling& defaults);

struct Cube {
  double mass_kg = 0.2;
  Eigen::Vector3d size_m{0.035, 0.035, 0.035};
  Eigen::Vector3d position_m{0, 0, 0.0175};  ///< of the center
  double yaw_rad = 0;
};

/// How far off a simulator may be that nobody chose by name: see auto/Choice.h.
struct Tolerance {
  double clone_rms_m = 0.1e-3;
  double lag_g = 0.5;  ///< how much heavier or lighter a cube may seem
  double cubes_rms_m = 1e-3;
  double turn_rms_rad = 0.01;  ///< of the clone
};

struct Scene {
  double gravity_m_s2 = 9.81;
  double friction = 0.8;  ///< Coulomb coefficient between any two surfaces
  /// How far a contact point gives under a load; 0: not at all. Rigid boxes share a load among
  /// their corners in more than one way, so that simulators differ where a cube is pushed off its
  /// center; with compliance they agree. `boxes` alone knows it.
  double contact_compliance_m_per_n = 0;
  Eigen::Vector3d effector_size_m{0.09, 0.04, 0.04};
  Coupling coupling;
  /// Of a coupled clone: it follows a target that is displaced from the effector.
  std::optional<Displacement> displacement;
  /// Clone from effector at the first sample, released at rest. A coupled clone has none.
  Pose clone_offset;
  std::vector<Cube> cubes;
  Tolerance tolerance;
};

/// Where the clone starts when the target is there.
inline Pose clone_start(const Scene& scene, const Pose& target) {
  return scene.coupling.decoupled ? target * scene.clone_offset : target;
}

/// Moments of inertia about its own axes through its center, kg m^2.
inline Eigen::Vector3d box_inertia_kg_m2(double mass_kg, const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d squares = size_m.cwiseAbs2();
  return mass_kg / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
}

struct BodyState {
  Pose pose;
  Velocity velocity;
};

/// Mean force over the last step of everything that presses the clone against one cube.
struct CubeContact {
  int cube = 0;                                       ///< index into WorldState::cubes
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< on the cube, world frame
};

struct WorldState {
  bool clone_present = true;  ///< false: the effector is out of view; the clone touches nothing
  BodyState clone;
  std::vector<BodyState> cubes;
  std::vector<CubeContact> contacts;  ///< clone-cube pairs that touch, each cube at most once
};

/// 16 hexadecimal digits over the bits of every pose and velocity: equal hashes, equal bits.
std::string state_hash(const WorldState& state);

struct SolveCounts {
  long not_converged =
      0;          ///< times that velocities were taken before the solver had settled on them
  long hits = 0;  ///< of bodies: closed in at once, without duration
};

}  // namespace heft
