// heft calibrate: measures the camera, and the positions and the size of the effector's tags.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <regex>
#include <string>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "protocol/readers/Files.h"
#include "tracking/Tracker.h"
#include "tracking/calibration/EffectorCalibration.h"
#include "tracking/calibration/OnBoardCalibration.h"
#include "tracking/calibration/Response.h"
#include "tracking/calibration/ShutterCalibration.h"
#include "tracking/calibration/ViewCollector.h"
#include "tracking/camera/Camera.h"

namespace heft::cli {

namespace {
constexpr const char* doubtful =
    "{} is written, but should not be trusted: see above, and calibrate again\n";
constexpr double patience_s = 5;     ///< limit for a camera without a picture
constexpr double no_display_hz = 0;  ///< no display waits for the pictures

struct CalibrateOptions {
  std::optional<Plug> source;
  std::string board, camera_file, effector, out, size;
  std::optional<double> exposure_ms;
  bool shutter = false, on_board = false;
};

// Settings of a live camera during calibration, recorded for later sessions.
CameraRequest request_of(const CalibrateOptions& options) {
  constexpr double shortest_ms = 0.1, longest_ms = 100;
  CameraRequest request;
  if (!options.size.empty()) {
    static const std::regex width_x_height("([1-9][0-9]{1,4})x([1-9][0-9]{1,4})");
    std::smatch sides;
    if (!std::regex_match(options.size, sides, width_x_height))
      throw Error(fmt::format("--size {}: expected width and height in pixels, as in 1280x720",
                              options.size),
                  ExitCode::usage);
    request.width_px = std::stoi(sides[1]);
    request.height_px = std::stoi(sides[2]);
  }
  const double exposure_ms = options.exposure_ms.value_or(1e3 * request.exposure_s);
  if (!(exposure_ms >= shortest_ms && exposure_ms <= longest_ms))
    throw Error(fmt::format("--exposure-ms {}: expected {} to {} ms; 4 is short enough for a fast "
                            "hand",
                            exposure_ms, shortest_ms, longest_ms),
                ExitCode::usage);
  request.exposure_s = exposure_ms / 1e3;
  return request;
}

// Refuses requests that the camera cannot fulfil, or that concern existing pictures.
void require_as_asked(const CalibrateOptions& options, const CameraRequest& request,
                      const Camera& camera, const Image& picture) {
  if (options.exposure_ms && !camera.is_live())
    throw Error(fmt::format("--exposure-ms: the pictures of {} already exist; it sets live "
                            "cameras only",
                            to_text(*options.source)),
                ExitCode::usage);
  const bool fits = picture.width == request.width_px && picture.height == request.height_px;
  if (options.size.empty() || fits) return;
  throw Error(fmt::format("--size {}: {} gives pictures of {} x {} pixels; {}", options.size,
                          to_text(*options.source), picture.width, picture.height,
                          camera.is_live() ? "heft doctor --list prints its sizes"
                                           : "omit --size, it sets live cameras only"));
}

void say_locks(const Camera& camera) {
  const CameraMode mode = camera.mode();
  if (!mode.locked.empty()) say("the camera holds: {}\n", fmt::join(mode.locked, ", "));
  for (const std::string& what : mode.not_locked) say("it does not hold {}\n", what);
}

// The next picture; none at the end of a file, or when the operator stops.
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
      ViewCollector::enough, 100 * views.coverage().fraction());
  if (!views.wanted().empty()) say("next: {}\n", views.wanted());
}

