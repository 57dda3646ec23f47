#include "physics/boxes/BoxWorld.h"

#include <algorithm>
#include <cmath>

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double calm_speed_m_s = 1e-4, calm_turn_rad_s = 5e-3, calm_for_s = 0.25;
// Contacts are looked for this far ahead, beside what the boxes can cover in a step.
constexpr double near_m = 0.1e-3;
// How much faster than in the last step boxes may become before contacts are looked for again.
constexpr double hurry = 1.2, hurry_m_s = 0.01;
// A travel that is worth finding out where on the way boxes meet.
constexpr double far_m = 0.1e-3;
constexpr double clear_m = 1e-6;  // boxes that slid off each other are so far apart
constexpr double exactly_m = 1e-9;
constexpr double rounding = 1e-10;  // m or rad
constexpr int most_sweeps = 500;
constexpr double enough_m_s = 2e-6;    // sweeps end when no velocity changes by more
constexpr double settled_m_s = 2e-7;   // a contact that a sweep changed by less has settled
constexpr double squeezed_m_s = 0.01;  // what never ends has no answer

// Any body may become as fast as the fastest within a step, by being hit.
double look_ahead_m(double h_s, double up_to_m_s) {
  return near_m + 2 * h_s * up_to_m_s;
}
}  // namespace

BoxWorld::BoxWorld(const ContactSurface& surface, double gravity_m_s2, std::size_t n_bodies,
                   bool mass_blind)
    : surface_(surface), gravity_m_s2_(gravity_m_s2), mass_blind_(mass_blind) {
  if (mass_blind) surface_.same_place = rounding;
  surface_.foresees = !mass_blind;
  bodies_.reserve(n_bodies);
  pairs_.reserve(n_bodies * (n_bodies + 1) / 2);
  course_.reserve(n_bodies);
  starts_.reserve(n_bodies);
  velocities_.reserve(n_bodies);
  table_.solid = false;  // not one of the boxes
}

std::size_t BoxWorld::add(const Body& body) {
  const std::size_t index = bodies_.size();
  bodies_.push_back(body);
  for (std::size_t i = 0; i <= index; ++i) pairs_.push_back({index, i, {}});
  touching_.reserve(pairs_.size());
  return index;
}

void BoxWorld::settle_at_start() {
  for (Body& body : bodies_) {
    const Contact standing = contact_with_table(body.shape, near_m);
    body.asleep = body.has_weight && standing.n_points == 4;
    for (const ContactPoint& point : standing.all())
      if (std::abs(point.distance_m) > exactly_m) body.asleep = false;
  }
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || contact(pair, 0, near_m).n_points == 0) continue;
    bodies_[pair.first].asleep = bodies_[pair.second].asleep = false;
  }
}

double BoxWorld::fastest_m_s() const {
  double fastest_m_s = 0;
  for (const Body& body : bodies_)
    if (moves(body)) fastest_m_s = std::max(fastest_m_s, body.tip_speed_m_s());
  return fastest_m_s;
}

bool BoxWorld::near(const Pair& pair, double margin_m) const {
  const Body& first = bodies_[pair.first];
  const Body& second = bodies_[pair.second];
  const double reach_m = first.radius_m + second.radius_m + margin_m;
  return (first.pose.position_m - second.pose.position_m).squaredNorm() < reach_m * reach_m;
}

Contact BoxWorld::contact(const Pair& pair, double h_s, double margin_m) const {
  const Body& first = bodies_[pair.first];
  const Body& second = bodies_[pair.second];
  if (pair.with_table()) return contact_with_table(first.shape, margin_m);
  if (!near(pair, margin_m)) return {};
  const Vector3d travel_m = h_s * (first.velocity.linear_m_s - second.velocity.linear_m_s);
  if (pair.manifold.touches() || travel_m.squaredNorm() < far_m * far_m)
    return contact_between(first.shape, second.shape, margin_m);
  return contact_on_the_way(first.shape, second.shape, travel_m, margin_m);
}

