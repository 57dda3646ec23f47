#include "tracking/SyntheticCamera.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tracking/synthetic/FaceDrawing.h"
#include "tracking/synthetic/FilmedHand.h"
#include "tracking/synthetic/Sensor.h"

namespace heft {

namespace {
using Eigen::Vector3d;

// Renderings this far apart blend into one smear: with a blur of .6 px the ripple is 1e-4 of it.
constexpr double smear_step_px = 1.0;
constexpr double still_px = 0.02;  // less than this over the exposure is no motion
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
  Impl(const Apparatus& apparatus, const SyntheticSettings& with, std::uint64_t seed);

  const Optics& optics() const { return settings.optics; }
  SeenBody seen(const Pose& board_from_effector) const {
    return {settings.camera_from_board, board_from_effector};
  }
  std::vector<std::optional<Pose>> poses_while_open(const EffectorPath& path, double t_s) const;
  int motion_samples(const EffectorPath& path, double t_s) const;
  PixelBox extent(const Pose& pose) const;
  void draw_hand_and_effector(const Pose& pose);
  void draw_effector(const SeenBody& body, const PixelBox& extent);
  PixelBox reached(const EffectorPath& path, double t_s) const;
  void draw_moving(const std::vector<std::optional<Pose>>& poses, const PixelBox& box);
  void draw_moving(const EffectorPath& path, double t_s);
  void put_before_still(const RowSpans& spans);
  void forget(const RowSpans& changed);

