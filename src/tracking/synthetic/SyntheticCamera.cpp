#include "tracking/synthetic/SyntheticCamera.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/Random.h"
#include "tracking/synthetic/FaceDrawing.h"
#include "tracking/synthetic/FilmedHand.h"
#include "tracking/synthetic/Sensor.h"

namespace heft {

namespace {
using Eigen::Vector3d;

// Renderings this far apart merge into one smear: with a blur of 0.6 px the ripple is 1e-4 of it.
constexpr double smear_step_px = 1.0;
constexpr double still_px = 0.02;  // less during the exposure counts as no motion
constexpr int most_motion_samples = 64;

double largest_move_px(const std::vector<PrintedFace>& faces, const SeenBody& from,
                       const SeenBody& to, const Lens& lens) {
  double largest = 0;
  for (const PrintedFace& face : faces) {
    for (const Vector3d& corner : face.quads.front().corners_m) {
      const Vector3d a = from.in_camera(corner), b = to.in_camera(corner);
      if (a.z() < Lens::nearest_m || b.z() < Lens::nearest_m) continue;
      largest = std::max(largest, (lens.pixel(a) - lens.pixel(b)).norm());
    }
  }
  return largest;
}

// The true board, effector and lens.
Apparatus as_it_is(Apparatus apparatus, const FileErrors& files) {
  apparatus.board = with_scaled_tags(apparatus.board, files.board_tag_scale);
  apparatus.effector = with_scaled_tags(apparatus.effector, files.effector_tag_scale);
  apparatus.camera.fx_px *= files.focal_length_scale;
  apparatus.camera.fy_px *= files.focal_length_scale;
  return apparatus;
}
}  // namespace

Intrinsics default_camera(int width_px, int height_px) {
  const double focal_px = width_px <= 640 ? 540.0 * width_px / 640 : 1000.0 * width_px / 1280;
  Intrinsics camera{
      width_px, height_px, focal_px, focal_px, (width_px - 1) / 2.0, (height_px - 1) / 2.0, {}};
  camera.distortion = {0.06, -0.15};
  return camera;
}

SyntheticSettings::SyntheticSettings()
    : camera_from_board(camera_above_board(0.45, 52 * M_PI / 180)) {}

struct SyntheticCamera::Impl {
  Impl(const Apparatus& of, const SyntheticSettings& with, std::uint64_t with_seed);

  const Optics& optics() const { return settings.optics; }
  SeenBody seen(const Pose& board_from_effector) const {
    return {settings.camera_from_board, board_from_effector};
  }
  std::vector<std::optional<Pose>> poses_while_open(const EffectorPath& path, double t_s) const;
  int motion_samples(const EffectorPath& path, double t_s) const;
  PixelBox extent(const Pose& pose) const;
  bool draw_effector(const Pose& pose, const PixelBox& box);
  void draw_hand(const Pose& pose, const PixelBox& box);
  Light effector_at(int x, int y) const {
    return instant.box.holds(x, y) ? instant.row(y)[x - instant.box.x0] : Light::Zero();
  }
  const Light& hand_at(const LightPicture& part, int x, int y) const {
    return part.row(y / fineness)[x / fineness - part.box.x0];
  }
  void put_into_hand(const PixelBox& box);
  PixelBox reached(const EffectorPath& path, double t_s) const;
  std::optional<Eigen::Vector2d> effector_px(const EffectorPath& path, double t_s) const;
  void draw_moving(const std::vector<std::optional<Pose>>& poses, const PixelBox& box);
  void draw_moving(const EffectorPath& path, double t_s);
  void put_before_still(const RowSpans& spans);
  void look_at_still(double focal_length_scale);
  void breathe(double t_s);
  Image filmed(const EffectorPath& path, double t_s, std::uint64_t number);
  Image mixed(Image now);
  void forget(const RowSpans& changed);

