// Compares a drawn cube's outline with OpenCV's projection of its edges through the lens.
#include <gmock/gmock.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "base/PoseTypes.h"
#include "view/Scenes.h"

namespace heft {
namespace {

using Eigen::Vector3d;
using namespace heft::test;

constexpr double tolerance_px = 0.6;

// OpenCV's projection of points of the board frame.
std::vector<cv::Point2f> projected(const Intrinsics& camera, const Pose& camera_from_board,
                                   const std::vector<Vector3d>& points_m) {
  std::vector<cv::Point3d> in_camera;
  for (const Vector3d& point_m : points_m) {
    const Vector3d p = camera_from_board * point_m;
    in_camera.emplace_back(p.x(), p.y(), p.z());
  }
  const cv::Matx33d matrix(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const std::vector<double> lens(camera.distortion.begin(), camera.distortion.end());
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(in_camera, cv::Vec3d(), cv::Vec3d(), matrix, lens, pixels);
  return {pixels.begin(), pixels.end()};
}

// The outlines of a cube's faces, forty points per side.
std::vector<std::vector<Vector3d>> face_outlines(const Pose& cube, double size_m) {
  std::vector<std::vector<Vector3d>> outlines;
  const std::array<std::pair<double, double>, 4> turn{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (int face = 0; face < 6; ++face) {
    const int k = face / 2;
    const auto corner = [&](std::size_t i) {
      Vector3d unit;
      unit[k] = face % 2 ? 1 : -1;
      unit[(k + 1) % 3] = turn[i % 4].first;
      unit[(k + 2) % 3] = turn[i % 4].second;
      return Vector3d(cube * Vector3d(unit * size_m / 2));
    };
    auto& outline = outlines.emplace_back();
    for (std::size_t i = 0; i < 4; ++i)
      for (int step = 0; step < 40; ++step)
        outline.push_back(corner(i) + step / 40.0 * (corner(i + 1) - corner(i)));
  }
  return outlines;
}

// Depth of a pixel inside the cube's projection, which is the union of its faces' projections;
// negative: outside.
class Silhouette {
 public:
  Silhouette(const Intrinsics& camera, const Pose& camera_from_board, const Pose& cube,
             double size_m) {
    for (const auto& outline : face_outlines(cube, size_m)) {
      faces_.push_back(projected(camera, camera_from_board, outline));
      const cv::Rect face = cv::boundingRect(faces_.back());
      bounds_ |= {face.x - 10, face.y - 10, face.width + 20, face.height + 20};
    }
  }
  double depth_px(int x, int y) const {
    if (!bounds_.contains({x, y})) return -10;
    double depth = -1e9;
    for (const auto& face : faces_)
      depth = std::max(depth, cv::pointPolygonTest(face, cv::Point2f(float(x), float(y)), true));
    return depth;
  }

 private:
  std::vector<std::vector<cv::Point2f>> faces_;
  cv::Rect bounds_;  // with a margin of ten pixels
};

struct View {
  const char* name;
  Intrinsics camera;
  Pose camera_from_board;
};

std::vector<View> several_views() {
  Intrinsics gentle, rational, wide;
  gentle.distortion = {0.06, -0.15};
  rational.distortion = {0.4, -0.2, -0.001, 0.001, 0.05, 0.6, -0.15, 0.02};
  wide.width_px = 1280;
  wide.height_px = 720;
  wide.fx_px = 1010;
  wide.fy_px = 1000;
  wide.cx_px = 650;
  wide.cy_px = 340;
  wide.distortion = {-0.25, 0.08, 0, 0, 0, 0, 0, 0};
  const Pose above = camera_looking_down(0.9), near = camera_looking_down(0.7, 0.22);
  return {{"no distortion", Intrinsics{}, above}, {"gentle", gentle, above},
          {"strong", strong_lens(), above},       {"strong, near", strong_lens(), near},
          {"rational", rational, near},           {"1280 x 720", wide, above}};
}

// Picture and shadows are gray, so that every colored pixel belongs to the cube.
int color_at(const Image& drawn, int x, int y) {
  const Bgr bgr = at(drawn, x, y);
  return bgr.red - bgr.blue;
}

void expect_cube_where_projected(const View& view, const Pose& cube, double size_m = 0.035) {
  ViewSetup setup = setup_with(view.camera);
  setup.stage.cube_size_m = size_m;
  SceneDrawing drawing(setup);
  ViewFrame shown;
  shown.camera = gray_picture(view.camera);
  shown.camera_from_board = view.camera_from_board;
  shown.frame.cubes = {cube};
  const Image& drawn = drawing.draw(shown);
  const Silhouette silhouette(view.camera, view.camera_from_board, cube, size_m);
  int n_inside = 0;
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      const double depth_px = silhouette.depth_px(x, y);
      n_inside += depth_px > tolerance_px;
      const int color = color_at(drawn, x, y);
      const bool as_it_must = depth_px > tolerance_px    ? color > 60
                              : depth_px < -tolerance_px ? color == 0
                                                         : true;
      ASSERT_TRUE(as_it_must) << view.name << ", pixel " << x << " " << y << ", " << depth_px
                              << " px inside, color " << color;
    }
  }
  EXPECT_GT(n_inside, 300) << view.name;
}

TEST(Projection, OutlineOfCubeAgreesWithOpenCv) {
  for (const View& view : several_views()) {
    expect_cube_where_projected(view, upright_pose({0.01, 0.02, 0.0175}, 0.4));
    expect_cube_where_projected(view, upright_pose({-0.07, 0.05, 0.0175}, 0));
  }
}

// Clipped by the border, where lens distortion is largest.
TEST(Projection, OutlineOfCubeAtBorderAgreesWithOpenCv) {
  const View view{"border", strong_lens(), camera_looking_down(0.9)};
  expect_cube_where_projected(view, upright_pose({0.255, 0.02, 0.0175}, 0.3));
  expect_cube_where_projected(view, upright_pose({0.21, -0.14, 0.0175}, 0.3));
}

// Straight edges would be wrong by pixels.
TEST(Projection, EdgesOfLargeBodyFollowLensDistortion) {
  const View view{"large", strong_lens(), camera_looking_down(0.9)};
  expect_cube_where_projected(view, upright_pose({0, 0, 0.06}, 0.1), 0.12);
}

// A distortion polynomial is not monotonic far outside the picture and would fold points back.
TEST(Projection, PointsOutsideTheViewAreNotFoldedBack) {
  Intrinsics folding;
  folding.distortion = {0.06, -0.15};
  const Pose straight_down = camera_looking_down(M_PI / 2, 0.3);
  ViewFrame shown;
  shown.camera = gray_picture(folding);
  shown.camera_from_board = straight_down;
  for (const auto& [x_m, y_m] : {std::pair{0.46, 0.0}, {-0.46, 0.0}, {0.0, 0.46}, {0.0, -0.46}}) {
    const Eigen::Vector3d center_m(x_m, y_m, 0.0175);
    const Eigen::Vector2d folded = project(folding, straight_down * center_m);
    ASSERT_GT(folded.minCoeff(), 0) << "no fold to test";
    ASSERT_LT(folded.y(), folding.height_px) << "no fold to test";
    SceneDrawing drawing(setup_with(folding));
    shown.frame.cubes = {upright_pose(center_m, 0)};
    EXPECT_EQ(drawing.draw(shown).pixels, shown.camera->pixels) << x_m << " " << y_m;
    EXPECT_EQ(drawing.label_place(1), std::nullopt);
  }
}

}  // namespace
}  // namespace heft
