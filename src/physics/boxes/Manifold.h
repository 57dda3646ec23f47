// One pair of bodies that touch or are about to, in the form that the solver iterates over: at most
// four points that share a normal, each with a normal impulse and a friction impulse in the plane.
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

  /// Remembers the impulses, before the first sweep.
  void begin_course();
  /// Goes on by a share of how far the last sweep's end is from the one before. The bodies'
  /// velocities have to follow: see SweepCourse.
  void go_on(double share);

  /// Moves overlapping bodies apart by half the overlap, without a change of velocity.
  /// @return whether there was any
  bool push_apart();

  bool touches() const;
  bool empty() const { return n_ == 0; }
  /// From the second to the first, unit.
  const Eigen::Vector3d& normal() const { return normal_; }
  /// Impulse on the first body over the step, N s.
  Eigen::Vector3d impulse_n_s() const;
  void clear() { n_ = 0; }
  void forget_impulses();

 private:
  // Along `direction`, unit; the responses are the bodies' changes of angular velocity per impulse.
  struct Row {
    Eigen::Vector3d turn_first = Eigen::Vector3d::Zero(), turn_second = turn_first;
    Eigen::Vector3d response_first = turn_first, response_second = turn_first;
  };
  struct Point {
    Eigen::Vector3d arm_first_m = Eigen::Vector3d::Zero(),
                    arm_second_m = arm_first_m;  // from the bodies' centers
    Row normal, u, v;
    double gap_m = 0, prepared_gap_m = 0;
    double speed_m_s = 0;  // at which the points may close in: gap / h
    double softness = 0;   // m/s per N s
    double mass_kg = 0;
    double friction_mass_kg = 0, friction_per_kg = 0;  // 0: u and v are not there yet
    double impulse = 0, impulse_u = 0, impulse_v = 0;  // N s
    Eigen::Vector3d end = Eigen::Vector3d::Zero();     // of the last sweep: the same three
    int feature = 0;
    // Of the step before, and as a line or a parabola through earlier ones foresaw: the same three.
    Eigen::Vector3d before = Eigen::Vector3d::Zero(), line = before, curve = before;
  };

  // The points as one patch that sticks: it neither shifts along u and v nor spins.
  struct Patch {
    Row u, v, spin;
    Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();  // impulses that stop a unit velocity
    std::array<double, 4> at_u_m{}, at_v_m{};        // from the middle
    double squares_m2 = 0;
    bool usable = false;  // more than one point, on bodies that can turn
  };

  // What prepare() saw.
  struct Seen {
    Pose first, second;
    double first_per_kg = 0, second_per_kg = 0;
    double margin_m = 0;
  };

  std::span<Point> points() { return {points_.data(), static_cast<std::size_t>(n_)}; }
  std::span<const Point> points() const { return {points_.data(), static_cast<std::size_t>(n_)}; }
  Row row(const Eigen::Vector3d& arm_first_m, const Eigen::Vector3d& arm_second_m,
          const Eigen::Vector3d& direction) const;
  double inverse_mass(const Row& a, const Row& b, double cosine) const;
  double speed(const Row& row, const Eigen::Vector3d& direction) const;
  double shift_speed(const Eigen::Vector3d& direction) const;
  double turn_speed(const Row& row) const;
  void apply(const Row& row, const Eigen::Vector3d& direction, double impulse);
  void shift(const Eigen::Vector3d& direction, double impulse);
  void turn(const Row& row, double impulse);
  void set_gap(Point& point, double gap_m);
  void foresee(double scale);
  Eigen::Vector3d moved_m() const;
  void prepare_point(Point& point, const ContactPoint& at, const ContactSurface& surface,
                     double h_s);
  void prepare_friction(Point& point);
  void find_balance(const Contact& contact);
  void balance();
  bool unmoved(const std::array<double, 4>& missing, unsigned active) const;
  double relax_normals();
  void couple_points();
  void factor(unsigned active);
  void solve_all_four(std::array<double, 4>& change) const;
  void solve_block(unsigned active, std::array<double, 4>& change) const;
  double slide();
  void prepare_patch(const Contact& contact);
  double hold_patch();
  bool share_friction(const Eigen::Vector3d& change);

  Body* first_ = nullptr;
  Body* second_ = nullptr;
  bool alone_ = false;  // the second is the table
  double friction_ = 0, h_s_ = 0;
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ(), u_ = normal_, v_ = normal_;
  std::array<Point, 4> points_;
  int n_ = 0;
  bool rigid_ = true;
  double changed_m_s_ = 0;
  double same_place_ = 0;
  bool foresees_ = true;
  Seen seen_;
  Patch patch_;
  // Velocity at one point per normal impulse at another, m/s per N s.
  std::array<std::array<double, 4>, 4> response_{}, factor_{};
  unsigned factored_ = 0;
  // Normal impulses in these proportions push nothing anywhere; all zero unless four points touch.
  std::array<double, 4> balance_{};
};

// Here, to be inlined: sweeps consist of these.

// Velocity that a unit impulse along b makes along a; `cosine` is that between their directions.
inline double Manifold::inverse_mass(const Row& a, const Row& b, double cosine) const {
  return cosine * (first_->inverse_mass_per_kg + second_->inverse_mass_per_kg) +
         a.turn_first.dot(b.response_first) + a.turn_second.dot(b.response_second);
}

inline double Manifold::shift_speed(const Eigen::Vector3d& direction) const {
  const double alone = direction.dot(first_->velocity.linear_m_s);
  return alone_ ? alone : alone - direction.dot(second_->velocity.linear_m_s);
}

inline double Manifold::turn_speed(const Row& row) const {
  const double alone = row.turn_first.dot(first_->velocity.angular_rad_s);
  return alone_ ? alone : alone + row.turn_second.dot(second_->velocity.angular_rad_s);
}

inline double Manifold::speed(const Row& row, const Eigen::Vector3d& direction) const {
  return shift_speed(direction) + turn_speed(row);
}

inline void Manifold::shift(const Eigen::Vector3d& direction, double impulse) {
  first_->velocity.linear_m_s += (impulse * first_->inverse_mass_per_kg) * direction;
  if (!alone_) second_->velocity.linear_m_s -= (impulse * second_->inverse_mass_per_kg) * direction;
}

inline void Manifold::turn(const Row& row, double impulse) {
  first_->velocity.angular_rad_s += impulse * row.response_first;
  if (!alone_) second_->velocity.angular_rad_s += impulse * row.response_second;
}

inline void Manifold::apply(const Row& row, const Eigen::Vector3d& direction, double impulse) {
  shift(direction, impulse);
  turn(row, impulse);
}

}  // namespace heft::boxes