// From every picture of a file; from a live camera until complete or stopped with Ctrl-C.
ViewCollector board_views(Camera& camera, const MarkerBody& board, const CalibrateOptions& options,
                          const CameraRequest& request) {
  const StopOnSignal stop;
  const bool live = camera.is_live();
  auto picture = next_picture(camera, stop);
  if (!picture) throw Error("there is no picture to calibrate from");
  require_as_asked(options, request, camera, picture->image);
  say_locks(camera);
  if (live)
    say("Move the board slowly through the whole picture, near and far, tilted to all sides. Hold\n"
        "it still for a moment in each place. Ctrl-C ends with the views so far.\n");
  ViewCollector views(board, picture->image.width, picture->image.height, live);
  for (; picture; picture = next_picture(camera, stop)) {
    if (views.offer(picture->image, name_of_picture(*picture)) && live) say_progress(views);
    if (live ? views.complete() || views.full() : views.full()) break;
  }
  return views;
}

// Refuses too few views, with advice on which to film.
void require_views(const ViewCollector& views, const MarkerBody& board) {
  if (views.size() >= least_views) return;
  std::string missing;
  for (const std::string& what : views.missing()) missing += "\n  " + what;
  if (views.size() == 0)
    throw Error(fmt::format("no picture shows the board: {}. The last one: {}", views.tally(),
                            why_unseen(views.last_offered(), board, "board")));
  throw Error(
      fmt::format("too few different views of the board: {}; expected at least {}, "
                  "better {}. Missing:{}",
                  views.tally(), least_views, ViewCollector::enough, missing));
}

void say_views(const CameraCalibration& result) {
  for (const CalibratedView& view : result.views)
    say("{}: {} tags, {:.3f} px{}\n", view.name, view.n_tags, view.reprojection_px,
        view.used ? "" : ", left out: does not fit the others");
  say("{}", result.coverage.drawing());
}

void calibrate_the_camera(const CalibrateOptions& options) {
  require_writable(options.out);
  const CameraRequest request = request_of(options);
  const MarkerBody board = load_board(options.board);
  const auto camera = open_camera(options.source->name, options.source->what, request);
  const ViewCollector views = board_views(*camera, board, options, request);
  require_views(views, board);
  say("{}; computing...\n", views.tally());
  CameraCalibration result = calibrate_camera(board, views.pictures(), views.names());
  result.camera.calibrated_at = camera->mode().held;
  const MarkerBody printed =
      with_scaled_tags(board, result.tags.is_off() ? 1 + result.tags.excess : 1);
  result.camera.response = learned_response(result.camera, printed, views.pictures());
  say_views(result);
  // Ink looks like a tone curve, which summary() names.
  const std::string text =
      summary(result) + (result.tags.has_spread() ? "" : response_in_words(result.camera));
  replace_file(options.out, to_yaml(result.camera, "Made by heft calibrate camera.\n" + text));
  print("{}", text);
  if (!doubts(result).empty())
    say(doubtful, options.out);
  else
    say("{} is written. Next: heft calibrate effector --camera camera:0 --camera-file {} "
        "--effector EFFECTOR.toml --out MEASURED.toml\n",
        options.out, shell_quoted(options.out));
}

// From every picture of a file; from a live camera until there are enough of a moving board, or
// Ctrl-C.
std::vector<TimedView> waved_views(Camera& camera, const MarkerBody& board,
                                   const Intrinsics& intrinsics) {
  constexpr std::size_t wanted = 3 * enough_waved_pictures, most = 600;
  const StopOnSignal stop;
  say_locks(camera);
  if (camera.is_live())
    say("Wave the board to and fro and up and down in front of the camera, as fast as it stays\n"
        "sharp. Ctrl-C ends with the views so far.\n");
  TagViewer viewer(board);
  std::vector<TimedView> views;
  ProgressBar bar("board");
  while (const auto picture = next_picture(camera, stop)) {
    TagView view = viewer.view(picture->image, intrinsics);
    if (view.tags.size() >= least_tags_of_a_view)
      views.push_back({picture->capture_s, std::move(view)});
    bar.update(static_cast<double>(views.size()) / wanted,
               fmt::format("{} pictures", views.size()));
    if (views.size() >= (camera.is_live() ? wanted : most)) break;
  }
  return views;
}