  SyntheticSettings settings;
  Apparatus apparatus;
  std::uint64_t seed;
  Lens coarse_lens;  ///< for the picture's pixels
  Lens lens;         ///< for fine ones, used for all light but the hand's
  std::vector<PrintedFace> effector;
  FilmedHand hand;
  Sensor sensor;
  LightPicture still;   ///< table and board, not blurred
  Levels still_levels;  ///< the same as levels of the sensor
  Levels levels;        ///< the same, restored between pictures
  AreaRaster raster;
  LightPicture instant;  ///< the effector at one moment
  /// The hand in front of and behind the effector, in the picture's pixels, since a hand's edges
  /// are not measured.
  LightPicture hand_before, hand_behind;
  LightPicture moving;  ///< its mean over the exposure, in the hand, in front of the still scene
  Image last;           ///< the last picture; empty after the start
  std::vector<float> mean;  ///< its values before they are rounded, of a camera that denoises
};

SyntheticCamera::Impl::Impl(const Apparatus& of, const SyntheticSettings& with,
                            std::uint64_t with_seed)
    : settings(with),
      apparatus(of),
      seed(with_seed),
      coarse_lens(apparatus.camera),
      lens(coarse_lens.fine()),
      effector(printed_effector(apparatus.effector, with.files.ink_m)),
      hand(apparatus.effector.size_m, with.left_hand),
      sensor(with.optics, apparatus.camera.width_px, apparatus.camera.height_px, seed) {
  look_at_still(1);
}

void SyntheticCamera::Impl::look_at_still(double focal_length_scale) {
  Intrinsics camera = apparatus.camera;
  camera.fx_px *= focal_length_scale;
  camera.fy_px *= focal_length_scale;
  coarse_lens = Lens(camera);
  lens = coarse_lens.fine();
  still = still_scene(apparatus.board, settings.camera_from_board, lens, settings.files.ink_m);
  sensor.expose(still, RowSpans::whole(coarse_of(still.box)), still_levels);
  levels = still_levels;
}

// A lens that refocuses changes its focal length.
void SyntheticCamera::Impl::breathe(double t_s) {
  constexpr double period_s = 3;
  if (optics().breathing > 0)
    look_at_still(1 + optics().breathing * std::sin(2 * M_PI * t_s / period_s));
}

// Temporal denoising, as cameras do it: a recursive mean of stored values, with more bits than
// those of the picture.
Image SyntheticCamera::Impl::mixed(Image now) {
  if (!(optics().last_picture > 0)) return now;
  if (mean.empty()) mean.assign(now.pixels.begin(), now.pixels.end());
  const auto share = static_cast<float>(optics().last_picture);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    mean[i] += (1 - share) * (static_cast<float>(now.pixels[i]) - mean[i]);
    now.pixels[i] = static_cast<std::uint8_t>(mean[i] + 0.5F);
  }
  return now;
}

// Enough for the length of the smear, so that it has no steps.
int SyntheticCamera::Impl::motion_samples(const EffectorPath& path, double t_s) const {
  const double half_s = settings.optics.exposure_s / 2;
  const auto opens = path(t_s - half_s), closes = path(t_s + half_s);
  if (!opens || !closes) return settings.motion_samples;
  const double move_px = largest_move_px(effector, seen(*opens), seen(*closes), lens) / fineness;
  if (move_px < still_px) return 1;
  return std::clamp(static_cast<int>(std::ceil(move_px / smear_step_px)), settings.motion_samples,
                    std::max(settings.motion_samples, most_motion_samples));
}

// At the middles of equal parts of the exposure.
std::vector<std::optional<Pose>> SyntheticCamera::Impl::poses_while_open(const EffectorPath& path,
                                                                         double t_s) const {
  const int n = motion_samples(path, t_s);
  std::vector<std::optional<Pose>> poses;
  for (int i = 0; i < n; ++i)
    poses.push_back(path(t_s + ((i + 0.5) / n - 0.5) * settings.optics.exposure_s));
  return poses;
}

PixelBox SyntheticCamera::Impl::extent(const Pose& pose) const {
  const auto box = extent_of(effector, seen(pose), lens);
  if (!box) return {};
  return settings.hand ? box->around(hand.extent(seen(pose), lens)) : *box;
}

// Draws the effector at one moment, within a box of fine pixels. @return false: out of view
bool SyntheticCamera::Impl::draw_effector(const Pose& pose, const PixelBox& box) {
  const SeenBody body = seen(pose);
  const auto extent = extent_of(effector, body, lens);
  if (!extent) return false;
  instant.reset(extent->within(box));
  raster.begin(instant.box);
  for (const PrintedFace& face : effector)
    if (is_seen(face, body)) draw_face(face, body, lens, raster);
  raster.draw_behind(instant);
  return true;
}

