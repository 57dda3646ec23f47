// Contact manifold of two bodies: up to four contact points in one plane with a common normal, each
// with a normal and a friction impulse.
//
// The relative motion of two rigid bodies at all points follows from six numbers: linear and
// angular velocity at the middle of the patch. The impulses of all points act on the bodies through
// their six sums there. A sweep therefore reads the motion at the middle once, updates these six
// numbers and applies the summed impulse once. Points are the rows of small matrices; unused rows
// are zero.
#pragma once

#include <array>
#include <optional>

#include "physics/boxes/Body.h"

namespace heft::boxes {

struct ContactSurface {
  double friction = 0.8;
  double compliance_m_per_n = 0;  ///< of each point; 0: rigid
  bool is_rigid() const { return compliance_m_per_n == 0; }
  /// Allows methods that save sweeps but amplify rounding; off for a coupled clone.
  bool shortcuts = true;
  /// Bodies whose relative displacement, m or rad, is smaller keep their manifold.
  double same_place() const { return shortcuts ? 1e-6 : 1e-10; }
};

class ContactManifold {
 public:
  /// Replaces the contact points. Points with a known feature keep their impulses (warm start).
  /// @param second the table is a body that is not solid
  /// @param margin_m of the contact detection
  void update(const Contact& contact, Body& first, Body& second, const ContactSurface& surface,
              double margin_m);

  /// Whether the points are still valid, because the bodies have not moved against each other.
  /// @param margin_m of a contact detection now
  bool is_current(double margin_m) const;
  void clear() {
    n_ = 0;
    sticks_ = false;
  }

  /// Records gaps and relative velocity at the start of a step.
  /// @param regular_s time in which a gap may close without an impact
  /// @param ahead_s time by which the bodies are moved ahead now, see Body::look_ahead()
  /// @return the largest approach speed of points in contact, m/s; 0 for compliant contacts
  double begin_step(double regular_s, double ahead_s);
  /// Prepares the solve for a step of this length.
  void set_step(const StepTime& time);

  /// Also limits the approach of points with a gap, so that the bodies stop where they meet
  /// (speculative contacts). Without it the step is split at fraction_before_impact().
  void add_speculative_limits();

  void warm_start();
  /// Replaces the warm-start impulses by a linear extrapolation of the last two steps, if the same
  /// extrapolation was accurate for the last step.
  void extrapolate_impulses();
  void begin_sweeps() { sweep_end_ = impulses_; }
  /// As Motion::extrapolate_sweep(), which must use the same fraction.
  void extrapolate_sweep(double fraction);

  /// One block of projected Gauss-Seidel: normal impulses, then friction.
  /// @return the largest change of a point's velocity, m/s
  double sweep();

  /// Fraction of the step at which a point with a gap meets the other body; none if none does.
  std::optional<double> fraction_before_impact() const {
    return touching_ == (1u << n_) - 1 ? std::nullopt : fraction_before_meeting();
  }
  /// Fraction of the step at which friction stops a sliding patch; none if it keeps sliding or
  /// already sticks.
  std::optional<double> fraction_before_sticking() const;

  /// Prepares the solve for an impact. It starts from zero impulses; the impulses of the contact
  /// forces are kept for the next step.
  void begin_impact();
  /// @return the impact's impulse on the first body, N s
  Eigen::Vector3d end_impact();

  /// Whether a point transmits a normal impulse.
  bool touches() const { return n_ > 0 && impulses_.col(0).maxCoeff() > 0; }
  bool empty() const { return n_ == 0; }
  const Eigen::Vector3d& normal() const { return normal_; }  ///< unit, from the second to the first
  /// Impulse on the first body over the step, N s.
  Eigen::Vector3d impulse_n_s() const { return world_sum(impulses_); }
  void clear_impulses();

 private:
  static constexpr double negligible_m_s = 1e-9;  // smaller velocity changes are not iterated

  using Points = Eigen::Vector4d;                 // one number a point
  using PointRows = Eigen::Matrix<double, 4, 3>;  // three numbers a point
  using Impulses = PointRows;                     // N s: along the normal, u and v

