// Rigid boxes on a table. One step, in order:
//
// 1. Free motion of each body: its mean velocity over the step and its velocity at the end, without
//    contacts. The driver sets both for the clone, from the coupling's oscillator.
// 2. Contact detection. Neighbors (a Verlet list: pairs within a distance, listed again when bodies
//    have moved that far) are tested as far ahead as the bodies can move in the step. Sleeping
//    bodies that could be reached wake.
// 3. Impact. If points in contact approach each other, impulses over an instant stop the approach.
//    The impact is a step of zero length; impulses of the contact forces are kept for the next
//    step.
// 4. Contact solver, see ContactSolver.cpp.
// 5. Events that a step cannot contain: points meet, friction stops a sliding patch, or the clone
//    slides off a face. The step ends at the first event and is solved again for that length.
// 6. Bodies move. Boxes that have been at rest for a while fall asleep.
//
// No memory is allocated after the last add().
#pragma once

#include <optional>
#include <vector>

#include "physics/boxes/ContactManifold.h"
#include "physics/scene/Scene.h"

namespace heft::boxes {

/// Sets the free motion of driven bodies over a step; for a step of 0 s, their response to an
/// impact.
class Driver {
 public:
  virtual ~Driver() = default;
  virtual void set_motion(Body& driven, const StepTime& time) const = 0;
};

struct StepOptions {
  const Driver& driver;
  double lookahead_s = 0;        ///< of the contacts, see ContactSolver.cpp
  bool splits_at_events = true;  ///< false: speculative contacts instead
};

class BoxWorld {
 public:
  BoxWorld(const ContactSurface& surface, double gravity_m_s2, std::size_t n_bodies);

  /// @return its index
  std::size_t add(const Body& body);
  Body& body(std::size_t i) { return bodies_[i]; }
  const Body& body(std::size_t i) const { return bodies_[i]; }

  /// Lets boxes sleep that stand on the table and touch nothing else.
  void sleep_resting_bodies();

  /// Makes one step of h_s seconds, or a shorter one up to the first event.
  /// @return the length of the step; 0 for an impact
  double advance(double h_s, const StepOptions& options);

  /// Whether a driven body is nearer than distance_m to a box or the table.
  bool driven_body_within(double distance_m) const;
  double max_angular_speed_rad_s() const;

  /// Impulse of `pusher` on `pushed` over the last step, N s.
  Eigen::Vector3d impulse_n_s(std::size_t pusher, std::size_t pushed) const;

  /// Drops the contacts of a body and wakes all bodies.
  void forget_contacts(std::size_t i);

  const SolveCounts& counts() const { return counts_; }

 private:
  // Two bodies, or one body and the table.
  struct Pair {
    std::size_t first, second;
    ContactManifold manifold;
    Eigen::Vector3d impact_n_s = Eigen::Vector3d::Zero();  // on the first body, of the last impact
    bool with_table() const { return first == second; }
    bool has(std::size_t i) const { return first == i || second == i; }
  };

  struct Event {
    double fraction = 1;  // of the step
    // The contact force on the clone ends, because it slides off, or begins to grow.
    bool changes_force = false;
  };

  double travel_bound_m(const Body& body, double h_s) const;
  bool within(const Body& first, const Body& second, double margin_m) const;
  Contact contact(const Pair& pair, double h_s, double margin_m) const;
  ContactSurface surface(const Pair& pair) const;
  void update_neighbors(double h_s);
  void list_neighbors();
  bool wake_within_reach(double h_s);
  StepTime time_of(double h_s, const StepOptions& options) const;
  double find_contacts(double h_s, double regular_s);
  void solve_impact(const Driver& driver);
  void set_motions(const StepTime& time, const Driver& driver);
  void solve(const StepTime& time, const StepOptions& options);
  void iterate();
  double run_sweeps(bool accelerated);
  void clear_impulses();
  void accelerate();
  Event next_event(double h_s) const;
  std::optional<double> fraction_before_separation(const Pair& pair, double h_s) const;
  void move(double h_s, bool ends_contact);
  void update_sleep(double h_s);

  ContactSurface surface_;
  double gravity_m_s2_;
  std::vector<Body> bodies_;
  Body table_;
  std::vector<Pair> pairs_, old_pairs_;     ///< neighbors; pairs with the table last
  std::vector<Eigen::Vector3d> listed_m_;   ///< positions of the bodies at that time
  double listed_reach_m_ = 0;               ///< 0: list again
  bool was_impact_ = false;                 ///< the last step was an impact
  std::vector<ContactManifold*> touching_;  ///< of this step, in the order of a sweep
  SolveCounts counts_;
  double last_energy_j_ = 0;  ///< of the changes of the last sweep
};

}  // namespace heft::boxes