  SyntheticSettings settings;
  Lens lens;
  std::vector<PrintedFace> effector;
  FilmedHand hand;
  Sensor sensor;
  LightPicture still;   ///< table and board, sharp
  Levels still_levels;  ///< the same, as the sensor has it
  Levels levels;        ///< the same, between pictures
  AreaRaster raster;
  LightPicture instant;  ///< hand and effector at one moment
  LightPicture moving;   ///< their mean over the exposure, then before the still scene
};

SyntheticCamera::Impl::Impl(const Apparatus& apparatus, const SyntheticSettings& with,
                            std::uint64_t seed)
    : settings(with),
      lens(apparatus.camera),
      effector(printed_effector(apparatus.effector)),
      hand(apparatus.effector.size_m, with.left_hand),
      sensor(with.optics, apparatus.camera.width_px, apparatus.camera.height_px, seed),
      still(still_scene(apparatus.board, with.camera_from_board, lens)) {
  sensor.expose(still, RowSpans::whole(still.box), still_levels);
  levels = still_levels;
}

// As many as the smear is long, so that it has no steps.
int SyntheticCamera::Impl::motion_samples(const EffectorPath& path, double t_s) const {
  const double half_s = settings.optics.exposure_s / 2;
  const auto opens = path(t_s - half_s), closes = path(t_s + half_s);
  if (!opens || !closes) return settings.motion_samples;
  const double move_px = largest_move_px(effector, seen(*opens), seen(*closes), lens);
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

void SyntheticCamera::Impl::draw_hand_and_effector(const Pose& pose) {
  const SeenBody body = seen(pose);
  const auto extent = extent_of(effector, body, lens);
  if (!extent) return;
  if (settings.hand) hand.draw(FilmedHand::Side::before_box, body, lens, instant);
  draw_effector(body, *extent);
  if (settings.hand) hand.draw(FilmedHand::Side::behind_box, body, lens, instant);
}

void SyntheticCamera::Impl::draw_effector(const SeenBody& body, const PixelBox& extent) {
  raster.begin(extent.within(instant.box));
  for (const PrintedFace& face : effector)
    if (is_seen(face, body)) draw_face(face, body, lens, raster);
  raster.draw_behind(instant);
}

// Of every row's exposure, from the first one's to the last one's.
PixelBox SyntheticCamera::Impl::reached(const EffectorPath& path, double t_s) const {
  const int n_times = optics().readout_s > 0 ? 16 : 1;
  PixelBox box;
  for (int i = 0; i < n_times; ++i) {
    const double late_s = n_times > 1 ? optics().readout_s * i / (n_times - 1) : 0;
    for (const auto& pose : poses_while_open(path, t_s + late_s))
      if (pose) box = box.around(extent(*pose));
  }
  const int between_px = n_times > 1 ? 4 : 0;
  return box.empty() ? box : box.grown(2 * sensor.blur_reach_px() + between_px).within(still.box);
}

void SyntheticCamera::Impl::draw_moving(const std::vector<std::optional<Pose>>& poses,
                                        const PixelBox& box) {
  const float weight = 1 / static_cast<float>(poses.size());
  for (const std::optional<Pose>& pose : poses) {
    if (!pose) continue;
    instant.reset(box);
    draw_hand_and_effector(*pose);
    const RowSpans drawn = RowSpans::covered(instant);
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = drawn.at(y).begin; x < drawn.at(y).end; ++x)
        moving.row(y)[x - box.x0] += weight * instant.row(y)[x - box.x0];
  }
}

// A rolling shutter's rows two by two: at 0.5 m/s, over 25 ms, their edges have steps of a
// twentieth of a pixel.
void SyntheticCamera::Impl::draw_moving(const EffectorPath& path, double t_s) {
  constexpr int rows_at_once = 2;
  const PixelBox all = moving.box;
  if (!(optics().readout_s > 0)) return draw_moving(poses_while_open(path, t_s), all);
  const double row_s = optics().readout_s / lens.camera().height_px;
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
    : impl_(std::make_unique<Impl>(apparatus, settings, seed)) {}
SyntheticCamera::~SyntheticCamera() = default;
SyntheticCamera::SyntheticCamera(SyntheticCamera&&) noexcept = default;
SyntheticCamera& SyntheticCamera::operator=(SyntheticCamera&&) noexcept = default;

// Only what hand and effector reach is rendered; the blur reaches a little farther, and needs to
// know as much again.
Image SyntheticCamera::picture(const EffectorPath& board_from_effector, double t_s,
                               std::uint64_t number) {
  Impl& p = *impl_;
  const PixelBox reached = p.reached(board_from_effector, t_s);
  if (reached.empty()) return p.sensor.develop(p.levels, number);
  const int blur_px = p.sensor.blur_reach_px();
  p.moving.reset(reached);
  p.draw_moving(board_from_effector, t_s);
  const RowSpans drawn = RowSpans::covered(p.moving), changed = drawn.grown(blur_px, blur_px);
  p.put_before_still(drawn.grown(2 * blur_px, 2 * blur_px));
  p.sensor.expose(p.moving, changed, p.levels);
  Image picture = p.sensor.develop(p.levels, number);
  p.forget(changed);
  return picture;
}

// What of a pixel is covered after the hand's parts are drawn and was not before.
Image SyntheticCamera::hand_in_picture(const Pose& board_from_effector) {
  Impl& p = *impl_;
  Image hand(p.lens.camera().width_px, p.lens.camera().height_px, 1);
  const SeenBody body = p.seen(board_from_effector);
  const auto extent = extent_of(p.effector, body, p.lens);
  const PixelBox box = p.extent(board_from_effector).within(p.still.box);
  if (!p.settings.hand || !extent || box.empty()) return hand;
  p.instant.reset(box);
  p.hand.draw(FilmedHand::Side::before_box, body, p.lens, p.instant);
  const std::vector<Light> before = p.instant.light;
  p.draw_effector(body, *extent);
  const std::vector<Light> both = p.instant.light;
  p.hand.draw(FilmedHand::Side::behind_box, body, p.lens, p.instant);
  std::size_t i = 0;
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x, ++i) {
      const float covered = before[i][3] + p.instant.light[i][3] - both[i][3];
      hand.pixels[static_cast<std::size_t>(y * hand.width + x)] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(covered, 0.0F, 1.0F)));
    }
  return hand;
}

}  // namespace heft
