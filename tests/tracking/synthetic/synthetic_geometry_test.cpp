// The synthetic camera is the reference for other tests: its edges must be where
// Intrinsics::project says, to 0.01 px.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tracking/Scenes.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

SyntheticSettings ideal_sensor() {
  SyntheticSettings settings;
  settings.optics = {.blur_px = 0, .gamma = 1, .vignetting = 0, .noise = 0};
  settings.hand = false;
  return settings;
}

SyntheticCamera::EffectorPath held_at(const Pose& pose) {
  return [pose](double) { return std::optional<Pose>(pose); };
}

Pose level_at(const Vector3d& position_m) {
  return {position_m, Eigen::Quaterniond::Identity()};
}

int green(const Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y * image.width + x) * 3 + 1];
}

std::array<int, 3> bgr(const Image& image, int x, int y) {
  const std::uint8_t* pixel = &image.pixels[static_cast<std::size_t>(y * image.width + x) * 3];
  return {pixel[0], pixel[1], pixel[2]};
}

// Position at which an edge between two plateaus crosses a row (or a column), from the light on
// both sides.
double crossing_px(const Image& image, int along, int across, bool in_row, int reach) {
  const auto at = [&](int i) { return in_row ? green(image, i, across) : green(image, across, i); };
  const double before = at(along - reach), after = at(along + reach);
  double sum = 0;
  for (int i = along - reach; i <= along + reach; ++i) sum += (at(i) - after) / (before - after);
  return along - reach - 0.5 + sum;
}

// Largest distance of a tag's four rendered edges from where its corners project to; along an edge
// the mean counts, because bytes alone make single crossings uncertain by 0.012 px.
// @param reach pixels to both sides that are plain
double worst_edge_px(const Image& image, const Tag& tag, const Intrinsics& camera,
                     const Pose& camera_from_body, int reach) {
  double worst = 0;
  for (std::size_t side = 0; side < 4; ++side) {
    const Vector3d& from = tag.corners_m[side];
    const Vector3d step = tag.corners_m[(side + 1) % 4] - from;
    const auto pixel = [&](double s) {
      return project(camera, camera_from_body * Vector3d(from + s * step));
    };
    const std::array places{0.22, 0.29, 0.36, 0.43, 0.5, 0.57, 0.64, 0.71, 0.78};
    double sum = 0;
    for (const double s : places) {
      const Vector2d point = pixel(s), direction = pixel(s + 0.01) - pixel(s - 0.01);
      const bool in_row = std::abs(direction.y()) > std::abs(direction.x());
      const int a = in_row ? 0 : 1, b = 1 - a;
      const double across = std::round(point[b]);
      const double expected = point[a] + (across - point[b]) * direction[a] / direction[b];
      const double found = crossing_px(image, static_cast<int>(std::lround(expected)),
                                       static_cast<int>(across), in_row, reach);
      sum += found - expected;
    }
    worst = std::max(worst, std::abs(sum) / static_cast<double>(places.size()));
  }
  return worst;
}

TEST(SyntheticGeometry, BoardTagsAreWhereTheyProjectTo) {
  const Apparatus apparatus = default_apparatus(1280);
  const SyntheticSettings settings = ideal_sensor();
  SyntheticCamera camera(apparatus, settings, 1);
  const Image image = camera.picture(out_of_view, 0, 0);
  for (const Tag& tag : apparatus.board.tags)
    EXPECT_LT(worst_edge_px(image, tag, apparatus.camera, settings.camera_from_board, 4), 0.01)
        << "tag " << tag.id;
}

TEST(SyntheticGeometry, BlurOnLinearLightMovesNoEdge) {
  const Apparatus apparatus = default_apparatus(1280);
  SyntheticSettings settings = ideal_sensor();
  settings.optics.blur_px = 0.6;
  SyntheticCamera camera(apparatus, settings, 1);
  const Image image = camera.picture(out_of_view, 0, 0);
  for (const Tag& tag : apparatus.board.tags)
    EXPECT_LT(worst_edge_px(image, tag, apparatus.camera, settings.camera_from_board, 3), 0.01)
        << "tag " << tag.id;
}

