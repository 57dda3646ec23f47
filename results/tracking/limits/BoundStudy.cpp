#include <array>
#include <cmath>

#include "results/tracking/TrackingStudy.h"
#include "results/tracking/limits/Bound.h"

namespace heft {

namespace {
constexpr std::uint64_t seed = 9;

// Mean squares, as they come in.
struct Sums {
  int n = 0, n_plain = 0;
  double bound = 0, ours = 0, plain = 0;
};

BoundResult result_of(const Sums& sums, int width_px, int tags) {
  const auto rms = [](double sum, int n) { return std::sqrt(sum / n); };
  return {width_px,
          tags,
          sums.n,
          rms(sums.bound, sums.n),
          rms(sums.ours, sums.n),
          rms(sums.plain, sums.n_plain),
          static_cast<double>(sums.n_plain) / sums.n};
}

// One camera above the board, grips with one face in view and with two.
class BoundFilm {
 public:
  BoundFilm(int width_px, const StudyOptions& options, CsvFile& csv)
      : width_px_(width_px),
        n_grips_(options.quick ? 4 : 100),
        apparatus_(bench_apparatus(width_px)),
        bound_(apparatus_, settings_),
        camera_(apparatus_, settings_, seed),
        csv_(csv),
        methods_{make_method(our_method(width_px), apparatus_),
                 make_method(plain_method(width_px), apparatus_)} {}

  std::vector<BoundResult> results() {
    for (const Grip grip : {Grip::any, Grip::two_faces})
      for (int i = 0; i < n_grips_; ++i) add(grip, i);
    std::vector<BoundResult> results;
    for (std::size_t tags = 1; tags <= 2; ++tags)
      if (sums_[tags - 1].n > 0)
        results.push_back(result_of(sums_[tags - 1], width_px_, static_cast<int>(tags)));
    return results;
  }

 private:
  void add(Grip grip, int i) {
    const auto number = static_cast<std::uint64_t>(i + (grip == Grip::any ? 0 : n_grips_));
    const Pose truth = random_grip(seed, number, grip);
    const int tags = tags_in_view(apparatus_, settings_.camera_from_board, truth);
    const auto variance_m2 = bound_.tip_variance_m2(truth);
    const Image image = camera_.picture([&](double) { return truth; }, 0, number);
    const auto ours = error_mm(methods_[0], image, truth),
               plain = error_mm(methods_[1], image, truth);
    if (!variance_m2 || !ours || tags < 1) return;
    const double bound_mm = 1e3 * std::sqrt(*variance_m2);
    csv_.row(size_name(width_px_), tags, bound_mm, *ours, or_nan(plain));
    Sums& sums = sums_[tags == 1 ? 0 : 1];
    ++sums.n;
    sums.bound += bound_mm * bound_mm;
    sums.ours += *ours * *ours;
    if (!plain) return;
    ++sums.n_plain;
    sums.plain += *plain * *plain;
  }

  std::optional<double> error_mm(const TrackingMethod& method, const Image& image,
                                 const Pose& truth) const {
    method.reset();
    return error_of(method.track(image, 0), settings_.camera_from_board, truth,
                    tip_of(apparatus_.effector))
        .tip_mm;
  }

  int width_px_, n_grips_;
  Apparatus apparatus_;
  SyntheticSettings settings_;
  TipBound bound_;
  SyntheticCamera camera_;
  CsvFile& csv_;
  std::array<TrackingMethod, 2> methods_;
  std::array<Sums, 2> sums_;
};
}  // namespace

std::vector<BoundResult> study_bound(const StudyOptions& options, StudyProgress& progress) {
  CsvFile csv(options, "bound.csv", "picture,tags_in_view,bound_mm,heft_mm,apriltag_solvepnp_mm");
  std::vector<BoundResult> results;
  for (const int width_px : picture_widths_px) {
    progress.next("what noise allows at " + size_name(width_px));
    const auto more = BoundFilm(width_px, options, csv).results();
    results.insert(results.end(), more.begin(), more.end());
  }
  return results;
}

std::string bound_table(const std::vector<BoundResult>& bounds) {
  std::string text =
      "| picture | tags in view | pictures | bound, mm | heft, mm | over the bound | AprilTag + "
      "solvePnP, mm |\n|---|---|---|---|---|---|---|\n";
  for (const BoundResult& b : bounds)
    text += fmt::format(
        "| {} | {} | {} | {:.2g} | {:.2g} | {:.1f} times | {} |\n", size_name(b.width_px),
        b.tags == 1 ? "1" : "2 and more", b.pictures, b.bound_mm, b.ours_mm, b.ratio(),
        b.plain_found > 0 ? fmt::format("{:.2g} in {:.0f} %", b.plain_mm, 100 * b.plain_found)
                          : "found in none");
  return text;
}

}  // namespace heft
