#include "tracking/Tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Clock.h"
#include "base/Error.h"
#include "base/Pose.h"
#include "base/math/Quantiles.h"
#include "tracking/calibration/Response.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/pose/OwnTags.h"
#include "tracking/pose/RollingShutter.h"

namespace heft {

namespace {
constexpr double usual_blur_px = 0.65;
constexpr double still_m_s = 0.1, still_rad_s = 1;
constexpr double out_of_focus_px = 1;
constexpr double smeared = 1.15;  // relative to the board's blur
constexpr int board_edge_pixels = 120, effector_edge_pixels = 500;
constexpr BiasPrior unknown_bias{0, 0.1};
// Limit of the accuracy of the board's edge bias, because its print and the lens's blur differ
// slightly from the model of edges.
constexpr double least_bias_sd_px = 0.006;
// The effector's edges have another light and slant than the board's.
constexpr double bias_differs_px = 0.005, bias_differs_relative = 0.15;
constexpr int tags_for_bias = 4, tags_for_focus = 8;

// After this many pictures without the effector it is out of view, and only half of each picture is
// searched for it.
constexpr int pictures_searched_whole = 3;
// Without a board, one picture in this many is searched for it thoroughly, which takes several
// times as long.
constexpr int pictures_without_a_close_search = 4;

// In one picture of this many, a quarter is searched for second prints of tags.
constexpr int pictures_between_looks = 16;

// Quality of a pose whose tags are seen twice, here and where they were in a lost picture.
constexpr double doubled_quality = 0.25;
// ... and of a moving one under a rolling shutter, before its velocity is known.
constexpr double sheared_quality = 0.25;

// Tags are read again if the pose from edges alone is less certain, for example with a slanted tag
// half under fingers.
constexpr double sure_quality = 0.5;

// Transfers the board's edge bias to the effector. A bias exists if the camera's tone curve is not
// sRGB. Most cameras' is, and then the board's estimated bias is noise, which would move a single
// tag by tenths of a millimeter in depth.
BiasPrior bias_of_effector(const BodyFit& board) {
  if (board.n_tags < tags_for_bias) return unknown_bias;
  const double sd_px = std::hypot(board.bias_sd_px, least_bias_sd_px);
  const double mean_px = board.bias_px * shrinkage_factor(board.bias_px / sd_px);
  return {mean_px, bias_differs_px + bias_differs_relative * std::abs(mean_px)};
}

void require_own_tags(const MarkerBody& board, const MarkerBody& effector) {
  if (board.tags.empty()) throw Error("the board has no tags, so the table cannot be located");
  if (board.family != effector.family) return;
  for (const Tag& tag : effector.tags)
    if (std::ranges::find(board.tags, tag.id, &Tag::id) != board.tags.end())
      throw Error(
          fmt::format("tag {} of {} is on the board and on the effector; give the effector "
                      "different tags",
                      tag.id, board.family));
}
}  // namespace

Tracker::Tracker(const Apparatus& apparatus, const TrackerSettings& settings)
    : calibrated_(apparatus.camera),
      camera_(apparatus.camera),
      settings_(settings),
      board_(camera_, apparatus.board, settings,
             {usual_blur_px, board_edge_pixels, 0, ToneCurve(), settings.remove_bias}),
      effector_(camera_, apparatus.effector, settings, {usual_blur_px, effector_edge_pixels}),
      board_of_file_(apparatus.board),
      tone_(response_of(camera_).bend()) {
  require_own_tags(apparatus.board, apparatus.effector);
  const double decimate = settings.decimate > 0     ? settings.decimate
                          : camera_.width_px <= 800 ? 1
                                                    : 1.5;
  detectors_.emplace_back(apparatus.board.family, decimate);
  if (has_effector() && apparatus.effector.family != apparatus.board.family)
    detectors_.emplace_back(apparatus.effector.family, decimate);
}

std::vector<DetectedTag> Tracker::detect(TagDetector& detector, const Region& region,
                                         EdgeSearch search) {
  const double start_s = monotonic_s();
  std::vector<DetectedTag> tags = detector.detect(gray_, region, search);
  std::ranges::stable_sort(tags, {}, &DetectedTag::id);
  result_.times.detect_s += monotonic_s() - start_s;
  return tags;
}

// In the whole picture, once per picture.
const std::vector<DetectedTag>& Tracker::all_board_tags() {
  if (!board_family_tags_) board_family_tags_ = detect(detectors_.front(), whole(gray_));
  return *board_family_tags_;
}

std::vector<DetectedTag> Tracker::all_effector_tags() {
  if (detectors_.size() == 1 && board_family_tags_) return *board_family_tags_;
  if (n_unseen_ < pictures_searched_whole || !settings_.region_of_interest)
    return detectors_.size() == 1 ? all_board_tags() : detect(detectors_.back(), whole(gray_));
  return detect(detectors_.back(), half_of(gray_, n_unseen_ % 2 == 0));
}

std::optional<BodyFit> Tracker::find_board() {
  if (settings_.region_of_interest && settings_.refine_edges && last_board_) {
    const int least_tags = std::max(1, (last_n_board_tags_ + 1) / 2);
    const auto fit =
        board_.find_again(gray_, *last_board_, {.tags = least_tags}, unknown_bias, result_.times);
    // A single tag must be read to be certain.
    if (fit && fit->n_tags > 1) return fit;
  }
  const auto fit = board_.find(gray_, all_board_tags(), {last_board_, unknown_bias}, result_.times);
  if (fit) return fit;
  // Tracking needs the board, so that an occasional thorough search of a shadowed one is worth its
  // time.
  if (n_without_board_ % pictures_without_a_close_search != 0) return std::nullopt;
  board_family_tags_ = detect(detectors_.front(), whole(gray_), EdgeSearch::everywhere);
  return board_.find(gray_, *board_family_tags_, {last_board_, unknown_bias}, result_.times);
}

void Tracker::expect_picture() {
  for (BodyFinder* finder : {&board_, &effector_}) finder->expect(result_.noise, tone_.curve());
}

// The board's edges are measured again with tags of another size.
std::optional<BodyFit> Tracker::learn_tag_size(std::optional<BodyFit> board) {
  if (!board || !tag_size_.is_open() || !settings_.refine_edges || !settings_.remove_bias)
    return board;
  tag_size_.try_picture();
  const auto seen = board_.cells(gray_, *board);
  if (!seen || !tag_size_.learn(*seen)) return board;
  board_.resize(with_scaled_tags(board_of_file_, 1 + tag_size_.excess()));
  tone_ = ToneLearner(response_of(calibrated_).bend());
  expect_picture();
  const auto again = board_.find_again(gray_, board->camera_from_body, {.tags = tags_for_bias},
                                       unknown_bias, result_.times);
  return again ? again : board;
}

// Repeats the measurement of the board's edges until the learned tone curve no longer moves them.
std::optional<BodyFit> Tracker::learn_tone(std::optional<BodyFit> board) {
  constexpr int most_rounds = 4;
  for (int round = 0; board && round < most_rounds; ++round) {
    if (board->n_tags < tags_for_bias || !settings_.remove_bias) break;
    const bool moves = tone_.learn(board_.tone(), board->bias_px, board->bias_sd_px);
    expect_picture();
    if (!moves) break;
    const auto again = board_.find_again(gray_, board->camera_from_body, {.tags = tags_for_bias},
                                         unknown_bias, result_.times);
    if (!again) break;
    board = again;
  }
  tone_.next_picture();
  return board;
}

void Tracker::refocus() {
  camera_ = calibrated_;
  camera_.fx_px *= focus_.scale();
  camera_.fy_px *= focus_.scale();
  for (BodyFinder* finder : {&board_, &effector_}) finder->refocus(camera_);
}

// The board's perspective gives the focal length. Its edges are measured again with a changed one.
std::optional<BodyFit> Tracker::learn_focus(std::optional<BodyFit> board, double t_s) {
  if (!board || board->n_tags < tags_for_focus || !settings_.refine_edges) return board;
  if (!focus_.learn(board_.focal_error(*board, unknown_bias), t_s)) return board;
  refocus();
  const auto again = board_.find_again(gray_, board->camera_from_body, {.tags = tags_for_bias},
                                       unknown_bias, result_.times);
  return again ? again : board;
}

std::optional<BodyFit> Tracker::find_effector(const BodyFit& seen_board, double t_s) {
  const BiasPrior prior = bias_of_effector(seen_board);
  BodyFinder::Known known{{}, prior, seen_board.camera_from_body};
  const auto expected_by = [&](const Velocity& by) {
    return normalized(seen_board.camera_from_body * seen_->expected_at(t_s + seen_->own_row_s, by));
  };
  std::optional<Pose>& expected = known.expected;
  if (seen_ && seen_->is_recent_at(t_s)) expected = expected_by(seen_->velocity);
  if (settings_.region_of_interest && expected && !board_family_tags_) {
    // A continued motion is found by edges; cells confirm that they are its tags.
    if (settings_.refine_edges && n_unseen_ == 0) {
      const auto fit =
          effector_.find_again(gray_, expected_by(seen_->next),
                               {.still = false, .quality = sure_quality}, prior, result_.times);
      if (fit) return unrolled(*fit, seen_board, prior, t_s);
    }
    const Region region = effector_.region_around(*expected);
    const auto fit = effector_.find(gray_, detect(detectors_.back(), region), known, result_.times);
    if (fit) return unrolled(*fit, seen_board, prior, t_s);
  }
  auto fit = effector_.find(gray_, all_effector_tags(), known, result_.times);
  if (!fit && board_.blur_px().mean() > out_of_focus_px)
    fit = effector_.find(gray_, detect(detectors_.back(), whole(gray_), EdgeSearch::sharpened),
                         known, result_.times);
  if (!fit) return fit;
  return unrolled(*fit, seen_board, prior, t_s);
}

// The cells of a moving effector are smeared along its path. The board in the same picture gives
// the blur without motion.
std::optional<Smear> Tracker::smear(const Pose& board_from_effector, const BodyFit& seen_board,
                                    double t_s) const {
  if (!seen_ || !(t_s > seen_->t_s)) return std::nullopt;
  const Velocity mean =
      mean_velocity(seen_->board_from_effector, board_from_effector, t_s - seen_->t_s);
  const double still_px = board_.blur_px().mean();
  const bool moves = mean.linear_m_s.norm() > still_m_s || mean.angular_rad_s.norm() > still_rad_s;
  if (!moves || !(still_px > 0) || effector_.blur_px().maxCoeff() < smeared * still_px)
    return std::nullopt;
  const Eigen::Quaterniond& turn = seen_board.camera_from_body.orientation;
  return Smear{{turn * mean.linear_m_s, turn * mean.angular_rad_s}, still_px};
}

// Corrects for rows read at different times, by the velocity since the last picture, extrapolated
// to this one. Without a velocity the pose is a mean over the rows. Poses of one moment are aligned
// cell by cell.
BodyFit Tracker::unrolled(BodyFit fit, const BodyFit& seen_board, const BiasPrior& prior,
                          double t_s) {
  n_intervals_ = 1;
  const auto in_board = [&] {
    return normalized(seen_board.camera_from_body.inverse() * fit.camera_from_body);
  };
  if (!(camera_.readout_s > 0))
    return effector_.aligned(gray_, fit, prior, smear(in_board(), seen_board, t_s), {},
                             result_.times);
  const double own_s = t_s + own_row_s(camera_, fit.camera_from_body);
  const bool continues = seen_ && own_s > seen_->t_s && seen_->could_be_at(in_board(), own_s);
  if (continues) {
    const Velocity velocity = unroll(fit, seen_board, prior, t_s);
    fit = effector_.aligned(gray_, fit, prior, smear(in_board(), seen_board, t_s), velocity,
                            result_.times);
    // The first pose, from which the velocity comes, is itself a mean over rows.
    if (seen_->n_poses > 1 || velocity.linear_m_s.norm() < still_m_s) return fit;
  }
  fit.quality = std::min(fit.quality, sheared_quality);
  return fit;
}

// Files without times do not show lost pictures. A velocity that has changed suddenly may be
// that of two or three intervals, which the shear of the rows decides.
// @return the velocity of the body's origin, in the camera's frame
Velocity Tracker::unroll(BodyFit& fit, const BodyFit& seen_board, const BiasPrior& prior,
                         double t_s) {
  constexpr int rounds = 2, most_intervals = 3;
  constexpr double sudden = 1.4, clearly_better = 0.7;
  const Eigen::Quaterniond& turn = seen_board.camera_from_body.orientation;
  const auto solved = [&](int n_intervals) {
    std::pair<BodyFit, Velocity> best{fit, {}};
    for (int round = 0; round < rounds; ++round) {
      const Pose& camera_from_body = best.first.camera_from_body;
      const Pose pose = normalized(seen_board.camera_from_body.inverse() * camera_from_body);
      const double dt_s = t_s + own_row_s(camera_, camera_from_body) - seen_->t_s;
      const Velocity now = seen_->carried_on(
          mean_velocity(seen_->board_from_effector, pose, n_intervals * dt_s), 0.5);
      best.second = {turn * now.linear_m_s, turn * now.angular_rad_s};
      best.first = effector_.solve_moving(best.first, best.second, prior, result_.times);
    }
    return best;
  };
  auto best = solved(1);
  const double speed = best.second.linear_m_s.norm();
  if (seen_->n_poses > 1 && speed > still_m_s && speed > sudden * seen_->velocity.linear_m_s.norm())
    for (int n = 2; n <= most_intervals; ++n)
      if (auto other = solved(n); other.first.cost < clearly_better * best.first.cost) {
        best = std::move(other);
        n_intervals_ = n;
      }
  fit = best.first;
  return best.second;
}

void Tracker::take_board(const std::optional<BodyFit>& fit) {
  last_board_.reset();
  n_without_board_ = fit ? 0 : n_without_board_ + 1;
  if (!fit) return;
  last_board_ = result_.camera_from_board = fit->camera_from_body;
  last_n_board_tags_ = result_.n_board_tags = fit->n_tags;
  result_.board_reprojection_px = fit->rms_px;
  result_.edge_bias_px = fit->bias_px;
  result_.blur_px = board_.blur_px().mean();
  if (!has_effector()) result_.quality = fit->quality;
}

void Tracker::take_effector(const BodyFit& fit, double t_s) {
  const Pose pose = normalized(result_.camera_from_board->inverse() * fit.camera_from_body);
  const double own_s = own_row_s(camera_, fit.camera_from_body);
  result_.effector_t_s = t_s + own_s;
  const double then_s = result_.effector_t_s;
  result_.jump = !seen_ || !seen_->could_be_at(pose, then_s);
  n_unseen_ = 0;
  const bool moves_on = !result_.jump && then_s > seen_->t_s;
  seen_ = moves_on ? seen_->moved_to(then_s, own_s, pose, n_intervals_)
                   : SeenEffector{then_s, own_s, pose};
  result_.board_from_effector = pose;
  result_.n_effector_tags = fit.n_tags;
  result_.n_effector_faces = fit.n_faces;
  result_.effector_reprojection_px = fit.rms_px;
  const bool is_doubled = mix_.leaves_ghost() && seen_->velocity.linear_m_s.norm() > still_m_s;
  result_.quality = fit.quality * (is_doubled ? doubled_quality : 1);
}

int Tracker::doubles_in(const Region& part, const std::optional<BodyFit>& effector) {
  const auto tags = board_family_tags_ ? *board_family_tags_ : detect(detectors_.front(), part);
  int n = n_elsewhere(tags, part, camera_, board_.body(), *result_.camera_from_board);
  if (effector)
    n += n_elsewhere(detectors_.size() == 1 ? tags : detect(detectors_.back(), part), part, camera_,
                     effector_.body(), effector->camera_from_body);
  return n;
}

// While both bodies are followed, the rest of the picture is searched only here.
void Tracker::look_for_doubles(const std::optional<BodyFit>& effector) {
  const bool is_due = !board_family_tags_ && ++n_followed_ % pictures_between_looks == 0;
  const int next = n_followed_ / pictures_between_looks % 4;
  for (int part = 0; part < 4; ++part)
    if (board_family_tags_ || (is_due && part == next))
      doubles_[static_cast<std::size_t>(part)] = doubles_in(quarter_of(gray_, part), effector);
  result_.n_foreign_tags = std::max(result_.n_foreign_tags, std::ranges::max(doubles_));
}

TrackedPicture Tracker::repeated() {
  result_.repeated = true;
  result_.jump = false;
  result_.times = {};
  return result_;
}

TrackedPicture Tracker::track(const Image& image, double t_s) {
  if (image.width != camera_.width_px || image.height != camera_.height_px || image.empty())
    throw Error(fmt::format(
        "the picture has {} x {} pixels, but the camera was calibrated for {} x {}: calibrate it "
        "at the size that sessions use",
        image.width, image.height, camera_.width_px, camera_.height_px));
  Image seen = gray_of(image);
  const double seen_noise = noise_of(seen);
  seen = mix_.cleared(std::move(seen), t_s, seen_noise);
  if (mix_.repeats()) return repeated();
  gray_ = std::move(seen);
  board_family_tags_.reset();
  result_ = {};
  result_.last_picture = mix_.share();
  result_.noise = mix_.share() > 0 ? noise_of(gray_) : seen_noise;
  expect_picture();
  result_.effector_t_s = t_s;
  auto board = learn_focus(learn_tone(learn_tag_size(find_board())), t_s);
  result_.focal_length_scale = focus_.scale();
  result_.board_tag_excess = tag_size_.excess();
  result_.n_foreign_tags = board_.n_foreign();
  if (board && !has_effector() && board->quality < least_pose_quality) board.reset();
  take_board(board);
  std::optional<BodyFit> effector;
  if (board && has_effector()) {
    effector = find_effector(*board, t_s);
    result_.n_foreign_tags += effector_.n_foreign();
    if (effector && effector->quality >= least_pose_quality)
      take_effector(*effector, t_s);
    else
      ++n_unseen_;
  }
  if (board) look_for_doubles(effector);
  return result_;
}

void Tracker::reset() {
  last_board_.reset();
  seen_.reset();
  n_unseen_ = n_without_board_ = n_followed_ = 0;
  doubles_.fill(0);
  mix_.reset();
}

}  // namespace heft
