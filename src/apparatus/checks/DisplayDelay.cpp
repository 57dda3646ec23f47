// How late the participant's display shows a frame: a patch changes between black and white at
// random moments, and the pictures of a camera that looks at it show when.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "apparatus/checks/ApparatusCheck.h"
#include "base/Clock.h"
#include "base/Error.h"
#include "base/Random.h"
#include "base/math/Quantiles.h"

namespace heft {

namespace {
constexpr double longest_delay_s = 0.3, random_s = 0.1, learning_s = 0.5;
constexpr double least_change = 0.03;  // of light, 1 being white
constexpr double share_of_largest = 0.5;
constexpr double expected_s = 0.05;
constexpr int n_learned = 3;  // changes to each color

struct SeenLight {
  double capture_s, arrival_s;
  std::vector<double> blocks;
};

std::vector<SeenLight> watch(Camera& camera, double until_s) {
  std::vector<SeenLight> seen;
  for (double left_s; (left_s = until_s - monotonic_s()) > 0;)
    if (const auto picture = camera.next(left_s))
      seen.push_back({picture->capture_s, monotonic_s(), light_of_blocks(picture->image)});
  return seen;
}

// The blocks of the picture that show the patch, and their light in both states.
class PatchInPicture {
 public:
  PatchInPicture(const std::vector<double>& black, const std::vector<double>& white)
      : black_(black), white_(white) {
    double largest = least_change;
    for (std::size_t i = 0; i < black.size(); ++i) largest = std::max(largest, white[i] - black[i]);
    for (std::size_t i = 0; i < black.size(); ++i)
      if (white[i] - black[i] > share_of_largest * largest) blocks_.push_back(i);
    if (blocks_.empty())
      throw Error(
          "the camera sees no patch change: point it at the lower corner of the participant's "
          "display, so that the patch is at least 30 pixels wide, and dim the room");
  }

  /// 0 black, 1 white.
  double state(const std::vector<double>& blocks) const {
    double sum = 0, all = 0;
    for (const std::size_t i : blocks_) {
      sum += blocks[i] - black_[i];
      all += white_[i] - black_[i];
    }
    return sum / all;
  }

 private:
  std::vector<double> black_, white_;
  std::vector<std::size_t> blocks_;
};

// Light of the blocks in the last picture before the next change.
std::vector<double> settled(Camera& camera) {
  const std::vector<SeenLight> seen = watch(camera, monotonic_s() + learning_s);
  if (seen.size() < 2)
    throw Error("the camera delivers no pictures of the display; check its cable");
  return seen.back().blocks;
}

std::vector<double> mean_of(const std::vector<std::vector<double>>& all) {
  std::vector<double> mean(all.front().size(), 0);
  for (const std::vector<double>& one : all)
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += one[i] / static_cast<double>(all.size());
  return mean;
}

double mean_s(const std::vector<double>& values_s) {
  return std::accumulate(values_s.begin(), values_s.end(), 0.0) /
         static_cast<double>(values_s.size());
}

double quantile_ms(const std::vector<double>& values_s, double fraction) {
  return 1e3 * quantile(values_s, fraction).value_or(0);
}
}  // namespace

double DisplayDelay::mean_light_s() const {
  return light_s.empty() ? 0 : mean_s(light_s);
}

std::map<std::string, double> DisplayDelay::figures_ms() const {
  return {{"light_ms", 1e3 * mean_light_s()},
          {"picture_ms", quantile_ms(picture_s, 0.5)},
          {"picture_p5_ms", quantile_ms(picture_s, 0.05)},
          {"picture_p95_ms", quantile_ms(picture_s, 0.95)}};
}

DisplayDelay measure_display_delay(Camera& camera, const std::function<double()>& present,
                                   int n_changes) {
  std::vector<std::vector<double>> first, second;
  for (int i = 0; i < n_learned; ++i) {
    present();
    first.push_back(settled(camera));
    present();
    second.push_back(settled(camera));
  }
  // The brighter of the two states is white.
  const std::vector<double> one = mean_of(first), other = mean_of(second);
  const double brighter = std::accumulate(one.begin(), one.end(), 0.0) -
                          std::accumulate(other.begin(), other.end(), 0.0);
  bool to_white = brighter > 0;
  const PatchInPicture patch(to_white ? other : one, to_white ? one : other);
  DisplayDelay delay;
  std::vector<double> gaps_s;
  RandomStream phase(1, "patch");  // relative to the camera's pictures
  std::optional<SeenLight> before;
  for (int i = 0; i < n_changes; ++i, to_white = !to_white) {
    const double presented_s = present();
    bool was_seen = false;
    for (SeenLight& seen :
         watch(camera, presented_s + longest_delay_s + phase.uniform() * random_s)) {
      const bool shows_it = (patch.state(seen.blocks) > 0.5) == to_white;
      if (before) gaps_s.push_back(seen.capture_s - before->capture_s);
      if (shows_it && !was_seen && before) {
        was_seen = true;
        delay.light_s.push_back((before->capture_s + seen.capture_s) / 2 - presented_s);
        delay.picture_s.push_back(seen.arrival_s - presented_s);
      }
      before = std::move(seen);
    }
    if (!was_seen) ++delay.n_missed;
  }
  delay.between_pictures_s = quantile(gaps_s, 0.5).value_or(0);
  return delay;
}

CheckResult delay_verdict(const DisplayDelay& delay) {
  constexpr const char* name = "display delay";
  const std::size_t n = delay.light_s.size();
  if (n < static_cast<std::size_t>(delay.n_missed) || n == 0)
    return {CheckVerdict::failed, name,
            fmt::format("not measured: {} of {} changes of the patch were seen; keep camera and "
                        "display still",
                        n, n + static_cast<std::size_t>(delay.n_missed))};
  const std::string figure = fmt::format(
      "light {:.0f} ms after a frame is presented (expected {:.0f} ms at most); a picture of it "
      "arrives after {:.0f} ms (5 %: {:.0f}, 95 %: {:.0f}); {} changes seen, {} missed, pictures "
      "each {:.0f} ms",
      1e3 * delay.mean_light_s(), 1e3 * expected_s, quantile_ms(delay.picture_s, 0.5),
      quantile_ms(delay.picture_s, 0.05), quantile_ms(delay.picture_s, 0.95), n, delay.n_missed,
      1e3 * delay.between_pictures_s);
  if (1e3 * delay.mean_light_s() <= 1e3 * expected_s) return {CheckVerdict::ok, name, figure};
  return {CheckVerdict::warning, name,
          figure +
              "; choose the display's game mode, its native resolution and highest refresh "
              "rate, and leave the desktop's compositor out (full screen)"};
}

}  // namespace heft
