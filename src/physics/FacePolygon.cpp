#include "physics/FacePolygon.h"

#include <algorithm>
#include <cmath>

namespace heft {

FacePolygon clipped(const FacePolygon& in, double FaceCorner::*coordinate, double sign,
                    double limit, int clip) {
  FacePolygon out;
  for (std::size_t i = 0; i < in.n; ++i) {
    const FaceCorner& from = in.corners[i];
    const FaceCorner& to = in.corners[(i + 1) % in.n];
    const double from_m = limit - sign * (from.*coordinate);
    const double to_m = limit - sign * (to.*coordinate);
    if (from_m >= 0) out.add(from);
    if ((from_m >= 0) == (to_m >= 0)) continue;
    const double s = from_m / (from_m - to_m);
    out.add({from.u + s * (to.u - from.u), from.v + s * (to.v - from.v),
             from.w + s * (to.w - from.w),
             16 * (4 * (from.feature % 16) + to.feature % 16) + 4 + clip});
  }
  return out;
}

void keep_four(FacePolygon& polygon) {
  if (polygon.n <= 4) return;
  const auto begin = polygon.corners.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(polygon.n);
  const auto pick = [&](auto from, auto score) {
    std::iter_swap(from, std::max_element(from, end, [&](const FaceCorner& x, const FaceCorner& y) {
                     return score(x) < score(y);
                   }));
    return *from;
  };
  const FaceCorner p = pick(begin, [](const FaceCorner& c) { return -c.w; });
  const FaceCorner q =
      pick(begin + 1, [&](const FaceCorner& c) { return std::hypot(c.u - p.u, c.v - p.v); });
  const auto side = [&](const FaceCorner& c) {
    return (q.u - p.u) * (c.v - p.v) - (q.v - p.v) * (c.u - p.u);
  };
  pick(begin + 2, side);
  pick(begin + 3, [&](const FaceCorner& c) { return -side(c); });
  polygon.n = 4;
}

}  // namespace heft
