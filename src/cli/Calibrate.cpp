// heft calibrate: the camera from views of the board, and where the effector's tags really are.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/Progress.h"
#include "cli/StopOnSignal.h"
#include "cli/Talk.h"
#include "protocol/MarkerFile.h"
#include "tracking/Camera.h"
#include "tracking/EffectorCalibration.h"
#include "tracking/ViewCollector.h"

namespace heft::cli {

namespace {
constexpr double patience_s = 5;  ///< with a camera that gives no picture

struct Options {
  std::string source, board, camera_file, effector, out;
};

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) throw Error(fmt::format("can't write {}; does its folder exist?", path));
}

// The next picture; none at the end of a file, or when the person stops.
std::optional<CameraPicture> next_picture(Camera& camera, const StopOnSignal& stop) {
  if (stop.requested() || camera.ended()) return std::nullopt;
  auto picture = camera.next(patience_s);
  if (!picture && !camera.ended() && !stop.requested())
    throw Error(
        fmt::format("the camera gave no picture for {} s; is it still plugged in?", patience_s),
        ExitCode::device_missing);
  return picture;
}

std::string name_of_picture(const CameraPicture& picture) {
  return picture.name.empty() ? fmt::format("picture {}", picture.number) : picture.name;
}

void say_progress(const ViewCollector& views) {
  say("{}{} views of {}; {:.0f} % of the picture\n", views.coverage().drawing(), views.size(),
      ViewCollector::enough, 100 * views.coverage().share());
  if (!views.wanted().empty()) say("next: {}\n", views.wanted());
}

// Every picture of a file; of a live camera until all is there or the person presses Ctrl-C.
ViewCollector board_views(Camera& camera, const MarkerBody& board) {
  const StopOnSignal stop;
  const bool live = camera.is_live();
  auto picture = next_picture(camera, stop);
  if (!picture) throw Error("there is no picture to calibrate from");
  if (live)
    say("Move the board slowly through the whole picture, near and far, tilted to all sides. Hold\n"
        "it still for a moment in each place. Ctrl-C ends it with what is there.\n");
  ViewCollector views(board, picture->image.width, picture->image.height, live);
  for (; picture; picture = next_picture(camera, stop)) {
    if (views.offer(picture->image, name_of_picture(*picture)) && live) say_progress(views);
    if (live ? views.complete() || views.full() : views.full()) break;
  }
  return views;
}

// What can't become a camera file, and what to film to make it one.
void require_views(const ViewCollector& views) {
  if (views.size() >= least_views) return;
  std::string missing;
  for (const std::string& what : views.missing()) missing += "\n  " + what;
  if (views.size() == 0)
    throw Error(
        fmt::format("no picture shows the board: {}. Is it the right board file, is the "
                    "board in view, sharp and evenly lit?",
                    views.tally()));
  throw Error(
      fmt::format("too few views of the board that differ: {}; expected at least {} and "
                  "better {}. What is missing:{}",
                  views.tally(), least_views, ViewCollector::enough, missing));
}

void say_views(const CameraCalibration& result) {
  for (const CalibratedView& view : result.views)
    say("{}: {} tags, {:.3f} px{}\n", view.name, view.n_tags, view.reprojection_px,
        view.used ? "" : ", left out: does not fit the others");
  say("{}", result.coverage.drawing());
}

void calibrate_the_camera(const Options& options) {
  const MarkerBody board = load_board(options.board);
  const auto camera = open_camera(options.source);
  const ViewCollector views = board_views(*camera, board);
  require_views(views);
  say("{}; computing...\n", views.tally());
  const CameraCalibration result = calibrate_camera(board, views.pictures(), views.names());
  say_views(result);
  const std::string text = summary(result);
  write_file(options.out, to_yaml(result.camera, "Made by heft calibrate camera.\n" + text));
  fmt::print("{}", text);
  if (!doubts(result).empty())
    say("{} is written, but should not be trusted: see above, and calibrate once more\n",
        options.out);
  else
    say("{} is written. Next: heft calibrate effector --camera camera:0 --camera-file {} "
        "--effector EFFECTOR.toml --out MEASURED.toml\n",
        options.out, options.out);
}

// Views with two tags or more that differ from each other.
class EffectorViews {
 public:
  EffectorViews(const MarkerBody& effector, const Intrinsics& camera)
      : camera_(camera), viewer_(effector), counts_(effector.tags.size()) {}

