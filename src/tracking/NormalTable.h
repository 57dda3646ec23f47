// The normal distribution function and its density by table.
#pragma once

namespace heft {

struct Normal {
  double below, density;
};

/// To 1e-5.
Normal normal_at(double x);

}  // namespace heft