void calibrate_the_shutter(const CalibrateOptions& options) {
  if (options.camera_file.empty())
    throw Error("--shutter needs --camera-file: the calibrated camera", ExitCode::usage);
  if (!options.size.empty() || options.exposure_ms)
    throw Error("--shutter uses the size and the exposure of the camera file", ExitCode::usage);
  require_writable(options.out);
  Intrinsics intrinsics = load_intrinsics(options.camera_file);
  const MarkerBody board = load_board(options.board);
  const auto camera =
      open_camera(options.source->name, options.source->what, request_for(intrinsics, 0));
  const auto views = waved_views(*camera, board, intrinsics);
  const ShutterCalibration result = calibrate_shutter(board, intrinsics, views);
  const std::string text = summary(result);
  print("{}", text);
  if (!doubts(result).empty())
    throw Error(
        fmt::format("the read-out was not found, and {} is not written: see above", options.out));
  intrinsics.readout_s = std::max(result.readout_s, 0.0);
  replace_file(options.out,
               to_yaml(intrinsics, "Made by heft calibrate camera --shutter.\n" + text));
  say("{} is written. Next: heft doctor\n", options.out);
}

template <typename Calibration>
void write_effector(const CalibrateOptions& options, const char* made_by,
                    const Calibration& result) {
  const std::string text = summary(result);
  replace_file(options.out,
               effector_to_toml(result.effector, fmt::format("Made by {} from {}.\n{}", made_by,
                                                             options.effector, text)));
  print("{}", text);
  if (!doubts(result).empty())
    say(doubtful, options.out);
  else
    say("{} is written: use it as the effector file. Next: heft doctor\n", options.out);
}

// From every picture of a file; from a live camera until there are enough, or Ctrl-C.
StandingViews standing_views(Camera& camera, const MarkerBody& board, const MarkerBody& effector,
                             const Intrinsics& intrinsics) {
  const StopOnSignal stop;
  say_locks(camera);
  if (camera.is_live())
    say("Stand the effector on the board, let go of it, and do so in several places, near and "
        "far.\nCtrl-C ends with the pictures so far.\n");
  StandingViews views(board, effector, intrinsics, camera.is_live());
  ProgressBar bar("on the board");
  while (const auto picture = next_picture(camera, stop)) {
    views.offer(picture->image, name_of_picture(*picture));
    bar.update(views.progress(), fmt::format("{} places", views.views().size()));
    if (camera.is_live() ? views.complete() : views.full()) break;
  }
  return views;
}

void calibrate_the_effector_on_board(const CalibrateOptions& options) {
  if (options.board.empty())
    throw Error("--on-board needs --board: the board that the effector stands on", ExitCode::usage);
  require_writable(options.out);
  const Intrinsics intrinsics = load_intrinsics(options.camera_file);
  const MarkerBody board = load_board(options.board), effector = load_effector(options.effector);
  require_different_tags(board, effector);
  const auto camera = open_camera(options.source->name, options.source->what,
                                  request_for(intrinsics, no_display_hz));
  const StandingViews views = standing_views(*camera, board, effector, intrinsics);
  if (views.views().empty())
    throw Error(
        fmt::format("no picture shows the effector standing on the board: {}; stand it on "
                    "the board, in view, and let go of it",
                    views.tally()));
  say("{}\n", views.tally());
  const OnBoardCalibration result = calibrate_on_board(board, effector, intrinsics, views.views());
  write_effector(options, "heft calibrate effector --on-board", result);
}

void calibrate_the_effector(const CalibrateOptions& options) {
  require_writable(options.out);
  const Intrinsics intrinsics = load_intrinsics(options.camera_file);
  const MarkerBody nominal = load_effector(options.effector);
  const auto camera = open_camera(options.source->name, options.source->what,
                                  request_for(intrinsics, no_display_hz));
  const StopOnSignal stop;
  EffectorViews views(nominal, intrinsics);
  say_locks(*camera);
  if (camera->is_live())
    say("Turn the effector slowly close to the camera, so that two or three faces are visible\n"
        "at a time. Ctrl-C ends with the views so far.\n");
  {
    ProgressBar bar("effector");
    while (const auto picture = next_picture(*camera, stop)) {
      views.offer(picture->image, name_of_picture(*picture));
      bar.update(views.progress(), views.counts());
      if (camera->is_live() ? views.complete() || views.full() : views.full()) break;
    }
  }
  const EffectorCalibration result = calibrate_effector(nominal, intrinsics, views.views());
  write_effector(options, "heft calibrate effector", result);
}