void BoxWorld::wake_reached(double h_s, double up_to_m_s) {
  const double margin_m = look_ahead_m(h_s, up_to_m_s);
  for (bool woken = true; woken;) {
    woken = false;
    for (const Pair& pair : pairs_) {
      Body& first = bodies_[pair.first];
      Body& second = bodies_[pair.second];
      if (first.asleep == second.asleep || !first.solid || !second.solid) continue;
      if (!near(pair, margin_m) || contact(pair, h_s, margin_m).n_points == 0) continue;
      first.wake();
      second.wake();
      woken = true;
    }
  }
}

bool BoxWorld::can_push(const Pair& pair) const {
  const Body& first = bodies_[pair.first];
  const Body& second = bodies_[pair.second];
  const bool gives = first.inverse_mass_per_kg > 0 || second.inverse_mass_per_kg > 0;
  return gives && moves(first) && moves(second);
}

void BoxWorld::find_contacts(double h_s, double up_to_m_s) {
  touching_.clear();
  const bool as_long = instant_share * h_s < last_h_s_ && instant_share * last_h_s_ < h_s;
  if (squeezed_ || !as_long)  // they tell nothing about this step's
    for (Pair& pair : pairs_) pair.manifold.forget_impulses();
  for (const bool with_table : {false, true}) {
    const double margin_m = look_ahead_m(h_s, with_table ? up_to_m_s / 2 : up_to_m_s);
    for (Pair& pair : pairs_) {
      if (pair.with_table() != with_table) continue;
      Body& first = bodies_[pair.first];
      Body& second = with_table ? table_ : bodies_[pair.second];
      if (first.asleep && (with_table || second.asleep)) continue;  // keep their impulses
      if (!can_push(pair))
        pair.manifold.clear();
      else if (pair.manifold.still_fits(margin_m))
        pair.manifold.prepare_again(h_s);
      else
        pair.manifold.prepare(contact(pair, h_s, margin_m), first, second, surface_, h_s, margin_m);
      if (!pair.manifold.empty()) touching_.push_back(&pair.manifold);
    }
  }
}

// The table comes last in a sweep: where a coupled clone squeezes a cube against it there is no
// answer, and the cube should stay above the table. The impulses grow without end then and are no
// start for the next step. Sweeps leave out contacts that have settled, and come back to these when
// the others have settled too.
void BoxWorld::relax() {
  for (Manifold* manifold : touching_) manifold->warm_start();
  course_.begin(bodies_, touching_);
  double change_m_s = 0;
  Sweep next = Sweep::all;
  for (int i = 0; i < most_sweeps; ++i) {
    change_m_s = sweep(next);
    const bool settled = change_m_s <= enough_m_s;
    if (settled && next != Sweep::unsettled) break;
    if (mass_blind_) continue;
    if (next == Sweep::left_out) course_.begin(bodies_, touching_);
    next = settled ? Sweep::left_out : Sweep::unsettled;
    if (!settled) course_.go_on(bodies_, touching_);
  }
  squeezed_ = change_m_s > squeezed_m_s;
}

double BoxWorld::sweep(Sweep which) {
  double change_m_s = 0;
  for (Manifold* manifold : touching_) {
    const bool unsettled = manifold->changed_m_s() > settled_m_s;
    manifold->left_out =
        which == Sweep::unsettled ? !unsettled : which == Sweep::left_out && !manifold->left_out;
    if (!manifold->left_out) change_m_s = std::max(change_m_s, manifold->relax());
  }
  return change_m_s;
}

void BoxWorld::solve(double h_s) {
  begin_step(h_s);
  attempt(h_s);
  if (was_released()) attempt(h_s);
  note_rates(h_s);
  last_h_s_ = h_s;
}

// A clone that is held back would be much faster if it were not: contacts are looked for as far as
// boxes can go at about the speeds of the last step, and farther only if they turn out to be
// faster.
void BoxWorld::attempt(double h_s) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].velocity = starts_[i].velocity;
  const double free_m_s = fastest_m_s();
  const double foreseen_m_s = std::min(free_m_s, hurry * reached_m_s_ + hurry_m_s);
  wake_reached(h_s, free_m_s);
  add_weight(h_s);
  velocities_.clear();
  for (const Body& body : bodies_) velocities_.push_back(body.velocity);
  solve_contacts(h_s, foreseen_m_s);
  if (reached_m_s_ <= foreseen_m_s || foreseen_m_s == free_m_s) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].velocity = velocities_[i];
  solve_contacts(h_s, free_m_s);
}

