// The projection against OpenCV's own, and a camera's file.
#include "tracking/camera/Intrinsics.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "base/Error.h"
#include "base/Random.h"

namespace heft {
namespace {

using testing::HasSubstr;

const Intrinsics mild{640, 480, 540, 542, 318, 241, {.06, -.15, .001, -.0008}};
const Intrinsics rational{
    1280, 720, 900, 905, 650, 350, {.3, -.1, .002, .001, .02, .25, -.06, .01}};
const Intrinsics barrel{640, 480, 400, 400, 320, 240, {-.3, .1, 0, 0, -.01}};

cv::Mat matrix_of(const Intrinsics& c) {
  return (cv::Mat_<double>(3, 3) << c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1);
}

std::vector<double> distortion_of(const Intrinsics& c) {
  return {c.distortion.begin(), c.distortion.end()};
}

TEST(Intrinsics, ProjectsAsOpenCvDoes) {
  RandomStream random(1, "points");
  for (const Intrinsics& camera : {mild, rational, barrel}) {
    std::vector<cv::Point3d> points;
    for (int i = 0; i < 200; ++i) {
      const double z = .3 + random.uniform();
      points.emplace_back((random.uniform() - .5) * z, (random.uniform() - .5) * z, z);
    }
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix_of(camera), distortion_of(camera),
                      expected);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto pixel = project(camera, {points[i].x, points[i].y, points[i].z});
      EXPECT_NEAR(pixel.x(), expected[i].x, 1e-9);
      EXPECT_NEAR(pixel.y(), expected[i].y, 1e-9);
    }
  }
}

TEST(Intrinsics, UndistortsAsOpenCvDoes) {
  const cv::TermCriteria exact(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-14);
  std::vector<cv::Point2d> pixels, rays;
  for (int y = 0; y < 480; y += 60)
    for (int x = 0; x < 640; x += 60) pixels.emplace_back(x, y);
  cv::undistortPoints(pixels, rays, matrix_of(mild), distortion_of(mild), cv::noArray(),
                      cv::noArray(), exact);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto ray = undistort(mild, {pixels[i].x, pixels[i].y});
    EXPECT_NEAR(ray.x(), rays[i].x, 1e-9);
    EXPECT_NEAR(ray.y(), rays[i].y, 1e-9);
  }
}

TEST(Intrinsics, UndistortIsTheInverseOfDistortInThePicture) {
  for (const Intrinsics& camera : {mild, rational, barrel})
    for (int y = 0; y <= camera.height_px; y += 40)
      for (int x = 0; x <= camera.width_px; x += 40) {
        const Eigen::Vector2d pixel(x, y);
        EXPECT_LT((distort(camera, undistort(camera, pixel)) - pixel).norm(), 1e-9 * 1000);
      }
}

TEST(Intrinsics, DerivativeIsThatOfDistort) {
  constexpr double step = 1e-6;
  for (const Intrinsics& camera : {mild, rational, barrel}) {
    const Eigen::Vector2d ray(.31, -.22);
    const auto there = distort_with_derivative(camera, ray);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d d = step * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d slope =
          (distort(camera, ray + d) - distort(camera, ray - d)) / (2 * step);
      EXPECT_LT((slope - there.pixel_by_ray.col(axis)).norm(), 1e-5);
    }
  }
}

void expect_same(const Intrinsics& a, const Intrinsics& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_EQ(a.fx_px, b.fx_px);
  EXPECT_EQ(a.fy_px, b.fy_px);
  EXPECT_EQ(a.cx_px, b.cx_px);
  EXPECT_EQ(a.cy_px, b.cy_px);
  EXPECT_EQ(a.distortion, b.distortion);
}

TEST(IntrinsicsFile, WhatIsWrittenIsReadBack) {
  for (const Intrinsics& camera : {mild, rational, barrel})
    expect_same(parse_intrinsics(to_yaml(camera, "made by a test\nin two lines"), "c.yaml"),
                camera);
}

TEST(IntrinsicsFile, OpenCvReadsWhatIsWritten) {
  cv::FileStorage file(to_yaml(rational, ""), cv::FileStorage::READ | cv::FileStorage::MEMORY);
  cv::Mat matrix, distortion;
  file["camera_matrix"] >> matrix;
  file["distortion_coefficients"] >> distortion;
  EXPECT_EQ(matrix.at<double>(1, 1), rational.fy_px);
  EXPECT_EQ(distortion.total(), 8U);
}