// Pictures must have the effect that limits tracking accuracy: a black edge moves by .28 px with
// the project's usual optics.
TEST(SyntheticGeometry, BlurBehindAToneCurveShrinksBlackTags) {
  const Apparatus apparatus = default_apparatus(1280);
  SyntheticSettings settings = ideal_sensor();
  settings.optics.blur_px = 0.6;
  settings.optics.gamma.reset();
  SyntheticCamera camera(apparatus, settings, 1);
  const Image image = camera.picture(out_of_view, 0, 0);
  const double edge_px = worst_edge_px(image, apparatus.board.tags[20], apparatus.camera,
                                       settings.camera_from_board, 4);
  EXPECT_GT(edge_px, 0.15);
  EXPECT_LT(edge_px, 0.45);
}

TEST(SyntheticGeometry, EffectorTagsAreWhereTheyProjectTo) {
  const Apparatus apparatus = default_apparatus(1280);
  const SyntheticSettings settings = ideal_sensor();
  SyntheticCamera camera(apparatus, settings, 1);
  int n_checked = 0;
  RandomStream random(5, "poses");
  for (int k = 0; k < 24; ++k) {
    const Pose pose = random_held_pose(random);
    const Image image = camera.picture(held_at(pose), 0, 0);
    const Pose camera_from_effector{settings.camera_from_board * pose.position_m,
                                    settings.camera_from_board.orientation * pose.orientation};
    for (const Tag& tag : apparatus.effector.tags) {
      const Vector3d center = camera_from_effector * tag_center_m(tag);
      const Vector3d normal = camera_from_effector.orientation * tag_normal(tag);
      if (normal.dot(center.normalized()) > -0.6) continue;  // its cells get narrow
      ++n_checked;
      EXPECT_LT(worst_edge_px(image, tag, apparatus.camera, camera_from_effector, 3), 0.01)
          << "pose " << k << " tag " << tag.id;
    }
  }
  EXPECT_GE(n_checked, 10);
}

TEST(SyntheticGeometry, AMovingEffectorIsWhereItIsInTheMiddleOfTheExposure) {
  const Apparatus apparatus = default_apparatus(1280);
  SyntheticSettings settings = ideal_sensor();
  settings.optics.exposure_s = 0.004;
  SyntheticCamera camera(apparatus, settings, 1);
  const Vector3d start(0, 0, 0.04);
  const auto moving = [&](double t_s) {
    return std::optional<Pose>(level_at(start + Vector3d(0.3, 0.1, 0) * (t_s - 2)));
  };
  const Image image = camera.picture(moving, 2.0, 0);
  const Pose camera_from_effector{settings.camera_from_board * start,
                                  settings.camera_from_board.orientation};
  EXPECT_LT(
      worst_edge_px(image, apparatus.effector.tags[1], apparatus.camera, camera_from_effector, 5),
      0.02);
}

// A black edge that moves by d over the exposure becomes a ramp of length d: sd d / sqrt(12).
TEST(SyntheticGeometry, MotionSmearsAnEdgeAsFarAsItMoves) {
  const Apparatus apparatus = default_apparatus(1280);
  SyntheticSettings settings = ideal_sensor();
  settings.optics.exposure_s = 0.008;
  settings.camera_from_board = {{0, 0, 0.4},
                                Eigen::Quaterniond(0, 1, 0, 0)};  // straight down from 40 cm
  Apparatus pinhole = apparatus;
  pinhole.camera.distortion = {};
  SyntheticCamera camera(pinhole, settings, 1);
  const double speed_m_s = 0.2, top_z_m = 0.06;
  const Image image = camera.picture(
      [&](double t_s) {
        return std::optional<Pose>(level_at({speed_m_s * t_s, 0, top_z_m - 0.02}));
      },
      0, 0);
  const Tag& top = apparatus.effector.tags[1];
  const Vector3d middle = (top.corners_m[0] + top.corners_m[1]) / 2;  // its leading edge, up is x
  const double px_per_m = pinhole.camera.fx_px / (0.4 - top_z_m);
  const int x = static_cast<int>(std::lround(pinhole.camera.cx_px + px_per_m * middle.x()));
  const int y = static_cast<int>(std::lround(pinhole.camera.cy_px));
  double mass = 0, first = 0, second = 0;
  for (int i = x - 6; i < x + 6; ++i) {
    const double step = green(image, i + 1, y) - green(image, i, y), place = i + 0.5 - x;
    mass += step;
    first += step * place;
    second += step * place * place;
  }
  const double variance = second / mass - (first / mass) * (first / mass);
  const double smear_px = speed_m_s * settings.optics.exposure_s * px_per_m;
  const double pixel_variance = 2.0 / 12;  // a pixel is a box, and so is the step between two
  EXPECT_NEAR(std::sqrt(12 * (variance - pixel_variance)), smear_px, 0.03 * smear_px);
}

