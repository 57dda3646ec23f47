#include "inference/IntervalEnd.h"

#include <algorithm>
#include <cmath>

namespace heft {

void IntervalEnd::search(double first_step) {
  constexpr int most_doublings = 14;
  const double center = best_.at[parameter_], beyond = std::abs(limit_ - center);
  // Doubled each time, and never beyond twice the last place: the others have to follow.
  double distance = std::min(first_step, (1 + std::abs(center)) / 2);
  Parameters change = likelihood_.tangent(best_.at, parameter_);
  for (int n_doublings = 0; n_doublings < most_doublings && !end_;) {
    double to = distance >= beyond ? limit_ : center + direction_ * distance;
    if (is_too_far(to)) {
      to = last_.at[parameter_] / 2;
    } else {
      distance *= 2;
      n_doublings += 1;
    }
    // Where the others go on as they went, or stay: going on may lead to a bound where nothing is
    // likely, and from where no way leads back.
    const Parameters ahead = last_.at + (to - last_.at[parameter_]) * change;
    const Maximum outer = likelier(likelihood_.profile(parameter_, to, ahead, last_.at),
                                   likelihood_.profile_from_anywhere(parameter_, to, last_.at));
    likeliest_ = likelier(likeliest_, outer);
    if (excess(outer) > 0)
      end_ = between(last_, outer);
    else if (to == limit_)
      end_ = limit_;
    if (to != last_.at[parameter_]) change = (outer.at - last_.at) / (to - last_.at[parameter_]);
    last_ = outer;
  }
}

// From afar towards 0, where there may be hills: halfway at most, so that the others can follow.
bool IntervalEnd::is_too_far(double to) const {
  const double here = last_.at[parameter_];
  return !likelihood_.is_one_hill() && direction_ * here < -1 &&
         std::abs(to - here) > std::abs(here) / 2;
}

double IntervalEnd::excess(const Maximum& there) const {
  const double fall = std::max(0.0, best_.log_likelihood - there.log_likelihood);
  return std::sqrt(fall) - std::sqrt(interval_drop);
}

double IntervalEnd::between(Maximum inner, Maximum outer) {
  double at_inner = excess(inner), at_outer = excess(outer);
  bool was_inner = false, was_outer = false;
  for (int i = 0; i < 60; ++i) {
    const double from = inner.at[parameter_], to = outer.at[parameter_];
    const double here = to - at_outer * (to - from) / (at_outer - at_inner);
    const double part = (here - from) / (to - from);
    Maximum middle = likelihood_.profile(parameter_, here, inner.at + part * (outer.at - inner.at));
    // Between two that stand on different hills neither's way leads to the higher one for sure.
    if (!likelihood_.is_one_hill())
      middle = likelier(middle, likelihood_.profile(parameter_, here, inner.at, outer.at));
    else if (middle.log_likelihood < outer.log_likelihood)  // got stuck
      middle = likelier(middle, likelihood_.profile(parameter_, here, inner.at));
    const double at_middle = excess(middle);
    if (std::abs(at_middle) < 1e-6) return here;
    const bool is_inner = at_middle < 0;
    (is_inner ? inner : outer) = middle;
    (is_inner ? at_inner : at_outer) = at_middle;
    if (is_inner && was_inner) at_outer /= 2;
    if (!is_inner && was_outer) at_inner /= 2;
    was_inner = is_inner;
    was_outer = !is_inner;
  }
  return outer.at[parameter_];
}

}  // namespace heft
