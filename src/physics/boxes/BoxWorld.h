// Boxes on a table. One step, in order: sleeping boxes that something could reach wake; weight is
// added; contacts are found, where boxes would meet within the step too, or taken over from the
// last step where nothing moved against each other; projected Gauss-Seidel, started from the last
// step's impulses and hastened (SweepCourse), finds velocities at which nothing overlaps at the end
// of the step; boxes move; those that overlapped are shifted apart; boxes that stay calm fall
// asleep. Velocities are means over a step. Nothing is allocated after the last add().
#pragma once

#include <optional>
#include <vector>

#include "physics/boxes/SweepCourse.h"

namespace heft::boxes {

class BoxWorld {
 public:
  /// @param mass_blind where masses change no motion they change none by more than 1e-9 m: no
  /// shortcut that rounding could decide. Slower.
  BoxWorld(const ContactSurface& surface, double gravity_m_s2, std::size_t n_bodies,
           bool mass_blind);

  /// @return its index
  std::size_t add(const Body& body);
  Body& body(std::size_t i) { return bodies_[i]; }
  const Body& body(std::size_t i) const { return bodies_[i]; }
  std::size_t size() const { return bodies_.size(); }

  /// Puts to sleep what stands on the table and touches nothing else.
  void settle_at_start();

  /// Changes velocities so that nothing overlaps at the end of a step of h_s seconds.
  void solve(double h_s);

  /// Moves all bodies to the end of the step that was solved.
  void move(double h_s);

  /// Upper bound of the speed of any point of a body that moves and is solid.
  double fastest_m_s() const;

  /// Whether every box's velocity changes as it did a step ago: the length of a step may change.
  bool steady() const;

  /// Whether any two bodies that are not both asleep are nearer than reach_m, at most: their
  /// surrounding spheres are compared.
  bool crowded(double reach_m) const;

  /// The share of a step of h_s seconds after which a body that goes on as it does hits one that it
  /// does not touch yet; none if it does not, or so slowly that it does not matter when.
  std::optional<double> share_before_hitting(std::size_t i, double h_s) const;

  /// The share of a step of h_s seconds after which a body slides off one that it presses on, if it
  /// goes on as it does; none if it does not.
  std::optional<double> share_before_sliding_off(std::size_t i, double h_s) const;

  /// Mean impulse of `pusher` on `pushed` in the last step, N s; zero if they don't touch.
  Eigen::Vector3d impulse_n_s(std::size_t pusher, std::size_t pushed) const;

  /// Whether a body and another pressed on each other in the last step.
  bool touches(std::size_t i) const;

  /// Forgets the contacts that a body has had, and wakes all.
  void forget_contacts(std::size_t i);

 private:
  // Two bodies, or a body (first) and the table.
  struct Pair {
    std::size_t first, second;
    Manifold manifold;
    bool with_table() const { return first == second; }
  };

  bool moves(const Body& body) const { return body.solid && !body.asleep; }
  Contact contact(const Pair& pair, double h_s, double margin_m) const;
  bool near(const Pair& pair, double margin_m) const;
  bool can_push(const Pair& pair) const;
  void wake_reached(double h_s, double up_to_m_s);
  void begin_step(double h_s);
  void attempt(double h_s);
  void add_weight(double h_s);
  bool was_released();
  void note_rates(double h_s);
  void note_pushed();
  std::optional<double> share_before_hit(std::size_t i, double h_s) const;
  void find_contacts(double h_s, double up_to_m_s);
  void solve_contacts(double h_s, double up_to_m_s);
  void relax();
  enum class Sweep { all, unsettled, left_out };
  double sweep(Sweep which);
  void lift_from_table();
  void settle(double h_s);

  ContactSurface surface_;
  double gravity_m_s2_;
  bool mass_blind_;
  double last_h_s_ = 0;
  std::vector<Body> bodies_;
  Body table_;
  std::vector<Pair> pairs_;          ///< each body with the bodies before it, then with the table
  std::vector<Manifold*> touching_;  ///< of this step; the table's last
  SweepCourse course_;
  static constexpr double instant_share = 0.01;  // of another step: one that takes no time
  // A body at the start of the step.
  struct Start {
    Velocity velocity;
    double mean_over_s;  ///< of which its velocity is the mean; 0: it is momentary
    double owed_s;
    bool pushed;
    bool is_momentary(double h_s) const { return mean_over_s < instant_share * h_s; }
  };
  std::vector<Start> starts_;
  std::vector<Velocity> velocities_;  ///< before this step's contacts
  double reached_m_s_ = 0;            ///< by the fastest in the last step
  bool squeezed_ = false;             ///< in the last step a box had no room
};

}  // namespace heft::boxes