// For a tag's upper edge, which is nearly horizontal: the largest mean distance of its crossings
// from the line through the corners, over crossings at the same part of their pixel. Rays, or
// moments of the exposure, at the same places in every pixel would displace edges by that part; the
// camera integrates light over areas in closed form instead.
double worst_by_part_px(const Image& image, const Tag& tag, const Intrinsics& camera,
                        const Pose& camera_from_body, int reach) {
  constexpr std::size_t n_parts = 5;
  std::array<double, n_parts> sum{}, n{};
  const Vector2d one = project(camera, camera_from_body * tag.corners_m[0]);
  const Vector2d other = project(camera, camera_from_body * tag.corners_m[1]);
  const Vector2d from = one.x() < other.x() ? one : other, to = one.x() < other.x() ? other : one;
  for (int x = static_cast<int>(from.x()) + 2 * reach; x < to.x() - 2 * reach; ++x) {
    const double y = from.y() + (x - from.x()) * (to.y() - from.y()) / (to.x() - from.x());
    const auto part = static_cast<std::size_t>(n_parts * (y - std::floor(y)));
    sum[part] += crossing_px(image, static_cast<int>(std::lround(y)), x, false, reach) - y;
    ++n[part];
  }
  double worst = 0;
  for (std::size_t part = 0; part < n_parts; ++part) {
    EXPECT_GE(n[part], 6) << part;
    worst = std::max(worst, std::abs(sum[part] / n[part]));
  }
  return worst;
}

TEST(SyntheticGeometry, NoPartOfAPixelMovesAnEdgeAtRestOrSmeared) {
  SyntheticSettings settings = ideal_sensor();
  settings.optics.blur_px = 0.6;
  settings.camera_from_board = {{0, 0, 0.4},
                                Eigen::Quaterniond(0, 1, 0, 0)};  // straight down from 40 cm
  Apparatus pinhole = default_apparatus(1280);
  pinhole.camera.distortion = {};
  const Pose middle{{0, 0, 0.04},
                    Eigen::Quaterniond(Eigen::AngleAxisd(0.05 - M_PI / 2, Vector3d::UnitZ()))};
  const Pose camera_from_effector{settings.camera_from_board * middle.position_m,
                                  settings.camera_from_board.orientation * middle.orientation};
  for (const double speed_m_s : {0.0, 0.1, 0.35}) {
    SyntheticCamera camera(pinhole, settings, 1);
    const auto path = [&](double t_s) {
      return std::optional<Pose>(
          {middle.position_m + t_s * speed_m_s * Vector3d::UnitY(), middle.orientation});
    };
    EXPECT_LT(worst_by_part_px(camera.picture(path, 0, 0), pinhole.effector.tags[1], pinhole.camera,
                               camera_from_effector, 6),
              0.008)
        << speed_m_s;
  }
}

TEST(SyntheticGeometry, NothingChangesButWhereEffectorAndHandAre) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera(apparatus, {}, 1);
  const Image without = camera.picture(out_of_view, 0, 7);
  const Image with = camera.picture(held_at(level_at({-0.1, 0, 0.04})), 0, 7);  // hand to the left
  int n_left = 0, n_right = 0;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      if (green(with, x, y) != green(without, x, y)) ++(x < 400 ? n_left : n_right);
  EXPECT_GT(n_left, 10000);
  EXPECT_EQ(n_right, 0);
  EXPECT_EQ(camera.picture(out_of_view, 0, 7).pixels, without.pixels);  // nothing is left behind
}

TEST(SyntheticGeometry, OutOfThePictureOrAtTheCameraThereIsOnlyTheBoard) {
  SyntheticCamera camera(default_apparatus(640), {}, 1);
  const Image without = camera.picture(out_of_view, 0, 0);
  const Vector3d eye = SyntheticSettings().camera_from_board.orientation.conjugate() *
                       -SyntheticSettings().camera_from_board.position_m;
  for (const Vector3d& place : {Vector3d(3, 0, 0.05), eye, Vector3d(2 * eye)})
    EXPECT_EQ(camera.picture(held_at(level_at(place)), 0, 0).pixels, without.pixels);
}

