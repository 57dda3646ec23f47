#include "apparatus/sources/PictureSource.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "apparatus/sources/DraggedPictures.h"
#include "apparatus/sources/FilmedPictures.h"
#include "apparatus/sources/PacedPictures.h"
#include "base/Names.h"
#include "base/Pose.h"

namespace heft {

namespace {

std::unique_ptr<PictureSource> make_hand(const PictureParts& parts) {
  return std::make_unique<HandPictures>(parts.hand, parts.protocol.display_rate_hz);
}

std::unique_ptr<PictureSource> make_synthetic(const PictureParts& parts) {
  return std::make_unique<SyntheticPictures>(parts);
}

std::unique_ptr<PictureSource> make_dragged(const PictureParts& parts) {
  return std::make_unique<DraggedPictures>(parts);
}

std::unique_ptr<PictureSource> open(const std::string& kind, const PictureParts& parts) {
  const auto open_it = [kind, what = parts.what,
                        request =
                            request_for(parts.apparatus.camera, parts.protocol.display_rate_hz)] {
    return open_camera(kind, what, request);
  };
  return std::make_unique<CameraPictures>(open_it, parts);
}

constexpr std::array table{
    TrackerEntry{"hand", "the responder's own effector pose; no pixels", false, false,
                 TrackerWhat::nothing, make_hand},
    TrackerEntry{"surrogate", "the strokes of the responder's hand alone, for simulations: fast",
                 false, false, TrackerWhat::nothing, make_hand, false, false},
    TrackerEntry{"synthetic",
                 "a rendered camera that films the responder's hand; synthetic:FILE.toml sets "
                 "its imperfections",
                 true, false, TrackerWhat::settings, make_synthetic},
    TrackerEntry{
        "mouse",
        "the participant drags the effector in the window, with the mouse or a finger; for "
        "trying and teaching without printed tags",
        true, false, TrackerWhat::nothing, make_dragged, true},
    TrackerEntry{"camera", "camera:N, a live camera", true, true, TrackerWhat::source,
                 [](const PictureParts& parts) { return open("camera", parts); }},
    TrackerEntry{"video", "video:FILE, a video", true, false, TrackerWhat::source,
                 [](const PictureParts& parts) { return open("video", parts); }},
    TrackerEntry{"frames", "frames:FOLDER, images in the order of their names", true, false,
                 TrackerWhat::source,
                 [](const PictureParts& parts) { return open("frames", parts); }}};

}  // namespace

std::span<const TrackerEntry> trackers() {
  return table;
}

const TrackerEntry& tracker_named(std::string_view name) {
  return entry_named("tracker", name, trackers());
}

std::unique_ptr<PictureSource> open_pictures(const TrackerEntry& tracker,
                                             const PictureParts& parts) {
  return std::make_unique<PacedPictures>(tracker.make(parts), parts.protocol.display_rate_hz);
}

void PictureCount::skip_to(double t_s) {
  const double due = std::floor(t_s * rate_hz_);
  if (due <= static_cast<double>(next_)) return;
  const auto number = static_cast<std::uint64_t>(due);
  n_skipped_ += static_cast<int>(number - next_);
  next_ = number;
}

void HandPictures::begin_attempt(const AttemptStart&) {
  count_.restart();
  last_ = {};
  last_.tracked = false;
}

std::optional<Picture> HandPictures::next() {
  Picture picture;
  picture.n_dropped = count_.skipped();
  TargetSample& sample = picture.sample;
  sample.t_capture_s = count_.time_s(count_.take());
  const HandSample hand = responder_.hand(sample.t_capture_s);
  sample.pose = hand.pose;
  sample.tracked = hand.in_view;
  if (sample.tracked && last_.tracked)
    sample.velocity =
        mean_velocity(last_.pose, sample.pose, sample.t_capture_s - last_.t_capture_s);
  last_ = sample;
  return picture;
}

}  // namespace heft
