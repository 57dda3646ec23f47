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

#include "physics/boxes/Body.h"

namespace heft::boxes {

struct ContactSurface {
  double friction = 0.8;
  double compliance_m_per_n = 0;  ///< of each point; 0: rigid
  /// Bodies that moved or turned against each other by less, m or rad, keep their contact: no lever
  /// changes noticeably.
  double same_place = 1e-6;
  bool foresees = true;  ///< a step may start from where its impulses seem to go
};

class Manifold {
 public:
  /// Takes this step's contact; points that were there in the last step start from its impulses.
  /// @param second the table is a body without mass
  /// @param margin_m with which the contact was looked for
  void prepare(const Contact& contact, Body& first, Body& second, const ContactSurface& surface,
               double h_s, double margin_m);

  /// Whether the contact of the last prepare() still holds: the bodies have the masses they had,
  /// and did not move against each other noticeably.
  /// @param margin_m of a contact that would be looked for now
  bool still_fits(double margin_m) const;

  /// Takes the last step's contact once more, with the gaps of now.
  void prepare_again(double h_s);

  /// Applies the impulses known so far.
  void warm_start();

  /// One sweep of projected Gauss-Seidel.
  /// @return the largest change of a velocity at a point, m/s
  double relax();
  /// What the last relax() returned.
  double changed_m_s() const { return changed_m_s_; }
  bool left_out = false;  ///< of the last sweep

  /// Remembers the impulses, before the first sweep.
  void begin_course() { end_ = impulses_; }
  /// Goes on by a share of how far the last sweep's end is from the one before. The bodies'
  /// velocities have to follow: see SweepCourse.
  void go_on(double share);

  /// Moves overlapping bodies apart by half the overlap, without a change of velocity.
  /// @return whether there was any
  bool push_apart();

  bool touches() const { return n_ > 0 && impulses_.col(0).maxCoeff() > 0; }
  bool empty() const { return n_ == 0; }
  /// From the second to the first, unit.
  const Eigen::Vector3d& normal() const { return normal_; }
  /// Impulse on the first body over the step, N s.
  Eigen::Vector3d impulse_n_s() const;
  void clear() { n_ = 0; }
  void forget_impulses();

 private:
  using Points = Eigen::Vector4d;                 // a number for each
  using PointRows = Eigen::Matrix<double, 4, 3>;  // three numbers for each
  using Impulses = PointRows;                     // N s: along the normal, u and v

  // At the middle of the points, in the frame (normal, u, v): how the first body moves against the
  // second, or impulses on it. Normal impulses press, friction drags.
  struct Patch {
    Eigen::Vector3d press = Eigen::Vector3d::Zero();  // along the normal, about u, about v
    Eigen::Vector3d drag = Eigen::Vector3d::Zero();   // along u, along v, about the normal
  };

  // What prepare() saw.
  struct Seen {
    Pose first, second;
    double first_per_kg = 0, second_per_kg = 0;
    double margin_m = 0;
  };

  void take_points(const Contact& contact);
  void take_frame(const Contact& contact);
  void couple_bodies();
  void prepare_points(const ContactSurface& surface);
  void set_speeds();
  void find_balance();
  void foresee(double scale);
  Eigen::Vector3d moved_m() const;

  Patch moving() const;
  Patch sum_n_s() const;
  Eigen::Vector3d dragged_n_s() const;
  void apply(const Patch& impulses_n_s);

  double press(Patch& moving, Patch& change);
  Points release(unsigned active, const Points& missing);
  const Eigen::Matrix4d& stopping(unsigned active);
  void balance();

  double hold(const Patch& moving, Patch& change);
  bool share_friction(const Eigen::Vector3d& more);
  double slide(const Patch& moving, Patch& change);
  bool slide_together(const Eigen::Vector3d& speed);
  void slide_one_by_one(const Eigen::Vector3d& speed);

  Body* first_ = nullptr;
  Body* second_ = nullptr;
  bool alone_ = false;  // the second is the table
  double friction_ = 0, h_s_ = 0;
  bool rigid_ = true;
  double same_place_ = 0;
  bool foresees_ = true;
  double changed_m_s_ = 0;
  Seen seen_;

  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ(), u_ = normal_, v_ = normal_;
  Eigen::Vector3d arm_first_m_ = Eigen::Vector3d::Zero(),
                  arm_second_m_ = arm_first_m_;  // from the bodies' centers to the middle
  // Changes of the motion per impulse, and the impulse that stops a unit drag motion.
  Eigen::Matrix3d press_by_press_, drag_by_press_, drag_by_drag_, drag_mass_;
  bool can_stick_ = false;  // more than one point, on bodies that can turn
  double spread_m_ = 0;     // of the points around the middle, root mean square

  int n_ = 0;
  std::array<int, 4> features_{};
  Points at_u_m_ = Points::Zero(), at_v_m_ = at_u_m_;  // from the middle
  Points squares_m2_ = Points::Zero();                 // of their distances to it
  // What a unit normal impulse at a point presses, and what the motion's press is there.
  PointRows levers_ = PointRows::Zero();
  Points gaps_m_ = Points::Zero(), prepared_gaps_m_ = gaps_m_;
  Points speeds_m_s_ = Points::Zero();   // at which the points may close in: gap / h
  Points softness_ = Points::Zero();     // m/s per N s
  Points drag_per_kg_ = Points::Zero();  // the most that a friction impulse changes the drag by

  Impulses impulses_ = Impulses::Zero(), end_ = impulses_;  // the end of the last sweep
  // Of the step before, and as a line or a parabola through earlier ones foresaw.
  Impulses before_ = impulses_, line_ = impulses_, curve_ = impulses_;

  // Velocities along the normal per normal impulse at each point, and what stopping() knows.
  Eigen::Matrix4d response_ = Eigen::Matrix4d::Zero();
  std::array<Eigen::Matrix4d, 16> stopping_;
  unsigned known_ = 0;  // a bit for each
  // Normal impulses in these proportions push nothing anywhere; all zero unless four points touch.
  Points balance_ = Points::Zero();
};

inline Eigen::Vector3d Manifold::dragged_n_s() const {
  const auto u = impulses_.col(1), v = impulses_.col(2);
  return {u.sum(), v.sum(), at_u_m_.dot(v) - at_v_m_.dot(u)};
}

}  // namespace heft::boxes