TEST(SyntheticGeometry, TheTableHidesWhatIsBelowIt) {
  const Apparatus apparatus = default_apparatus(640);
  const SyntheticSettings settings = ideal_sensor();
  SyntheticCamera camera(apparatus, settings, 1);
  const Image without = camera.picture(out_of_view, 0, 0);
  EXPECT_EQ(camera.picture(held_at(level_at({0, 0, -0.021})), 0, 0).pixels, without.pixels);
  // Half sunk: a point in the near face below the table shows the table.
  const Image sunk = camera.picture(held_at(level_at({0, 0, 0})), 0, 0);
  const auto differs_at = [&](const Vector3d& point_m) {
    const Vector2d p = project(apparatus.camera, settings.camera_from_board * point_m);
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    return bgr(sunk, x, y) != bgr(without, x, y);
  };
  EXPECT_TRUE(differs_at({-0.02, -0.02, 0.006}));
  EXPECT_FALSE(differs_at({-0.02, -0.02, -0.012}));
}

TEST(SyntheticGeometry, TheHandHidesTheBackAndNotTheTagsAtTheTip) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings settings = ideal_sensor();
  SyntheticCamera bare(apparatus, settings, 1);
  settings.hand = true;
  SyntheticCamera held(apparatus, settings, 1);
  const Pose pose{{0, -0.02, 0.05}, Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d::UnitZ()))};
  const Image without = bare.picture(held_at(pose), 0, 0), with = held.picture(held_at(pose), 0, 0);
  const auto differ_at = [&](const Vector3d& in_effector_m) {
    const Vector2d p =
        project(apparatus.camera, settings.camera_from_board * (pose * in_effector_m));
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    return green(with, x, y) != green(without, x, y);
  };
  for (const double x_m : {0.015, 0.025, 0.040})
    for (const double y_m : {-0.018, 0.0, 0.018})
      EXPECT_FALSE(differ_at({x_m, y_m, 0.02})) << x_m << " " << y_m;  // the top, at the tip
  EXPECT_TRUE(differ_at({-0.075, 0, 0}));                              // palm behind the back
  EXPECT_TRUE(differ_at({-0.030, 0.008, 0.02}));                       // thumb
}

// At all places where people push: from the resting place to behind the cubes, turned to both
// sides.
TEST(SyntheticGeometry, TheArmComesFromBeyondThePicture) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings settings = ideal_sensor();
  settings.hand = true;
  SyntheticCamera camera(apparatus, settings, 1);
  for (const double y_m : {-0.12, -0.05, 0.05})
    for (const double x_m : {-0.1, 0.0, 0.1})
      for (const double yaw : {-0.4, 0.0, 0.4}) {
        const Pose pose{{x_m, y_m, 0.03},
                        Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2 + yaw, Vector3d::UnitZ()))};
        const Image hand = camera.hand_in_picture(pose);
        int n_at_edge = 0;
        for (int x = 0; x < hand.width; ++x)
          n_at_edge +=
              hand.pixels[static_cast<std::size_t>((hand.height - 1) * hand.width + x)] > 0;
        for (int y = 0; y < hand.height; ++y)
          for (const int x : {0, hand.width - 1})
            n_at_edge += hand.pixels[static_cast<std::size_t>(y * hand.width + x)] > 0;
        EXPECT_GT(n_at_edge, 30) << x_m << ' ' << y_m << ' ' << yaw;
      }
}

TEST(SyntheticGeometry, TheHandInThePictureIsWhatDiffersFromNoHandAndMirrorsForTheLeft) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings settings = ideal_sensor();
  SyntheticCamera bare(apparatus, settings, 1);
  settings.hand = true;
  SyntheticCamera right(apparatus, settings, 1);
  settings.left_hand = true;
  SyntheticCamera left(apparatus, settings, 1);
  const Pose pose{{0, -0.02, 0.05},
                  Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()))};
  const auto column = [&](SyntheticCamera& camera) {
    const Image without = bare.picture(held_at(pose), 0, 0);
    const Image with = camera.picture(held_at(pose), 0, 0);
    const Image hand = camera.hand_in_picture(pose);
    double sum = 0, n = 0;
    for (int y = 0; y < hand.height; ++y)
      for (int x = 0; x < hand.width; ++x) {
        const auto covered = hand.pixels[static_cast<std::size_t>(y * hand.width + x)];
        if (covered == 0) {
          EXPECT_EQ(bgr(with, x, y), bgr(without, x, y)) << x << ' ' << y;
        }
        if (covered == 255 && y < 300) sum += x, ++n;
      }
    EXPECT_GT(n, 1000);
    return sum / n;
  };
  EXPECT_NEAR(column(left) + column(right), apparatus.camera.width_px - 1, 3) << "mirrored";
  EXPECT_GT(std::abs(column(left) - column(right)), 4);
}

}  // namespace
}  // namespace heft
