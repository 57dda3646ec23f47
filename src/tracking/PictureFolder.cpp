// A folder of pictures as a camera.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "base/Error.h"
#include "base/TextFile.h"
#include "tracking/CameraSources.h"
#include "tracking/ImageFile.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

constexpr double rate_without_times_hz = 30;

// A number in a name counts as a number: frame_2 before frame_10.
bool natural_less(std::string_view a, std::string_view b) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto take_number = [&](std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
    const auto end = std::ranges::find_if_not(text, is_digit);
    const std::string_view number(text.begin(), end);
    text.remove_prefix(number.size());
    return number;
  };
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view x = take_number(a), y = take_number(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // img_1 and img_01
}

std::vector<std::string> picture_names(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file() && is_image_file(entry.path().string()))
      names.push_back(entry.path().filename().string());
  if (error)
    throw Error(
        fmt::format("{} can't be read as a folder of pictures: {}", folder, error.message()));
  if (names.empty())
    throw Error(fmt::format("{} holds no pictures (png, jpg, bmp, pgm, ppm, tif)", folder));
  std::ranges::sort(names, natural_less);
  return names;
}

InvalidFile wrong_time(const std::string& file, std::size_t line, const std::string& what) {
  std::vector<Mistake> mistakes(1);
  mistakes[0].place = {file, static_cast<int>(line), 1};
  mistakes[0].message = what;
  return InvalidFile(std::move(mistakes));
}

// Time of each picture by its file's name.
std::map<std::string, double, std::less<>> read_times(const std::string& file) {
  const std::string text = read_text_file(file);
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty() || cells_of(lines[0]) != std::vector<std::string_view>{"frame", "t_s"})
    throw wrong_time(file, 1, "the first line must be frame,t_s");
  std::map<std::string, double, std::less<>> times;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> cells = cells_of(lines[i]);
    if (cells.size() == 1 && cells[0].empty()) continue;
    const auto t_s = cells.size() == 2 ? number_in(cells[1]) : std::nullopt;
    if (!t_s)
      throw wrong_time(file, i + 1,
                       fmt::format("expected a file's name and its time in seconds, "
                                   "as in frame_1.png,0.033; found \"{}\"",
                                   lines[i]));
    if (!times.emplace(cells[0], *t_s).second)
      throw wrong_time(file, i + 1, fmt::format("{} has a time already", cells[0]));
  }
  return times;
}

std::vector<double> times_of(const std::string& folder, const std::vector<std::string>& names) {
  const std::string file = (fs::path(folder) / "times.csv").string();
  std::vector<double> times;
  if (!fs::exists(file)) {
    for (std::size_t i = 0; i < names.size(); ++i)
      times.push_back(static_cast<double>(i) / rate_without_times_hz);
    return times;
  }
  const auto by_name = read_times(file);
  for (const std::string& name : names) {
    const auto found = by_name.find(name);
    if (found == by_name.end())
      throw Error(
          fmt::format("{} has no line for {}; add its time, or move the picture away", file, name));
    if (!times.empty() && found->second <= times.back())
      throw Error(
          fmt::format("{}: times must increase from picture to picture in the order of "
                      "their names, but {} at {} s comes after {} s",
                      file, name, found->second, times.back()));
    times.push_back(found->second);
  }
  return times;
}

class PictureFolder : public Camera {
 public:
  explicit PictureFolder(const std::string& folder)
      : folder_(folder), names_(picture_names(folder)), times_s_(times_of(folder, names_)) {
    first_ = read_image(path_of(0));
  }

  std::optional<CameraPicture> next(double) override {
    if (ended()) return std::nullopt;
    const std::size_t i = next_++;
    const double t_s = times_s_[i] - times_s_[0];
    return CameraPicture{i == 0 ? first_ : read(i, t_s), t_s, static_cast<std::int64_t>(i),
                         names_[i]};
  }
  bool ended() const override { return next_ == names_.size(); }
  bool is_live() const override { return false; }

  CameraMode mode() const override {
    const double duration_s = times_s_.back() - times_s_.front();
    const double rate_hz = duration_s > 0 ? static_cast<double>(names_.size() - 1) / duration_s : 0;
    return {first_.width, first_.height, rate_hz, "", {}, {}};
  }

 private:
  Image read(std::size_t i, double t_s) const {
    try {
      return read_image(path_of(i));
    } catch (const Error& error) {
      throw DamagedPicture(error.what(), names_[i], t_s);
    }
  }
  std::string path_of(std::size_t i) const { return (fs::path(folder_) / names_[i]).string(); }

  std::string folder_;
  std::vector<std::string> names_;
  std::vector<double> times_s_;
  Image first_;
  std::size_t next_ = 0;
};
}  // namespace

std::unique_ptr<Camera> open_picture_folder(const std::string& path, const CameraRequest&) {
  return std::make_unique<PictureFolder>(path);
}

}  // namespace heft
