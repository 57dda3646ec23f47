// A camera's file, in the format of OpenCV's calibration programs.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "base/Error.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "tracking/camera/Intrinsics.h"

namespace heft {

namespace {
constexpr std::size_t largest_file_bytes = 4'000'000;
constexpr int largest_side_px = 20000;
// Relative to the picture's longer side: from a fisheye of 150 degrees to a telephoto lens of 1.
constexpr double shortest_focal = 0.05, longest_focal = 50;
constexpr double strongest_distortion = 1000;

// Whether pixels in the middle half of the picture have rays. Towards corners even good fits fold.
bool can_be_looked_back(const Intrinsics& camera) {
  for (const double x : {.25, .5, .75})
    for (const double y : {.25, .5, .75}) {
      const Eigen::Vector2d pixel(x * camera.width_px, y * camera.height_px);
      if (!((distort(camera, undistort(camera, pixel)) - pixel).norm() < 1)) return false;
    }
  return true;
}

class Reader {
 public:
  Reader(const std::string& text, const std::string& file) : file_(file) {
    if (text.size() > largest_file_bytes)
      refuse({}, fmt::format("has more than {} bytes", largest_file_bytes));
    try {
      take(YAML::Load(text));
    } catch (const YAML::Exception& error) {
      refuse(error.mark, "is not valid YAML: " + error.msg);
    }
    if (values_.empty()) refuse({}, "has no keys");
  }

  int side(const char* key) {
    const std::vector<double> value = numbers(key, "a number of pixels");
    if (value.empty()) return 1;
    if (value.size() != 1 || !(value[0] >= 1 && value[0] <= largest_side_px) ||
        value[0] != std::floor(value[0])) {
      mistake(fmt::format("{} is {}, expected a whole number of pixels from 1 to {}", key,
                          fmt::join(value, ", "), largest_side_px));
      return 1;
    }
    return static_cast<int>(value[0]);
  }

  void matrix(Intrinsics& camera) {
    const std::vector<double> m = numbers("camera_matrix", "9 numbers");
    if (m.empty()) return;
    if (m.size() != 9)
      return mistake(fmt::format("camera_matrix has {} numbers, expected 3 x 3", m.size()));
    const double side = std::max(camera.width_px, camera.height_px);
    const double least = shortest_focal * side, most = longest_focal * side;
    if (!(std::min(m[0], m[4]) >= least && std::max(m[0], m[4]) <= most))
      mistake(fmt::format("camera_matrix has focal lengths {} and {}, expected {} to {} pixels",
                          m[0], m[4], least, most));
    if (!(std::abs(m[2]) <= most && std::abs(m[5]) <= most))
      mistake(fmt::format("camera_matrix has its center at {}, {}, expected within {} pixels", m[2],
                          m[5], most));
    if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
      mistake("camera_matrix is not [fx, 0, cx, 0, fy, cy, 0, 0, 1]; skew is not supported");
    camera.fx_px = m[0];
    camera.fy_px = m[4];
    camera.cx_px = m[2];
    camera.cy_px = m[5];
  }

  void distortion(Intrinsics& camera) {
    const std::vector<double> d = numbers("distortion_coefficients", "4, 5 or 8 numbers");
    if (d.empty()) return;
    if (d.size() != 4 && d.size() != 5 && d.size() != 8)
      return mistake(fmt::format(
          "distortion_coefficients has {} numbers, expected 4, 5 or 8 (k1 k2 p1 p2 k3 k4 k5 k6); "
          "calibrate with OpenCV's standard or rational model",
          d.size()));
    if (std::ranges::any_of(d, [](double k) { return !(std::abs(k) <= strongest_distortion); }))
      return mistake(fmt::format("distortion_coefficients has {}, expected {:g} at most",
                                 fmt::join(d, ", "), strongest_distortion));
    std::ranges::copy(d, camera.distortion.begin());
    if (!can_be_looked_back(camera))
      mistake(
          "distortion_coefficients fold the middle of the picture: some of its pixels have no "
          "direction; "
          "calibrate again");
  }

  // An optional number.
  std::optional<double> extra(const char* key, double least, double most, const char* expected) {
    if (!values_.contains(key)) return std::nullopt;
    const std::vector<double> value = numbers(key, expected);
    if (value.size() == 1 && value[0] >= least && value[0] <= most) return value[0];
    if (!value.empty())
      mistake(fmt::format("{} is {}, expected {}", key, fmt::join(value, ", "), expected));
    return std::nullopt;
  }

  // The tone curve, if the file has one.
  std::optional<std::array<double, 3>> response() {
    constexpr const char* expected = "3 numbers from -2 to 2, as heft calibrate camera writes them";
    if (!values_.contains("response")) return std::nullopt;
    const std::vector<double> bend = numbers("response", expected);
    if (bend.size() == 3 && std::ranges::all_of(bend, [](double b) { return std::abs(b) <= 2; }))
      return std::array{bend[0], bend[1], bend[2]};
    if (!bend.empty())
      mistake(fmt::format("response is {}, expected {}", fmt::join(bend, ", "), expected));
    return std::nullopt;
  }

  // The message begins with the key.
  void mistake(std::string message) {
    const auto found = values_.find(message.substr(0, message.find(' ')));
    mistakes_.push_back({found == values_.end() ? SourcePlace{file_} : place_of(found->second.mark),
                         std::move(message)});
  }

  void finish() {
    if (!mistakes_.empty()) throw InvalidFile(std::move(mistakes_));
  }

 private:
  struct Value {
    YAML::Mark mark;  ///< of the key
    YAML::Node node;
  };