void SyntheticCamera::Impl::draw_hand(const Pose& pose, const PixelBox& box) {
  const SeenBody body = seen(pose);
  hand_before.reset(coarse_of(box));
  hand_behind.reset(coarse_of(box));
  hand.draw(FilmedHand::Side::before_box, body, coarse_lens, hand_before);
  hand.draw(FilmedHand::Side::behind_box, body, coarse_lens, hand_behind);
}

// Combines the drawn effector with the parts of the hand in front of it and behind it.
void SyntheticCamera::Impl::put_into_hand(const PixelBox& box) {
  const RowSpans before = RowSpans::covered(hand_before), behind = RowSpans::covered(hand_behind);
  for (int y = box.y0; y < box.y1; ++y) {
    const Span coarse = before.at(y / fineness).around(behind.at(y / fineness));
    Light* row = moving.row(y) - moving.box.x0;
    for (int x = coarse.begin * fineness; x < coarse.end * fineness; ++x)
      row[x] = over(hand_at(hand_before, x, y), over(row[x], hand_at(hand_behind, x, y)));
  }
}

// During every row's exposure, from the first to the last.
PixelBox SyntheticCamera::Impl::reached(const EffectorPath& path, double t_s) const {
  const int n_times = optics().readout_s > 0 ? 16 : 1;
  PixelBox box;
  for (int i = 0; i < n_times; ++i) {
    const double late_s = n_times > 1 ? optics().readout_s * i / (n_times - 1) : 0;
    for (const auto& pose : poses_while_open(path, t_s + late_s))
      if (pose) box = box.around(extent(*pose));
  }
  const int between_px = n_times > 1 ? 4 : 0;
  if (box.empty()) return box;
  return fine_of(coarse_of(box).grown(2 * sensor.reach_px() + between_px)).within(still.box);
}

// The effector's middle, when its own row is exposed.
std::optional<Eigen::Vector2d> SyntheticCamera::Impl::effector_px(const EffectorPath& path,
                                                                  double t_s) const {
  const auto seen_at = [&](double at_s) -> std::optional<Eigen::Vector2d> {
    const auto pose = path(at_s);
    if (!pose) return std::nullopt;
    const Vector3d at_m = seen(*pose).in_camera(Vector3d::Zero());
    return at_m.z() < Lens::nearest_m ? std::nullopt : std::optional(coarse_lens.pixel(at_m));
  };
  const auto early_px = seen_at(t_s);
  if (!early_px) return std::nullopt;
  return seen_at(t_s + optics().readout_s * early_px->y() / coarse_lens.camera().height_px);
}

// The effector is smeared over the exposure; the hand is drawn at its middle.
void SyntheticCamera::Impl::draw_moving(const std::vector<std::optional<Pose>>& poses,
                                        const PixelBox& box) {
  const float weight = 1 / static_cast<float>(poses.size());
  for (const std::optional<Pose>& pose : poses) {
    if (!pose || !draw_effector(*pose, box)) continue;
    const PixelBox& drawn = instant.box;
    for (int y = drawn.y0; y < drawn.y1; ++y)
      for (int x = drawn.x0; x < drawn.x1; ++x)
        moving.row(y)[x - moving.box.x0] += weight * instant.row(y)[x - drawn.x0];
  }
  const std::optional<Pose>& middle = poses[poses.size() / 2];
  if (!settings.hand || !middle || !extent_of(effector, seen(*middle), lens)) return;
  draw_hand(*middle, box);
  put_into_hand(box);
}

// Renders a rolling shutter's rows in pairs: at 0.5 m/s, with 25 ms, edges have steps of 0.05
// pixel.
void SyntheticCamera::Impl::draw_moving(const EffectorPath& path, double t_s) {
  constexpr int rows_at_once = 2 * fineness;
  const PixelBox all = moving.box;
  if (!(optics().readout_s > 0)) return draw_moving(poses_while_open(path, t_s), all);
  const double row_s = optics().readout_s / lens.camera().height_px;  // per fine row
  for (int y = all.y0; y < all.y1; y += rows_at_once) {
    const double middle = y + (rows_at_once - 1) / 2.0;
    draw_moving(poses_while_open(path, t_s + row_s * middle),
                {all.x0, y, all.x1, std::min(y + rows_at_once, all.y1)});
  }
}

