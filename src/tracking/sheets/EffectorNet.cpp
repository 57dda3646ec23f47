#include "tracking/sheets/EffectorNet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Error.h"

namespace heft {

namespace {
constexpr double flap_m = 0.008, flap_slant_m = 0.004;

enum Side { above, to_the_right, below, to_the_left };

// A side's ends, clockwise: from the corner where the one before ends.
std::array<NetPoint, 2> ends(const NetFace& face, Side side) {
  const auto corners = face.corners_m();
  return {corners[side], corners[(static_cast<std::size_t>(side) + 1) % 4]};
}

void add_cut(EffectorNet& net, BoxFace face, Side side) {
  net.cuts_m.push_back(ends(net.at(face), side));
}

// A flap to put glue on: folded at the face, cut around.
void add_flap(EffectorNet& net, BoxFace face, Side side) {
  const auto [from, to] = ends(net.at(face), side);
  const NetPoint along = (to - from).normalized();
  const NetPoint outwards(-along.y(), along.x());
  const NetPoint near = from + flap_m * outwards + flap_slant_m * along;
  const NetPoint far = to + flap_m * outwards - flap_slant_m * along;
  net.folds_m.push_back({from, to});
  net.cuts_m.push_back({from, near});
  net.cuts_m.push_back({near, far});
  net.cuts_m.push_back({far, to});
}

void add_flaps_and_lines(EffectorNet& net) {
  using enum BoxFace;
  for (const Side side : {above, to_the_left, to_the_right}) add_flap(net, tip, side);
  for (const Side side : {below, to_the_left, to_the_right}) add_flap(net, back, side);
  add_flap(net, left, to_the_right);
  for (const BoxFace face : {top, right, left}) add_cut(net, face, above);
  for (const BoxFace face : {right, bottom, left}) add_cut(net, face, below);
  add_cut(net, top, to_the_left);
  for (const BoxFace face : {top, right, bottom})
    net.folds_m.push_back(ends(net.at(face), to_the_right));
  net.folds_m.push_back(ends(net.at(tip), below));
  net.folds_m.push_back(ends(net.at(back), above));
}
}  // namespace

std::array<NetPoint, 4> NetFace::corners_m() const {
  const NetPoint half = frame.size_m / 2;
  return {center_m + NetPoint(-half.x(), half.y()), center_m + half,
          center_m + NetPoint(half.x(), -half.y()), center_m - half};
}

EffectorNet effector_net(const Eigen::Vector3d& size_m) {
  const double length = size_m.x(), width = size_m.y(), height = size_m.z();
  // Lower left of the strip of long faces; the back's left flap may reach beyond it.
  const double left_m = flap_m, low_m = flap_m + height;
  const double middle_m = low_m + length / 2;
  EffectorNet net;
  const auto add = [&](BoxFace face, double x, double y) {
    net.faces.push_back({face, face_frame(size_m, face), {left_m + x, y}});
  };
  add(BoxFace::tip, width * 1.5 + height, low_m + length + height / 2);
  add(BoxFace::top, width / 2, middle_m);
  add(BoxFace::left, 2 * width + height * 1.5, middle_m);
  add(BoxFace::right, width + height / 2, middle_m);
  add(BoxFace::bottom, width * 1.5 + height, middle_m);
  add(BoxFace::back, width / 2, flap_m + height / 2);
  add_flaps_and_lines(net);
  net.size_m = {2 * (width + height) + 2 * flap_m, length + 2 * height + 2 * flap_m};
  return net;
}

BoxFace face_of(const Eigen::Vector3d& size_m, const Tag& tag) {
  constexpr double tilt_cosine = 0.98, distance_m = 0.003;  // of one put on by hand
  const Eigen::Vector3d normal = tag_normal(tag), center_m = tag_center_m(tag);
  for (const BoxFace face : box_faces) {
    const FaceFrame frame = face_frame(size_m, face);
    const double above_m = (center_m - frame.center_m).dot(frame.normal());
    if (normal.dot(frame.normal()) > tilt_cosine && std::abs(above_m) < distance_m) return face;
  }
  throw Error(
      fmt::format("tag {} lies on no face of the box; a net can only hold tags that do", tag.id),
      ExitCode::invalid_file);
}

}  // namespace heft
