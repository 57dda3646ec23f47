// heft track: tracking alone. Reads pictures of a board and an effector, prints their poses as CSV.
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/Error.h"
#include "base/Names.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "protocol/readers/Files.h"
#include "tracking/Tracker.h"
#include "tracking/camera/Camera.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/pose/PoseColumns.h"

namespace heft::cli {

namespace {
struct TrackOptions {
  std::string camera, board, effector;
  std::vector<std::string> frames;
  double rate_hz = 30;
};

constexpr const char* columns_explained = R"(
Columns: frame (from 0), t_s (seconds), board_found and effector_found (1 or 0);
x_m...qz: the effector's center in the board's frame (origin at the board's
center, z up, x to the participant's right); camera_x_m...camera_qz: the board
in the camera's frame (x right, y down, z forward). Poses are unfiltered, and
blank where nothing was found.
n_tags, reprojection_px and quality are the effector's; without --effector the
board's. reprojection_px: rms distance of tag edges from the pose's. quality: 0
(none) to 1, confidence in the pose; below 0.05 there is no pose. effector_t_s:
when the effector's own row was read; equals t_s unless the camera file has a
readout_s.
A picture that cannot be read has a row without poses, and is named on stderr;
the exit code is then 1.
)";

// n_tags, reprojection_px and quality are the effector's, or the board's if no effector file is
// given.
std::string row(long frame, double t_s, const TrackedPicture& seen, bool with_effector) {
  const bool found =
      with_effector ? seen.board_from_effector.has_value() : seen.camera_from_board.has_value();
  const int n_tags = with_effector ? seen.n_effector_tags : seen.n_board_tags;
  const double off_px = with_effector ? seen.effector_reprojection_px : seen.board_reprojection_px;
  return fmt::format("{},{},{:d},{:d},{},{},{},{},{}", frame, t_s,
                     seen.camera_from_board.has_value(), seen.board_from_effector.has_value(),
                     pose_cells(seen.board_from_effector, seen.camera_from_board), n_tags,
                     found ? fmt::format("{}", off_px) : "", found ? seen.quality : 0,
                     found && with_effector ? seen.effector_t_s : t_s);
}

// A picture; if it cannot be read, the reason instead of an image.
struct TakenPicture {
  Image image;
  double t_s = 0;
  std::string name, damage;
};
using TakePicture = std::function<void(const TakenPicture&)>;

TakenPicture read_picture(const std::string& file, double t_s) {
  try {
    return {read_image(file), t_s, file, ""};
  } catch (const Error& error) {
    return {{}, t_s, file, error.what()};
  }
}

void each_of_camera(const std::string& kind, const std::string& what, const TakePicture& take) {
  const auto camera = open_camera(kind, what);
  const std::string source = kind + ":" + what;
  while (!camera->ended()) {
    try {
      const auto picture = camera->next(0);
      if (!picture) break;
      take(
          {picture->image, picture->capture_s, picture->name.empty() ? source : picture->name, ""});
    } catch (const DamagedPicture& damaged) {
      take({{}, damaged.capture_s, damaged.name, damaged.what()});
    }
  }
}

void each_picture(const TrackOptions& options, const TakePicture& take) {
  const std::vector<std::string>& frames = options.frames;
  const bool one = frames.size() == 1;
  if (one && std::filesystem::is_directory(frames[0]))
    return each_of_camera("frames", frames[0], take);
  if (one && !is_image_file(frames[0])) return each_of_camera("video", frames[0], take);
  for (std::size_t i = 0; i < frames.size(); ++i)
    take(read_picture(frames[i], static_cast<double>(i) / options.rate_hz));
}

TrackedPicture track_named(Tracker& tracker, const TakenPicture& picture) {
  if (!picture.damage.empty()) return {};
  try {
    return tracker.track(picture.image, picture.t_s);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", picture.name, error.what()), error.exit_code());
  }
}

// Counts the pictures that show each body, to report one that was never seen.
class Sightings {
 public:
  void add(const Image& picture, const TrackedPicture& tracked) {
    ++n_pictures_;
    if (tracked.camera_from_board) ++n_boards_;
    if (tracked.board_from_effector) ++n_effectors_;
    if (!picture.empty() && (n_boards_ == 0 || n_effectors_ == 0)) last_ = picture;
  }
  void say_what_was_never_seen(const Apparatus& apparatus) const {
    if (last_.empty()) return;
    if (n_boards_ == 0)
      say("the board was found in 0 of {}: {}\n", counted(n_pictures_, "picture"),
          why_unseen(last_, apparatus.board, "board"));
    else if (n_effectors_ == 0 && !apparatus.effector.tags.empty())
      say("the effector was found in 0 of {}: {}\n", counted(n_pictures_, "picture"),
          why_unseen(last_, apparatus.effector, "effector", apparatus.board));
  }

 private:
  long n_pictures_ = 0, n_boards_ = 0, n_effectors_ = 0;
  Image last_;
};

void run_track(const TrackOptions& options) {
  if (!(options.rate_hz > 0 && options.rate_hz <= 1e6))
    throw Error(
        fmt::format("--rate {}: expected more than 0 and at most 1000000 pictures per second",
                    options.rate_hz),
        ExitCode::usage);
  Apparatus apparatus;
  apparatus.camera = load_intrinsics(options.camera);
  apparatus.board = load_board(options.board);
  const bool with_effector = !options.effector.empty();
  if (with_effector) apparatus.effector = load_effector(options.effector);
  if (with_effector) require_different_tags(apparatus.board, apparatus.effector);
  Tracker tracker(apparatus);
  fmt::print(
      "frame,t_s,board_found,effector_found,{},n_tags,reprojection_px,quality,effector_t_s\n",
      pose_columns);
  long frame = 0, n_damaged = 0;
  Sightings sightings;
  each_picture(options, [&](const TakenPicture& picture) {
    if (!picture.damage.empty()) {
      ++n_damaged;
      say("frame {}: {}\n", frame, picture.damage);
    }
    const TrackedPicture tracked = track_named(tracker, picture);
    sightings.add(picture.image, tracked);
    fmt::print("{}\n", row(frame++, picture.t_s, tracked, with_effector));
  });
  sightings.say_what_was_never_seen(apparatus);
  if (n_damaged > 0)
    throw Error(fmt::format("{} of {} cannot be read; rows of these have no poses", n_damaged,
                            counted(frame, "picture")));
}
}  // namespace

void add_track(Command& app) {
  Command command = app.add_command(
      "track", "tracking alone: pictures in, poses of board and effector out (CSV)",
      {"heft track --camera-file camera.yaml --board board.toml --effector effector.toml frames/",
       "heft track --camera-file camera.yaml --board board.toml one.png two.png",
       "heft track --camera-file camera.yaml --board board.toml film.mp4 > poses.csv"});
  command.is_minor();
  command.add_to_help(columns_explained);
  const auto options = std::make_shared<TrackOptions>();
  command.add_option("--camera-file", &options->camera, "the camera's calibration, OpenCV's YAML")
      .required();
  command.add_option("--board", &options->board, "a board file").required();
  command.add_option("--effector", &options->effector, "an effector file");
  command.add_option("--rate", &options->rate_hz, "pictures per second, for single picture files")
      .shows_default();
  command.add_option("FRAMES", &options->frames, "picture files, a folder of them, or a video")
      .required();
  command.does([options] { run_track(*options); });
}

}  // namespace heft::cli
