// Boxes on a table. One step, in order:
//
// 1. Each body's free motion: two velocities, the mean over the step, which says where it gets to,
//    and the one at its end, which is what the next step starts from. Pushes are steady over a
//    step; a steady push changes a box's mean velocity by half of what it changes the end's by, and
//    the clone's two follow from its oscillator and are set by whoever drives it.
// 2. Neighbours (a Verlet list: pairs within some reach, looked for anew when a body has used the
//    reach up) are tested for contact as far ahead as the bodies get; what sleeps and is reached
//    wakes.
// 3. Points that touch and close in have hit: impulses without duration, and without weight, make
//    them move together. What was held before is held through the hit. It is a step of its own that
//    takes no time.
// 4. Contacts are solved by projected Gauss-Seidel with an extrapolated warm start and Anderson
//    mixing: with steady pushes, points that touch shall touch one step beyond the end, if nothing
//    pushes any more from the end on. With the end in place of that, velocities would ring from
//    step to step; with velocities alone, bodies would drift apart. Looking ahead takes two thirds
//    of a gap away in a step, so that both die out.
// 5. Points that are apart and would meet within the step, a patch whose slip friction stops, and
//    the clone sliding off a face, are events: the step ends there, and is solved anew for that
//    length with every contact in it.
// 6. Bodies move; boxes that stay at rest for a while fall asleep.
//
// Nothing is allocated after the last add().
#pragma once

#include <optional>
#include <vector>

#include "physics/boxes/ContactManifold.h"
#include "physics/scene/Scene.h"

namespace heft::boxes {

/// Says how driven bodies move by themselves: sets their motion for a step; for one of 0 s, what
/// pushes do to them within an instant.
class Driver {
 public:
  virtual ~Driver() = default;
  virtual void set_motion(Body& driven, const StepTime& time) const = 0;
};

struct SteppedBy {
  const Driver& driver;
  double beyond_s = 0;  ///< how far contacts look beyond the step's end
  bool cuts = true;     ///< false: what meets within the step stops there
};

class BoxWorld {
 public:
  BoxWorld(const ContactSurface& surface, double gravity_m_s2, std::size_t n_bodies);

  /// @return its index
  std::size_t add(const Body& body);
  Body& body(std::size_t i) { return bodies_[i]; }
  const Body& body(std::size_t i) const { return bodies_[i]; }

  /// Puts to sleep what stands on the table and touches nothing else.
  void settle_at_start();

  /// Goes on by h_s seconds, or until something happens that a step cannot contain: then the rest
  /// is for the next step.
  /// @return how long the step was; 0 if it was a hit
  double advance(double h_s, const SteppedBy& how);

  /// Whether driven bodies are nearer than reach_m to a box or the table.
  bool near_driven(double reach_m) const;
  /// Of boxes, rad/s.
  double fastest_turn_rad_s() const;

  /// Impulse of `pusher` on `pushed` over the last step, N s.
  Eigen::Vector3d impulse_n_s(std::size_t pusher, std::size_t pushed) const;

  /// Forgets the contacts that a body has had, and wakes all.
  void forget_contacts(std::size_t i);

  const SolveCounts& counts() const { return counts_; }

 private:
  // Two bodies, or a body (first) and the table.
  struct Pair {
    std::size_t first, second;
    Manifold manifold;
    Eigen::Vector3d hit_n_s = Eigen::Vector3d::Zero();  // on the first, of the last hit
    bool with_table() const { return first == second; }
    bool has(std::size_t i) const { return first == i || second == i; }
  };

  // Something within a step that the step cannot contain.
  struct Event {
    double fraction = 1;       // of the step, before it
    bool ends_pushes = false;  // of the clone: they say nothing of those that follow
  };

  double reach_m(const Body& body, double h_s) const;
  bool near(const Body& first, const Body& second, double margin_m) const;
  Contact contact(const Pair& pair, double h_s, double margin_m) const;
  void find_neighbours(double h_s);
  void list_neighbours();
  bool wake_reached(double h_s);
  double find_contacts(double h_s, double regular_s);
  void hit(const Driver& driver);
  void set_motions(double h_s, const SteppedBy& how);
  void solve(double h_s, const SteppedBy& how);
  void relax();
  double sweeps(bool mixed);
  void forget_impulses();
  void mix();
  Event next_event(double h_s) const;
  std::optional<double> fraction_before_sliding_off(const Pair& pair, double h_s) const;
  void move(double h_s, bool ends_pushes);
  void settle(double h_s);

  ContactSurface surface_;
  double gravity_m_s2_;
  std::vector<Body> bodies_;
  Body table_;
  std::vector<Pair> pairs_, old_pairs_;    ///< neighbours; each body with the table last
  std::vector<Eigen::Vector3d> listed_m_;  ///< where bodies were when neighbours were listed
  double listed_reach_m_ = 0;              ///< 0: to be listed anew
  bool hit_ = false;                       ///< the last step was one
  std::vector<Manifold*> touching_;        ///< of this step, in a sweep's order
  SolveCounts counts_;
  double last_energy_j_ = 0;  ///< of the last sweep's changes
};

}  // namespace heft::boxes
