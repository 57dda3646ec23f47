// One pair of bodies that touch or are about to, in the form that the solver iterates over: at most
// four points in one plane across a normal, each with a normal impulse and a friction impulse.
//
// How rigid bodies move against each other at any of the points follows from six numbers, how they
// do at the points' middle; and what the points' impulses do to the bodies from their six sums
// there. So a sweep fetches the motion at the middle once, works on these six numbers, and hands
// the sum of its impulses to the bodies once. All points are worked on at once, as the rows of
// small matrices; a row without a point is zero and never touches.
#pragma once

#include <array>
#include <optional>

#include "physics/boxes/Body.h"

namespace heft::boxes {

struct ContactSurface {
  double friction = 0.8;
  double compliance_m_per_n = 0;  ///< of each point; 0: rigid
  /// Whether to save sweeps by ways that rounding may decide: not for a coupled clone, which shows
  /// no mass.
  bool shortcuts = true;
  /// Bodies that moved or turned against each other by less, m or rad, keep their contact: no lever
  /// changes noticeably.
  double same_place() const { return shortcuts ? 1e-6 : 1e-10; }
};

class Manifold {
 public:
  /// Takes a contact; points that were there in the last one start from its impulses.
  /// @param second the table is a body that is not solid
  /// @param margin_m with which the contact was looked for
  void prepare(const Contact& contact, Body& first, Body& second, const ContactSurface& surface,
               double margin_m);

  /// Whether the contact of the last prepare() still holds: the bodies did not move against each
  /// other noticeably.
  /// @param margin_m of a contact that would be looked for now
  bool still_fits(double margin_m) const;
  void clear() {
    n_ = 0;
    sticks_ = false;
  }

  /// Takes note of where the bodies are and how they move when a step begins.
  /// @param regular_s in which a gap may close without a hit
  /// @return the largest speed at which points that touch close in, m/s; 0 where contacts give
  double start(double regular_s);
  /// Takes the bodies' motions over a step.
  void take_step(const StepTime& time);

  /// From now on points that are still apart stop the bodies where they meet; without this they are
  /// left to hit each other, see fraction_before_hit().
  void stop_at_gaps();

  /// Applies the impulses known so far.
  void warm_start();
  /// Extrapolates the impulses of the last two steps, where that was right for the last one.
  void extrapolate();
  /// Goes on by a fraction of how far the last sweep's end is from the one before; the bodies'
  /// velocities have to follow.
  void begin_sweeps() { swept_ = impulses_; }
  void go_on(double fraction);

  /// One sweep of projected Gauss-Seidel.
  /// @return the largest change of a velocity at a point, m/s
  double relax();

  /// The fraction of the step after which points that are apart now meet; none if they do not.
  std::optional<double> fraction_before_hit() const {
    return touching_ == (1u << n_) - 1 ? std::nullopt : fraction_before_meeting();
  }
  /// The fraction of the step after which friction stops a patch that slips now; none if it slips
  /// on or does not slip.
  std::optional<double> fraction_before_stop() const;

  /// The same over an instant. A hit starts from no impulse; the step after it from what was held
  /// before.
  void begin_hit();
  /// @return the hit's impulse on the first body, N s
  Eigen::Vector3d end_hit();

  bool touches() const { return n_ > 0 && impulses_.col(0).maxCoeff() > 0; }
  bool empty() const { return n_ == 0; }
  const Eigen::Vector3d& normal() const { return normal_; }  ///< from the second to the first, unit
  /// Impulse on the first body over the step, N s.
  Eigen::Vector3d impulse_n_s() const { return in_world(impulses_); }
  void forget_impulses();

 private:
  static constexpr double noticed_m_s = 1e-9;  // smaller changes are not worth waiting for

  using Points = Eigen::Vector4d;                 // a number for each
  using PointRows = Eigen::Matrix<double, 4, 3>;  // three numbers for each
  using Impulses = PointRows;                     // N s: along the normal, u and v

  // At the middle of the points, in the frame (normal, u, v): how the first body moves against the
  // second, or impulses on it.
  struct Six {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();      // along the normal, about u, about v
    Eigen::Vector3d tangential = Eigen::Vector3d::Zero();  // along u, along v, about the normal
  };

  std::optional<double> fraction_before_meeting() const;
  void take_points(const Contact& contact);
  void take_frame(const Contact& contact);
  void couple_if_new();
  void couple();
  void set_closing();
  void find_balance();
  Eigen::Vector3d moved_m() const;

  Six moving(const Velocity& first, const Velocity& second) const;
  Eigen::Vector3d tangential_sum(const Impulses& impulses) const;
  Eigen::Vector3d in_world(const Impulses& impulses) const;
  void apply(const Six& impulses_n_s);

  double press(Six& moving, Six& change);
  Points release(unsigned active, const Points& missing);
  const Eigen::Matrix4d& stopping(unsigned set);
  void balance();

  double stick(const Six& moving, Six& change);
  bool share_friction(const Eigen::Vector3d& more);
  double slip(const Eigen::Vector3d& slips, Six& change);

  Body* first_ = nullptr;
  Body* second_ = nullptr;
  bool on_table_ = false;
  ContactSurface surface_;
  StepTime time_;
  double margin_m_ = 0;
  Pose first_seen_, second_seen_;  // by prepare()

  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ(), u_ = normal_, v_ = normal_;
  Eigen::Vector3d arm_first_m_ = Eigen::Vector3d::Zero(),
                  arm_second_m_ = arm_first_m_;  // from the bodies' centers to the middle
  int n_ = 0;
  std::array<int, 4> features_{};
  unsigned touching_ = 0;                              // a bit for each point that has no gap
  Points at_u_m_ = Points::Zero(), at_v_m_ = at_u_m_;  // from the middle
  Points squares_m2_ = Points::Zero();                 // of their distances to it
  double spread_m_ = 0;                                // their root mean
  // What a unit normal impulse at a point does at the middle, and what a motion there is here.
  PointRows levers_ = PointRows::Zero();
  Points gaps_m_ = Points::Zero(), prepared_gaps_m_ = gaps_m_;
  // Normal impulses in these proportions push nothing anywhere; all zero unless four points touch.
  Points balance_ = Points::Zero();

  Six at_start_;                         // how the bodies moved when the step began
  bool sticks_ = false, stuck_ = false;  // in this solve; when the step began

  // Changes of the motion per impulse, and the impulse that stops a unit tangential motion.
  double first_per_kg_ = 0, second_per_kg_ = 0;  // that the rest was made with
  Eigen::Matrix3d tangential_by_normal_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d tangential_by_tangential_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d tangential_mass_ = Eigen::Matrix3d::Zero();
  // Velocities along the normal per normal impulse at each point, and its inverse over a set of
  // them.
  Eigen::Matrix4d response_ = Eigen::Matrix4d::Zero(), stopping_ = Eigen::Matrix4d::Zero();
  unsigned stopping_set_ = 0;
  Points slip_kg_ = Points::Zero();  // the least that a slip has to be stopped of; 0: to be found
  Points closing_m_s_ = Points::Zero();  // at which points may close in
  Points softness_ = Points::Zero();     // m/s per N s

  Impulses impulses_ = Impulses::Zero();
  Impulses before_ = impulses_;    // at the end of the step before
  Impulses foreseen_ = impulses_;  // by a line through the last two
  Impulses swept_ = impulses_;     // at the end of the last sweep
  Impulses held_ = impulses_;      // before a hit
};

}  // namespace heft::boxes