void BoxWorld::solve_contacts(double h_s, double up_to_m_s) {
  find_contacts(h_s, up_to_m_s);
  relax();
  reached_m_s_ = fastest_m_s();
}

void BoxWorld::move(double h_s) {
  for (Body& body : bodies_)
    if (!body.asleep) body.move(h_s);
  bool pushed = false;
  for (Manifold* manifold : touching_) pushed = manifold->push_apart() || pushed;
  if (pushed && surface_.compliance_m_per_n == 0) lift_from_table();
  settle(h_s);
}

// The table has the last word: a coupled clone may have pushed a cube into it.
void BoxWorld::lift_from_table() {
  for (Body& body : bodies_) {
    if (!body.has_weight || body.asleep) continue;
    const Contact standing = contact_with_table(body.shape, 0);
    double deepest_m = 0;
    for (const ContactPoint& point : standing.all())
      deepest_m = std::max(deepest_m, -point.distance_m);
    if (deepest_m > 0) body.shift({0, 0, deepest_m}, Vector3d::Zero());
  }
}

void BoxWorld::settle(double h_s) {
  for (Body& body : bodies_) {
    if (body.asleep) continue;
    const bool calm = body.has_weight &&
                      body.velocity.linear_m_s.squaredNorm() < calm_speed_m_s * calm_speed_m_s &&
                      body.velocity.angular_rad_s.squaredNorm() < calm_turn_rad_s * calm_turn_rad_s;
    body.calm_s = calm ? body.calm_s + h_s : 0;
  }
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || !pair.manifold.touches()) continue;
    double& first_s = bodies_[pair.first].calm_s;
    double& second_s = bodies_[pair.second].calm_s;
    first_s = second_s = std::min(first_s, second_s);
  }
  for (Body& body : bodies_) {
    if (body.asleep || body.calm_s < calm_for_s) continue;
    body.asleep = true;
    body.velocity = {};
  }
}

bool BoxWorld::steady() const {
  return std::ranges::all_of(bodies_, [](const Body& body) {
    return !body.has_weight || body.asleep || body.fresh || body.steady;
  });
}

bool BoxWorld::crowded(double reach_m) const {
  return std::ranges::any_of(pairs_, [&](const Pair& pair) {
    const Body& first = bodies_[pair.first];
    const Body& second = bodies_[pair.second];
    return !pair.with_table() && !(first.asleep && second.asleep) && first.solid && second.solid &&
           near(pair, reach_m);
  });
}

std::optional<double> BoxWorld::share_before_sliding_off(std::size_t i, double h_s) const {
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || (pair.first != i && pair.second != i)) continue;
    if (!pair.manifold.touches()) continue;
    const Body& second = bodies_[pair.second];
    const Vector3d& normal = pair.manifold.normal();
    Vector3d travel_m =
        h_s * (bodies_[pair.first].velocity.linear_m_s - second.velocity.linear_m_s);
    travel_m -= travel_m.dot(normal) * normal;
    if (travel_m.squaredNorm() < clear_m * clear_m) continue;
    Box first = bodies_[pair.first].shape;
    first.center_m -= near_m * normal;  // so that they overlap
    const auto share = parting(first, second.shape, travel_m);
    if (share) return std::min(1.0, *share + clear_m / travel_m.norm());
  }
  return std::nullopt;
}

Vector3d BoxWorld::impulse_n_s(std::size_t pusher, std::size_t pushed) const {
  const auto [low, high] = std::minmax(pusher, pushed);
  const Vector3d on_high = pairs_[high * (high + 1) / 2 + low].manifold.impulse_n_s();
  return pushed == high ? on_high : Vector3d(-on_high);
}

bool BoxWorld::touches(std::size_t i) const {
  return std::ranges::any_of(pairs_, [i](const Pair& pair) {
    return !pair.with_table() && (pair.first == i || pair.second == i) && pair.manifold.touches();
  });
}

void BoxWorld::forget_contacts(std::size_t i) {
  for (Body& body : bodies_) body.wake();
  for (Pair& pair : pairs_)
    if (pair.first == i || pair.second == i) pair.manifold.clear();
}

}  // namespace heft::boxes