// Three keys that OpenCV ignores and files of other programs lack.
TEST(IntrinsicsFile, KeepsWhatTheCameraWasSetTo) {
  Intrinsics camera = mild;
  camera.calibrated_at = {0.0001, 35};
  camera.readout_s = 0.0225;
  const std::string yaml = to_yaml(camera, "");
  const Intrinsics read = parse_intrinsics(yaml, "c.yaml");
  expect_same(read, camera);
  EXPECT_EQ(read.calibrated_at.exposure_s, 0.0001);
  EXPECT_EQ(read.calibrated_at.focus, 35);
  EXPECT_EQ(read.readout_s, 0.0225);
  cv::FileStorage file(yaml, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  cv::Mat matrix;
  file["camera_matrix"] >> matrix;
  EXPECT_EQ(matrix.at<double>(1, 1), mild.fy_px);

  const Intrinsics without = parse_intrinsics(to_yaml(mild, ""), "c.yaml");
  EXPECT_FALSE(without.calibrated_at.exposure_s);
  EXPECT_FALSE(without.calibrated_at.focus);
  EXPECT_EQ(without.readout_s, 0);
}

TEST(IntrinsicsFile, ReadsWhatOpenCvWrites) {
  for (int n : {4, 5, 8}) {
    for (bool column : {false, true}) {
      cv::FileStorage file("c.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
      Intrinsics camera = rational;
      std::fill(camera.distortion.begin() + n, camera.distortion.end(), 0);
      cv::Mat distortion(distortion_of(camera), true);
      distortion = distortion.rowRange(0, n).clone();
      file << "image_width" << camera.width_px << "image_height" << camera.height_px
           << "camera_matrix" << matrix_of(camera) << "distortion_coefficients"
           << (column ? distortion : cv::Mat(distortion.t()));
      expect_same(parse_intrinsics(file.releaseAndGetString(), "c.yaml"), camera);
    }
  }
}

TEST(IntrinsicsFile, WorksWithoutOpenCvsFirstLine) {
  const std::string yaml = to_yaml(mild, "");
  expect_same(parse_intrinsics(yaml.substr(yaml.find("image_width")), "c.yaml"), mild);
}

std::string refusal(const std::string& text) {
  try {
    parse_intrinsics(text, "c.yaml");
  } catch (const InvalidFile& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what() << " was thrown for\n" << text;
  }
  return "accepted";
}

std::string edited(const std::string& from, const std::string& to) {
  std::string yaml = to_yaml(mild, "");
  return yaml.replace(yaml.find(from), from.size(), to);
}

TEST(IntrinsicsFile, RefusesWhatCanNotBe) {
  EXPECT_THAT(refusal(edited("image_width: 640", "image_width: 0")),
              HasSubstr("c.yaml:3:1: image_width is 0, expected a whole number"));
  EXPECT_THAT(refusal(edited("image_width: 640\n", "")), HasSubstr("image_width is missing"));
  EXPECT_THAT(refusal(edited("540", "-540")), HasSubstr("focal lengths -540 and 542"));
  EXPECT_THAT(refusal(edited("540", "1e308")), HasSubstr("expected 32 to 32000 pixels"));
  EXPECT_THAT(refusal(edited("318", "-1e9")), HasSubstr("center at -1000000000, 241"));
  EXPECT_THAT(refusal(edited("0.06", "1e300")), HasSubstr("expected 1000 at most"));
  EXPECT_THAT(refusal(edited("0.06", "-900")), HasSubstr("fold the middle of the picture"));
  EXPECT_THAT(refusal(edited("rows: 3", "rows: 1000000000")), HasSubstr("1000000000 rows"));
  EXPECT_THAT(refusal(edited("cols: 5", "cols: -1")), HasSubstr("-1 cols"));
  EXPECT_THAT(refusal(edited("dt: d", "dt: \"999999999d\"")), HasSubstr("expected d or f"));
  EXPECT_THAT(refusal(edited("542, 241", "542")), HasSubstr("camera_matrix has 8 numbers"));
  EXPECT_THAT(refusal(edited("540, 0,", "540, 3,")), HasSubstr("skew"));
  EXPECT_THAT(refusal(edited("0.06, ", "")), HasSubstr("5 cols, but has 4 numbers"));
  EXPECT_THAT(refusal(edited("540", ".Nan")), HasSubstr("camera_matrix is unusable"));
  EXPECT_THAT(refusal(to_yaml(mild, "") + "exposure_s: 4\n"),
              HasSubstr("c.yaml:15:1: exposure_s is 4, expected the exposure time in seconds"));
  EXPECT_THAT(refusal(to_yaml(mild, "") + "focus: near\n"), HasSubstr("focus is unusable"));
  EXPECT_THAT(refusal(to_yaml(mild, "") + "readout_s: 25\n"),
              HasSubstr("c.yaml:15:1: readout_s is 25, expected the seconds from the first row"));
}

TEST(IntrinsicsFile, NamesTheLineOfABrokenOne) {
  const std::string broken = edited("image_height:", "image_height");
  EXPECT_THAT(refusal(broken), HasSubstr("c.yaml:5:14: the file is not valid YAML"));
  EXPECT_THAT(refusal(broken.substr(broken.find("image_width"))), HasSubstr("c.yaml:3:14: "));
  EXPECT_THAT(refusal("hello"), HasSubstr("c.yaml:1:1: the file has no keys"));
  EXPECT_THAT(refusal("\x89PNG"), HasSubstr("heft calibrate camera"));
}

TEST(IntrinsicsFile, SaysHowAMissingOneIsMade) {
  try {
    load_intrinsics("no/such/camera.yaml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/camera.yaml"));
    EXPECT_THAT(error.what(), HasSubstr("heft calibrate camera"));
  }
}

TEST(IntrinsicsFile, RefusesGarbage) {
  RandomStream random(2, "garbage");
  for (const std::string text : {"", "\n", "{", "[1, 2", "%YAML:1.0\n---\n", "a: [b: {", "<xml>",
                                 "\xff\xfe", "%YAML 9\nx", "hello", "a: b\n c\n\td: e"})
    EXPECT_NE(refusal(text), "accepted") << text;
  for (int i = 0; i < 300; ++i) {
    std::string yaml = to_yaml(mild, "");
    for (int k = 0; k < 4; ++k)
      yaml[random.below(yaml.size())] = static_cast<char>(random.below(256));
    refusal(yaml);  // whatever it says, it neither crashes nor throws anything else
  }
}

TEST(IntrinsicsFile, RefusesFilesThatHarmReaders) {
  const std::string yaml = to_yaml(mild, "");
  const auto with = [&](const std::string& line) { return refusal(yaml + line + "\n"); };
  EXPECT_THAT(refusal("<?xml version=\"1.0\"?><opencv_storage/>"), HasSubstr("c.yaml:1:1: "));
  EXPECT_THAT(refusal("{\"image_width\": 640}"), HasSubstr("image_height is missing"));
  EXPECT_THAT(with("image_width: 3"), HasSubstr("c.yaml:15:1: the file has this key twice"));
  EXPECT_THAT(with("x: " + std::string(100'000, '[')), HasSubstr("the file is not valid YAML"));
  EXPECT_THAT(with("a: b: c: d: e: f: g"), HasSubstr("c.yaml:15:5: the file is not valid YAML"));
  EXPECT_THAT(with("im--"), HasSubstr("c.yaml:15:1: the file has no value here"));
  EXPECT_THAT(with("x: [ 1, 2"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal(yaml + "x: 'a"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal(yaml + "# " + std::string(5'000'000, '.')), HasSubstr("bytes"));
  // Neither is read, so neither has an effect.
  expect_same(parse_intrinsics(yaml + "x: !!binary |\n", "c.yaml"), mild);
  expect_same(parse_intrinsics(yaml + "x: &a [ *a ]\n", "c.yaml"), mild);
}

TEST(IntrinsicsFile, StillReadsWhatOtherProgramsWrite) {
  // OpenCV's own calibration sample adds these; a comment may say anything.
  const std::string more =
      "calibration_time: \"Sat Nov 21 23:05:31 2026\"\n# flags: <none> & *more* {}!\nflags: 0\n"
      "per_view: !!opencv-matrix\n   rows: 2\n   cols: 1\n   dt: f\n"
      "   data: [ 1.e-01,\n       2.5e+00 ]\nnames:\n   - \"a.png\"\n   - \"b.png\"\n";
  expect_same(parse_intrinsics(to_yaml(mild, "caf\xc3\xa9") + more, "c.yaml"), mild);
  // ROS's: lists by dashes or in brackets, and no first line.
  expect_same(parse_intrinsics("image_width: 640\nimage_height: 480\ncamera_name: left\n"
                               "camera_matrix:\n  rows: 3\n  cols: 3\n"
                               "  data: [540, 0, 318, 0, 542, 241, 0, 0, 1]\n"
                               "distortion_model: plumb_bob\ndistortion_coefficients:\n"
                               "  data: [.06, -.15, .001, -.0008]\n",
                               "c.yaml"),
              mild);
}

// The seed of a failure is printed; HEFT_FUZZ_SEED sets another.
TEST(IntrinsicsFile, MutatedFilesAreReadOrRefused) {
  const char* given = std::getenv("HEFT_FUZZ_SEED");
  const std::uint64_t seed = given ? std::stoull(given) : 20261121;
  RandomStream random(seed, "mutations");
  const std::array<std::string, 20> pieces{"!!binary",
                                           "<?xml version=\"1.0\"?>",
                                           "&a ",
                                           "*a",
                                           "[",
                                           "]",
                                           "{",
                                           "}",
                                           "- ",
                                           ": ",
                                           "!!opencv-matrix",
                                           "%YAML:1.0\n",
                                           "---\n",
                                           "\"",
                                           "'",
                                           "\n",
                                           "\n   ",
                                           "1e308",
                                           "|",
                                           "...\n"};
  const std::string yaml = to_yaml(rational, "a comment");
  int n_accepted = 0;
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE(fmt::format("seed {}, file {}", seed, i));
    std::string text = yaml;
    for (auto n = random.below(4) + 1; n > 0; --n) {
      const auto at = random.below(text.size());
      switch (random.below(4)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.insert(at, pieces[random.below(pieces.size())]);
          break;
        case 2:
          text.erase(at, random.below(20));
          break;
        default:
          text.insert(at, text.substr(random.below(text.size()), random.below(60)));
      }
      if (text.empty()) text.push_back(' ');
    }
    n_accepted += refusal(text) == "accepted" ? 1 : 0;
  }
  EXPECT_GT(n_accepted, 200) << "hardly any was accepted";
}

}  // namespace
}  // namespace heft