void SyntheticCamera::Impl::put_before_still(const RowSpans& spans) {
  for (int y = moving.box.y0; y < moving.box.y1; ++y) {
    Light* row = moving.row(y) - moving.box.x0;
    const Light* behind = still.row(y);
    const Span& span = spans.at(y);
    for (int x = span.begin; x < span.end; ++x) row[x] = over(row[x], behind[x]);
  }
}

void SyntheticCamera::Impl::forget(const RowSpans& changed) {
  for (int y = changed.box().y0; y < changed.box().y1; ++y) {
    const Span& span = changed.at(y);
    const auto begin = sensor.place_of(span.begin, y), end = sensor.place_of(span.end, y);
    std::copy(still_levels.begin() + begin, still_levels.begin() + end, levels.begin() + begin);
  }
}

SyntheticCamera::SyntheticCamera(const Apparatus& apparatus, const SyntheticSettings& settings,
                                 std::uint64_t seed)
    : impl_(std::make_unique<Impl>(as_it_is(apparatus, settings.files), settings, seed)) {}
SyntheticCamera::~SyntheticCamera() = default;
SyntheticCamera::SyntheticCamera(SyntheticCamera&&) noexcept = default;
SyntheticCamera& SyntheticCamera::operator=(SyntheticCamera&&) noexcept = default;

// Renders only the reach of hand and effector, extended by twice the blur's extent: once for
// blurred pixels and once for their input.
Image SyntheticCamera::Impl::filmed(const EffectorPath& path, double t_s, std::uint64_t number) {
  const PixelBox box = reached(path, t_s);
  const auto at_px = effector_px(path, t_s);
  if (box.empty()) return sensor.develop(levels, number, at_px, t_s);
  moving.reset(box);
  draw_moving(path, t_s);
  const int reach_px = sensor.reach_px(), needed_px = (2 * reach_px + 1) * fineness;
  const RowSpans drawn = RowSpans::covered(moving);
  const RowSpans changed = drawn.coarse().grown(reach_px, reach_px);
  put_before_still(drawn.grown(needed_px, needed_px));
  sensor.expose(moving, changed, levels);
  Image picture = sensor.develop(levels, number, at_px, t_s);
  forget(changed);
  return picture;
}

namespace {
bool happens(double share, const char* what, std::uint64_t seed, std::uint64_t number) {
  return share > 0 && RandomStream(seed, what, number).uniform() < share;
}
}  // namespace

Image SyntheticCamera::picture(const EffectorPath& board_from_effector, double t_s,
                               std::uint64_t number) {
  Impl& p = *impl_;
  if (!p.last.empty() && happens(p.optics().repeated, "repeated picture", p.seed, number))
    return p.last;
  p.breathe(t_s);
  Image now = p.mixed(p.filmed(board_from_effector, t_s, number));
  if (p.optics().repeated > 0) p.last = now;
  return now;
}

bool SyntheticCamera::drops(std::uint64_t number) const {
  return happens(impl_->optics().dropped, "dropped picture", impl_->seed, number);
}

void SyntheticCamera::restart() {
  impl_->last = {};
  impl_->mean.clear();
}

Image SyntheticCamera::hand_in_picture(const Pose& board_from_effector) {
  Impl& p = *impl_;
  const PixelBox all = coarse_of(p.still.box);
  Image hand(all.width(), all.height(), 1);
  if (!p.settings.hand || !p.draw_effector(board_from_effector, p.still.box)) return hand;
  p.draw_hand(board_from_effector, p.still.box);
  std::vector<float> seen(hand.pixels.size());
  for (int y = 0; y < p.still.box.y1; ++y)
    for (int x = 0; x < p.still.box.x1; ++x) {
      const float before = p.hand_at(p.hand_before, x, y)[3];
      const float behind = p.hand_at(p.hand_behind, x, y)[3] * (1 - p.effector_at(x, y)[3]);
      seen[static_cast<std::size_t>(y / fineness * hand.width + x / fineness)] +=
          (before + (1 - before) * behind) / (fineness * fineness);
    }
  std::ranges::transform(seen, hand.pixels.begin(), [](float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
  });
  return hand;
}

}  // namespace heft