  // Whether points with a gap have a limit: speculative contacts.
  enum class Limits { of_touching, of_all };

  // Relative velocity of the first body, or impulse on it, at the middle of the patch in the frame
  // (normal, u, v).
  struct PatchVector {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();      // along the normal, about u, about v
    Eigen::Vector3d tangential = Eigen::Vector3d::Zero();  // along u, along v, about the normal
  };

  std::optional<double> fraction_before_meeting() const;
  void set_points(const Contact& contact);
  void set_frame(const Contact& contact);
  void update_response();
  void compute_response();
  void set_approach_limits(Limits limits);
  void set_compliant_limit(int i, double gap_m);
  void find_null_vector();
  Eigen::Vector3d relative_displacement_m() const;

  PatchVector relative_motion(const Velocity& first, const Velocity& second) const;
  Eigen::Vector3d tangential_sum(const Impulses& impulses) const;
  Eigen::Vector3d world_sum(const Impulses& impulses) const;
  void apply(const PatchVector& impulses_n_s);

  double solve_normal(PatchVector& motion, PatchVector& change);
  Points release_pulling_points(unsigned active, const Points& missing);
  const Eigen::Matrix4d& effective_mass(unsigned set);
  void share_load();

  double solve_sticking(const PatchVector& motion, PatchVector& change);
  bool share_friction(const Eigen::Vector3d& more);
  double solve_sliding(const Eigen::Vector3d& slip, PatchVector& change);

  Body* first_ = nullptr;
  Body* second_ = nullptr;
  bool on_table_ = false;
  ContactSurface surface_;
  StepTime time_;
  double margin_m_ = 0;
  Pose first_updated_, second_updated_;  // poses of the bodies at update()

  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ(), u_ = normal_, v_ = normal_;
  // From the bodies' centers to the middle of the patch.
  Eigen::Vector3d arm_first_m_ = Eigen::Vector3d::Zero(), arm_second_m_ = arm_first_m_;
  int n_ = 0;
  std::array<int, 4> features_{};
  unsigned touching_ = 0;                     // bit set of the points without a gap
  Points u_m_ = Points::Zero(), v_m_ = u_m_;  // coordinates from the middle
  Points squares_m2_ = Points::Zero();        // squared distances from the middle
  double spread_m_ = 0;                       // root mean square distance from the middle
  // Jacobian of the points: velocity along the normal from PatchVector::normal.
  PointRows lever_arms_ = PointRows::Zero();
  Points gaps_m_ = Points::Zero(), updated_gaps_m_ = gaps_m_;  // now, at update()
  // Unit vector of normal impulses without resultant; zero unless four points touch.
  Points null_vector_ = Points::Zero();

  PatchVector at_start_;                          // relative velocity at the start of the step
  bool sticks_ = false, stuck_at_start_ = false;  // friction state: in this solve, before it

  // Responses of the relative velocity to impulses, for the inverse masses that they were made
  // with.
  double first_inverse_mass_ = 0, second_inverse_mass_ = 0;
  Eigen::Matrix3d tangential_by_normal_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d tangential_by_tangential_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d tangential_mass_ = Eigen::Matrix3d::Zero();  // inverse of the former
  // Delassus matrix of the normal impulses, and its inverse over a set of points.
  Eigen::Matrix4d normal_response_ = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d effective_mass_ = Eigen::Matrix4d::Zero();
  unsigned effective_mass_set_ = 0;
  Points sliding_mass_kg_ =
      Points::Zero();  // smallest effective mass in the plane; 0: not yet known
  Points approach_limit_m_s_ = Points::Zero();  // of each point
  Points softness_ = Points::Zero();            // m/s per N s
  Points last_loads_n_ = Points::Zero();        // normal forces over the last step
  double last_h_s_ = 0;                         // its length

  Impulses impulses_ = Impulses::Zero();
  Impulses previous_ = impulses_;   // of the step before
  Impulses predicted_ = impulses_;  // extrapolated from the last two steps
  Impulses sweep_end_ = impulses_;  // after the last sweep
  Impulses sustained_ = impulses_;  // of contact forces, during an impact
};

}  // namespace heft::boxes
