// Scenes to draw, and functions that examine the drawn pixels.
#pragma once

#include <array>
#include <cmath>
#include <memory>

#include "base/PoseTypes.h"
#include "view/scene/SceneDrawing.h"

namespace heft::test {

/// A lens with a distortion of tens of pixels in the corners.
inline Intrinsics strong_lens() {
  Intrinsics camera;
  camera.distortion = {-0.28, 0.09, 0.002, -0.0015, 0, 0, 0, 0};
  return camera;
}

/// From the participant's side: 45 cm away, looking down at the board's center by an angle.
inline Pose camera_looking_down(double angle_rad, double distance_m = 0.45) {
  const Eigen::AngleAxisd turn(M_PI / 2 + angle_rad, Eigen::Vector3d::UnitX());
  return {{0, 0, distance_m}, Eigen::Quaterniond(turn)};
}

/// The effector lying on the table, its tip away from the participant.
inline Pose pointing_away(double x_m, double y_m, double z_m = 0.02) {
  return upright_pose({x_m, y_m, z_m}, M_PI / 2);
}

inline std::shared_ptr<Image> gray_picture(const Intrinsics& camera, int channels = 3,
                                           std::uint8_t value = 200) {
  auto picture = std::make_shared<Image>(camera.width_px, camera.height_px, channels);
  std::fill(picture->pixels.begin(), picture->pixels.end(), value);
  return picture;
}

inline ViewSetup setup_with(const std::optional<Intrinsics>& camera) {
  ViewSetup setup;
  setup.camera = camera;
  setup.stage.slots_m = {{-0.06, 0.02, 0.0175}, {0, 0.02, 0.0175}, {0.06, 0.02, 0.0175}};
  return setup;
}

/// Three cubes on their slots over a gray picture.
inline ViewFrame three_cubes(const ViewSetup& setup) {
  ViewFrame shown;
  for (const auto& slot_m : setup.stage.slots_m)
    shown.frame.cubes.push_back(upright_pose(slot_m, 0));
  if (setup.camera) shown.camera = gray_picture(*setup.camera);
  return shown;
}

struct Bgr {
  int blue, green, red;
  bool operator==(const Bgr&) const = default;
};

inline Bgr at(const Image& image, int x, int y) {
  const auto i = static_cast<std::size_t>(3 * (y * image.width + x));
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

inline Bgr at(const Image& image, const Eigen::Vector2d& pixel) {
  return at(image, static_cast<int>(std::lround(pixel.x())),
            static_cast<int>(std::lround(pixel.y())));
}

}  // namespace heft::test