  void take(const YAML::Node& file) {
    if (!file.IsMap() && !file.IsNull()) refuse(file.Mark(), "has no keys");
    for (const auto& entry : file) {
      if (entry.second.IsNull()) refuse(entry.first.Mark(), "has no value here");
      if (!values_.emplace(entry.first.Scalar(), Value{entry.first.Mark(), entry.second}).second)
        refuse(entry.first.Mark(), "has this key twice");
    }
  }

  SourcePlace place_of(const YAML::Mark& mark) const {
    return mark.is_null() ? SourcePlace{file_} : SourcePlace{file_, mark.line + 1, mark.column + 1};
  }

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& why) const {
    throw InvalidFile(
        {{place_of(mark), fmt::format("the file {}; expected OpenCV's YAML with image_width, "
                                      "image_height, camera_matrix and distortion_coefficients, as "
                                      "heft calibrate camera writes it",
                                      why)}});
  }

  // The numbers of a scalar, a list, or a matrix (a map with a list named data).
  std::vector<double> numbers(const std::string& key, const char* expected) {
    const auto value = values_.find(key);
    std::vector<double> numbers;
    if (value != values_.end()) {
      const YAML::Node& node = value->second.node;
      const YAML::Node list = node.IsMap() ? node["data"] : node;
      if (list && list.IsScalar()) numbers.push_back(number_in(list.Scalar()).value_or(NAN));
      if (list && list.IsSequence())
        for (const YAML::Node& scalar : list)
          numbers.push_back(number_in(scalar.Scalar()).value_or(NAN));
      const bool usable =
          !numbers.empty() && std::ranges::none_of(numbers, [](double n) { return std::isnan(n); });
      if (usable && node.IsMap()) require_shape(key, node, numbers.size());
      if (usable) return numbers;
    }
    mistake(fmt::format("{} {}, expected {}", key,
                        value == values_.end() ? "is missing" : "is unusable", expected));
    return {};
  }

  // The size and type that a matrix declares.
  void require_shape(const std::string& key, const YAML::Node& matrix, std::size_t n) {
    const auto declared = [&](const char* name, const std::string& otherwise) {
      return matrix[name] ? matrix[name].Scalar() : otherwise;
    };
    const std::string rows = declared("rows", "1"),
                      columns = declared("cols", fmt::format("{}", n)), type = declared("dt", "d");
    const auto n_rows = number_in(rows), n_columns = number_in(columns);
    if (!n_rows || !n_columns || *n_rows < 1 || *n_rows * *n_columns != static_cast<double>(n))
      mistake(
          fmt::format("{} says {} rows and {} cols, but has {} numbers", key, rows, columns, n));
    if (type != "d" && type != "f")
      mistake(fmt::format("{} says dt: {}, expected d or f", key, type));
  }

  std::string file_;
  std::map<std::string, Value, std::less<>> values_;
  std::vector<Mistake> mistakes_;
};

std::string matrix_text(const char* key, std::size_t rows, std::size_t columns,
                        const std::vector<double>& values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n",
                     key, rows, columns, fmt::join(values, ", "));
}

// Keys that OpenCV's files lack.
std::string extra_text(const Intrinsics& camera) {
  const CameraLocks& locks = camera.calibrated_at;
  std::string text;
  if (locks.exposure_s) text += fmt::format("exposure_s: {}\n", *locks.exposure_s);
  if (locks.focus) text += fmt::format("focus: {}\n", *locks.focus);
  if (camera.readout_s > 0) text += fmt::format("readout_s: {}\n", camera.readout_s);
  if (camera.response) text += fmt::format("response: [ {} ]\n", fmt::join(*camera.response, ", "));
  return text;
}

std::string comment_lines(const std::string& comment) {
  std::string lines, line;
  std::istringstream in(comment);
  while (std::getline(in, line)) lines += "# " + line + "\n";
  return lines;
}
}  // namespace

Intrinsics parse_intrinsics(const std::string& text, const std::string& file) {
  Reader reader(text, file);
  Intrinsics camera;
  camera.width_px = reader.side("image_width");
  camera.height_px = reader.side("image_height");
  reader.matrix(camera);
  reader.distortion(camera);
  camera.calibrated_at = {
      reader.extra("exposure_s", 1e-6, 1, "the exposure time in seconds, up to 1"),
      reader.extra("focus", 0, 1e6, "the driver's position of the lens, 0 or more")};
  camera.readout_s =
      reader.extra("readout_s", 0, 0.2, "the seconds from the first row to the last, up to 0.2")
          .value_or(0);
  camera.response = reader.response();
  reader.finish();
  return camera;
}

std::string read_camera_file(const std::string& path) {
  try {
    return read_text_file(path);
  } catch (const Error& error) {
    throw Error(fmt::format("{}; it is the camera's calibration, which is made with heft calibrate "
                            "camera --camera camera:0 --board BOARD.toml --out {}",
                            error.what(), shell_quoted(path)),
                error.exit_code());
  }
}

Intrinsics load_intrinsics(const std::string& path) {
  return parse_intrinsics(read_camera_file(path), path);
}

std::string to_yaml(const Intrinsics& camera, const std::string& comment) {
  const std::vector<double> matrix{
      camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
  const std::vector<double> all(camera.distortion.begin(), camera.distortion.end());
  const bool rational = all[5] != 0 || all[6] != 0 || all[7] != 0;
  const std::vector<double> distortion(all.begin(), all.begin() + (rational ? 8 : 5));
  return "%YAML:1.0\n---\n" + comment_lines(comment) +
         fmt::format("image_width: {}\nimage_height: {}\n", camera.width_px, camera.height_px) +
         matrix_text("camera_matrix", 3, 3, matrix) +
         matrix_text("distortion_coefficients", 1, distortion.size(), distortion) +
         extra_text(camera);
}

}  // namespace heft
