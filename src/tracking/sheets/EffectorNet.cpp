#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Error.h"
#include "tracking/sheets/Sheet.h"

namespace heft {

namespace {
constexpr double flap_m = 0.008, flap_slant_m = 0.004;

// The edges of a face's outline, clockwise.
using Edge = std::array<NetPoint, 2>;
std::vector<Edge> edges(const NetFace& face) {
  const std::vector<NetPoint> corners = face.corners_m();
  std::vector<Edge> all;
  for (std::size_t i = 0; i < corners.size(); ++i)
    all.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return all;
}

// A long face's edges, in clockwise order.
enum Side : std::uint8_t { above, to_the_right, below, to_the_left };

// A flap for glue: folded at the face, cut around.
void add_flap(EffectorNet& net, const Edge& edge) {
  const auto [from, to] = edge;
  const NetPoint along = (to - from).normalized();
  const NetPoint outwards(-along.y(), along.x());
  const NetPoint near = from + flap_m * outwards + flap_slant_m * along;
  const NetPoint far = to + flap_m * outwards - flap_slant_m * along;
  net.folds_m.push_back({from, to});
  net.cuts_m.push_back({from, near});
  net.cuts_m.push_back({near, far});
  net.cuts_m.push_back({far, to});
}

bool is_same(const Edge& a, const Edge& b) {
  constexpr double tolerance_m = 1e-9;
  return ((a[0] - b[1]).norm() < tolerance_m && (a[1] - b[0]).norm() < tolerance_m);
}

// An end is attached to one long face, and has flaps on its other edges.
void add_end(EffectorNet& net, BoxFace end, BoxFace hangs_on, Side side) {
  const Edge hinge = edges(net.at(hangs_on))[side];
  net.folds_m.push_back(hinge);
  for (const Edge& edge : edges(net.at(end)))
    if (!is_same(edge, hinge)) add_flap(net, edge);
}

// The long faces side by side, in the order around the box.
std::vector<BoxFace> strip(const BoxShape& box) {
  using enum BoxFace;
  if (box.chamfer_m > 0) return {top, upper_right, right, bottom, left, upper_left};
  return {top, right, bottom, left};
}

void add_lines(EffectorNet& net, const std::vector<BoxFace>& faces, BoxFace back_hangs_on) {
  add_end(net, BoxFace::tip, BoxFace::bottom, above);
  add_end(net, BoxFace::back, back_hangs_on, below);
  for (const BoxFace face : faces) {
    const std::vector<Edge> around = edges(net.at(face));
    if (face != BoxFace::bottom) net.cuts_m.push_back(around[above]);
    if (face != back_hangs_on) net.cuts_m.push_back(around[below]);
    if (face != faces.back()) net.folds_m.push_back(around[to_the_right]);
  }
  net.cuts_m.push_back(edges(net.at(faces.front()))[to_the_left]);
  add_flap(net, edges(net.at(faces.back()))[to_the_right]);
}
}  // namespace

NetPoint NetFace::on_net(const Eigen::Vector3d& point_m) const {
  return center_m + (upside_down ? -1 : 1) * frame.flat(point_m);
}

Eigen::Vector3d NetFace::on_box(const NetPoint& point_m) const {
  return frame.at((upside_down ? -1 : 1) * (point_m - center_m));
}

std::vector<NetPoint> NetFace::corners_m() const {
  std::vector<NetPoint> corners;
  for (const NetPoint& corner : frame.outline_m())
    corners.push_back(center_m + (upside_down ? -1 : 1) * corner);
  return corners;
}

const NetFace& EffectorNet::at(BoxFace face) const {
  return *std::ranges::find(faces, face, &NetFace::face);
}

EffectorNet effector_net(const BoxShape& box) {
  const double length = box.size_m.x(), height = box.size_m.z();
  const double low_m = flap_m + height, middle_m = low_m + length / 2;
  const std::vector<BoxFace> long_faces = strip(box);
  EffectorNet net;
  double right_m = flap_m;  // the back's left flap may extend beyond the strip
  for (const BoxFace face : long_faces) {
    const FaceFrame frame = face_frame(box, face);
    net.faces.push_back({face, frame, {right_m + frame.size_m.x() / 2, middle_m}});
    right_m += frame.size_m.x();
  }
  // A chamfered box's top is narrower than its ends.
  const bool chamfered = box.chamfer_m > 0;
  const BoxFace back_hangs_on = chamfered ? BoxFace::bottom : BoxFace::top;
  const double tip_x = net.at(BoxFace::bottom).center_m.x();
  const double back_x = net.at(back_hangs_on).center_m.x();
  net.faces.push_back(
      {BoxFace::tip, face_frame(box, BoxFace::tip), {tip_x, low_m + length + height / 2}});
  net.faces.push_back(
      {BoxFace::back, face_frame(box, BoxFace::back), {back_x, flap_m + height / 2}, chamfered});
  add_lines(net, long_faces, back_hangs_on);
  net.size_m = {right_m + flap_m, length + 2 * height + 2 * flap_m};
  return net;
}

BoxFace face_of(const BoxShape& box, const Tag& tag) {
  constexpr double tilt_cosine = 0.98, distance_m = 0.003;  // tolerance of a tag glued by hand
  const Eigen::Vector3d normal = tag_normal(tag), center_m = tag_center_m(tag);
  for (const BoxFace face : faces_of(box)) {
    const FaceFrame frame = face_frame(box, face);
    const double above_m = (center_m - frame.center_m).dot(frame.normal());
    if (normal.dot(frame.normal()) > tilt_cosine && std::abs(above_m) < distance_m) return face;
  }
  throw Error(
      fmt::format("tag {} is on no face of the box; a net can only have tags that are", tag.id),
      ExitCode::invalid_file);
}

}  // namespace heft