void add_source(Command& command, CalibrateOptions& options) {
  add_plug(command, "--camera", options.source, "camera:N, video:FILE or frames:FOLDER").required();
}

void add_camera(Command& parent) {
  Command command = parent.add_command(
      "camera", "the camera, from views of the board",
      {"heft calibrate camera --camera camera:0 --board BOARD.toml --out camera.yaml",
       "heft calibrate camera --camera frames:views --board BOARD.toml --out camera.yaml",
       "heft calibrate camera --shutter --camera camera:0 --camera-file camera.yaml "
       "--board BOARD.toml --out camera.yaml"});
  const auto options = std::make_shared<CalibrateOptions>();
  add_source(command, *options);
  command.add_option("--board", &options->board, "board file").required();
  command.add_option("--out", &options->out, "the camera file (OpenCV YAML) to write").required();
  command.add_option("--size", &options->size,
                     "of a live camera's pictures, WIDTHxHEIGHT (default: 640x480)");
  command.add_option("--exposure-ms", &options->exposure_ms,
                     "exposure time of a live camera (default: 4)");
  command.add_flag("--shutter", options->shutter,
                   "only the read-out time (rolling shutter), from a waved board; the rest is "
                   "--camera-file's");
  command.add_option("--camera-file", &options->camera_file,
                     "for --shutter: the calibrated camera");
  command.does([options] {
    if (options->shutter) return calibrate_the_shutter(*options);
    if (!options->camera_file.empty())
      throw Error("--camera-file requires --shutter", ExitCode::usage);
    calibrate_the_camera(*options);
  });
}

void add_effector(Command& parent) {
  Command command =
      parent.add_command("effector", "measure the effector's tags, from pictures",
                         {"heft calibrate effector --camera camera:0 --camera-file camera.yaml "
                          "--effector EFFECTOR.toml --out MEASURED.toml",
                          "heft calibrate effector --on-board --camera camera:0 --camera-file "
                          "camera.yaml --board BOARD.toml --effector MEASURED.toml "
                          "--out MEASURED.toml"});
  const auto options = std::make_shared<CalibrateOptions>();
  add_source(command, *options);
  command.add_option("--camera-file", &options->camera_file, "the calibrated camera").required();
  command.add_option("--effector", &options->effector, "effector file as designed").required();
  command.add_option("--out", &options->out, "the effector file to write").required();
  command.add_flag("--on-board", options->on_board,
                   "only its print's size relative to the board's, from pictures of it standing on "
                   "the board");
  command.add_option("--board", &options->board, "for --on-board: board file");
  command.does([options] {
    if (options->on_board) return calibrate_the_effector_on_board(*options);
    if (!options->board.empty()) throw Error("--board requires --on-board", ExitCode::usage);
    calibrate_the_effector(*options);
  });
}
}  // namespace

void add_calibrate(Command& app) {
  Command command = app.add_command(
      "calibrate", "measure the camera, the effector's tags, or the display",
      {"heft calibrate camera --camera camera:0 --board BOARD.toml --out camera.yaml",
       "heft calibrate camera --camera camera:0 --size 1280x720 --board BOARD.toml "
       "--out camera.yaml",
       "heft calibrate effector --camera camera:0 --camera-file camera.yaml "
       "--effector EFFECTOR.toml --out MEASURED.toml",
       "heft calibrate display"});
  command.needs_command();
  add_camera(command);
  add_effector(command);
  add_calibrate_display(command);
}

}  // namespace heft::cli
