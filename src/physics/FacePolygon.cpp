#include "physics/FacePolygon.h"

#include <algorithm>
#include <cmath>

namespace heft {

FacePolygon clipped(const FacePolygon& face, double FaceCorner::*coordinate, double sign,
                    double limit, int clip) {
  return clipped(
      face, [&](const FaceCorner& corner) { return limit - sign * (corner.*coordinate); },
      [&](const FaceCorner& from, const FaceCorner& to, double s) -> FaceCorner {
        return {from.u + s * (to.u - from.u), from.v + s * (to.v - from.v),
                from.w + s * (to.w - from.w),
                16 * (4 * (from.feature % 16) + to.feature % 16) + 4 + clip};
      });
}

void keep_four(FacePolygon& polygon) {
  if (polygon.size() <= 4) return;
  const auto begin = polygon.begin(), end = polygon.end();
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
  polygon.keep_first(4);
}

}  // namespace heft
