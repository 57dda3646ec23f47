// What a BoxWorld's velocities are: means over steps, which may differ in length, begin with a hit
// or end with a release.
#include <algorithm>
#include <cmath>

#include "physics/boxes/BoxWorld.h"

namespace heft::boxes {

using Eigen::Vector3d;

namespace {
constexpr double still_m_s = 1e-4;
// A travel in a step that is too short for it to matter when in the step boxes meet.
constexpr double short_m = 0.02e-3;
// Of a rate of change, beside a share of it: what the next step is expected to repeat.
constexpr double steady_share = 0.5, steady_m_s2 = 0.05;
}  // namespace

// A velocity is the mean over a step. Before a step of another length it becomes what the mean over
// so long would have been, where it changes steadily.
void BoxWorld::begin_step(double h_s) {
  starts_.clear();
  note_pushed();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    Start start{body.velocity, body.fresh ? 0 : last_h_s_, body.owed_s, body.pushed};
    if (body.steady && start.mean_over_s > 0 && body.has_weight) {
      start.velocity.linear_m_s += (last_h_s_ - h_s) / 2 * body.rate_m_s2;
      start.mean_over_s = h_s;
    }
    body.fresh = false;
    starts_.push_back(start);
  }
}

// Weight, and with it friction, adds to a velocity from the middle of the last step to the middle
// of this one, but from the start of this one where the velocity is momentary. What the clone
// pushes follows the coupling law, which counts whole steps.
void BoxWorld::add_weight(double h_s) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const Start& start = starts_[i];
    if (!body.has_weight || body.asleep) continue;
    const bool counts_whole = start.pushed && !start.is_momentary(h_s);
    double fall_s = counts_whole ? h_s : (start.mean_over_s + h_s) / 2;
    fall_s += start.owed_s;
    body.owed_s = 0;
    if (const auto hit = share_before_hit(i, h_s)) {
      // Friction acts on the mean velocity of this step by (moving_s)^2 / 2 h, on that of the next
      // by what is left until its middle.
      const double moving_s = (1 - *hit) * h_s;
      fall_s = moving_s * moving_s / (2 * h_s);
      body.owed_s = moving_s - fall_s - h_s / 2;
    }
    body.velocity.linear_m_s.z() -= fall_s * gravity_m_s2_;
    body.tumble(h_s);
  }
}

// Whether the driven body no longer pushes one that it pushed, and nothing else does: friction
// alone slows that one from the start of this step on, from the velocity that it had then.
bool BoxWorld::was_released() {
  note_pushed();
  bool any = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Start& start = starts_[i];
    const bool released = start.pushed && !bodies_[i].pushed && !touches(i);
    if (!released || start.mean_over_s == 0) continue;
    if (bodies_[i].steady)
      start.velocity.linear_m_s += start.mean_over_s / 2 * bodies_[i].rate_m_s2;
    start.mean_over_s = 0;
    any = true;
  }
  return any;
}

void BoxWorld::note_rates(double h_s) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.has_weight || body.asleep) continue;
    const Start& start = starts_[i];
    const double over_s = (start.mean_over_s + h_s) / 2;
    const Vector3d rate_m_s2 = (body.velocity.linear_m_s - start.velocity.linear_m_s) / over_s;
    const double change_m_s2 = (rate_m_s2 - body.rate_m_s2).norm();
    const bool lasts_alike = !start.is_momentary(h_s) && h_s > instant_share * start.mean_over_s;
    body.steady = lasts_alike && change_m_s2 <= steady_share * rate_m_s2.norm() + steady_m_s2;
    body.rate_m_s2 = rate_m_s2;
  }
}

// The share of the step after which another cube hits this one, which stood still until then; none
// if that does not happen.
std::optional<double> BoxWorld::share_before_hit(std::size_t i, double h_s) const {
  if (!bodies_[i].velocity.linear_m_s.isZero(still_m_s)) return std::nullopt;
  std::optional<double> soonest;
  for (const Pair& pair : pairs_) {
    if (pair.first != i && pair.second != i) continue;
    if (pair.manifold.touches() != pair.with_table()) return std::nullopt;
    const Body& first = bodies_[pair.first];
    const Body& second = bodies_[pair.second];
    if (pair.with_table() || !first.has_weight || !second.has_weight) continue;
    const Vector3d travel_m = h_s * (first.velocity.linear_m_s - second.velocity.linear_m_s);
    const double length_m = travel_m.norm();
    if (length_m < short_m || !near(pair, length_m)) continue;
    const Contact contact = contact_between(first.shape, second.shape, length_m);
    const double closing_m = -contact.normal.dot(travel_m);
    for (const ContactPoint& point : contact.all())
      if (point.distance_m >= 0 && point.distance_m < closing_m)
        soonest = std::min(soonest.value_or(1), point.distance_m / closing_m);
  }
  return soonest;
}

// From body to body, as far as they press on each other.
void BoxWorld::note_pushed() {
  for (Body& body : bodies_) body.pushed = !body.has_weight;
  for (bool more = true; more;) {
    more = false;
    for (const Pair& pair : pairs_) {
      Body& first = bodies_[pair.first];
      Body& second = bodies_[pair.second];
      if (first.pushed == second.pushed || !pair.manifold.touches()) continue;
      first.pushed = second.pushed = more = true;
    }
  }
}

std::optional<double> BoxWorld::share_before_hitting(std::size_t i, double h_s) const {
  std::optional<double> soonest;
  for (const Pair& pair : pairs_) {
    if (pair.with_table() || (pair.first != i && pair.second != i)) continue;
    if (pair.manifold.touches()) continue;
    const Body& first = bodies_[pair.first];
    const Body& second = bodies_[pair.second];
    const Vector3d travel_m = h_s * (first.velocity.linear_m_s - second.velocity.linear_m_s);
    const double length_m = travel_m.norm();
    if (length_m < short_m || !first.solid || !second.solid || !near(pair, length_m)) continue;
    if (const auto share = meeting(first.shape, second.shape, travel_m))
      soonest = std::min(soonest.value_or(1), *share);
  }
  return soonest;
}

}  // namespace heft::boxes