  void offer(const CameraPicture& picture) {
    require_size(picture);
    TagView view = viewer_.view(picture.image, camera_);
    view.name = name_of_picture(picture);
    if (view.tags.size() < 2 || views_.size() >= most) return;
    for (const TagView& kept : views_)
      if (difference_px(view, kept) < camera_.width_px * 0.01) return;
    for (const SeenTag& seen : view.tags) ++counts_[seen.tag];
    views_.push_back(std::move(view));
  }

  bool complete() const {
    return views_.size() >= enough && std::ranges::min(counts_) >= enough_of_a_tag;
  }
  bool full() const { return views_.size() >= most; }
  double share() const { return static_cast<double>(views_.size()) / enough; }
  const std::vector<TagView>& views() const { return views_; }

  std::string counts(const MarkerBody& effector) const {
    std::string text = fmt::format("{} pictures;", views_.size());
    for (std::size_t i = 0; i < counts_.size(); ++i)
      text += fmt::format(" tag {}: {}", effector.tags[i].id, counts_[i]);
    return text;
  }

 private:
  static constexpr std::size_t enough = 46, most = 120;
  static constexpr int enough_of_a_tag = 12;

  void require_size(const CameraPicture& picture) const {
    if (picture.image.width == camera_.width_px && picture.image.height == camera_.height_px)
      return;
    throw Error(fmt::format("{} is {} x {} pixels, but the camera was calibrated at {} x {}",
                            name_of_picture(picture), picture.image.width, picture.image.height,
                            camera_.width_px, camera_.height_px));
  }

  Intrinsics camera_;
  TagViewer viewer_;
  std::vector<TagView> views_;
  std::vector<int> counts_;
};

void calibrate_the_effector(const Options& options) {
  const Intrinsics intrinsics = load_intrinsics(options.camera_file);
  const MarkerBody nominal = load_effector(options.effector);
  const auto camera = open_camera(options.source);
  const StopOnSignal stop;
  EffectorViews views(nominal, intrinsics);
  if (camera->is_live())
    say("Turn the effector slowly in front of the camera, near, so that two faces or three are\n"
        "seen at a time. Ctrl-C ends it with what is there.\n");
  {
    ProgressBar bar("effector");
    while (const auto picture = next_picture(*camera, stop)) {
      views.offer(*picture);
      bar.update(views.share(), views.counts(nominal));
      if (camera->is_live() ? views.complete() || views.full() : views.full()) break;
    }
  }
  const EffectorCalibration result = calibrate_effector(nominal, intrinsics, views.views());
  const std::string text = summary(result);
  write_file(options.out,
             effector_to_toml(result.effector, "Made by heft calibrate effector from " +
                                                   options.effector + ".\n" + text));
  fmt::print("{}", text);
  say("{} is written: use it as the effector file. Next: heft doctor\n", options.out);
}

void add_source(CLI::App& command, Options& options) {
  command.add_option("--camera", options.source, "camera:N, video:FILE or frames:FOLDER")
      ->required();
}

void add_camera(CLI::App& parent) {
  CLI::App* command = parent.add_subcommand("camera", "the camera, from views of the board");
  const auto options = std::make_shared<Options>();
  add_source(*command, *options);
  command->add_option("--board", options->board, "board file")->required();
  command->add_option("--out", options->out, "the camera file (OpenCV YAML) to write")->required();
  command->callback([options] { calibrate_the_camera(*options); });
}

void add_effector(CLI::App& parent) {
  CLI::App* command =
      parent.add_subcommand("effector", "where the effector's tags really are, from pictures");
  const auto options = std::make_shared<Options>();
  add_source(*command, *options);
  command->add_option("--camera-file", options->camera_file, "the calibrated camera")->required();
  command->add_option("--effector", options->effector, "effector file as designed")->required();
  command->add_option("--out", options->out, "the effector file to write")->required();
  command->callback([options] { calibrate_the_effector(*options); });
}
}  // namespace

void add_calibrate(CLI::App& app) {
  CLI::App* command =
      add_command(app, "calibrate", "measure the camera, or where the effector's tags are",
                  {"heft calibrate camera --camera camera:0 --board BOARD.toml --out camera.yaml",
                   "heft calibrate effector --camera camera:0 --camera-file camera.yaml \\\n"
                   "      --effector EFFECTOR.toml --out MEASURED.toml"});
  command->require_subcommand(1);
  add_camera(*command);
  add_effector(*command);
}

}  // namespace heft::cli
