#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <map>

#include "base/math/Quantiles.h"
#include "physics/auto/Choice.h"
#include "results/physics/PhysicsStudy.h"

namespace heft {

std::vector<PromisedRun> promised_runs(std::uint64_t seed, int n_each) {
  std::vector<PromisedRun> runs;
  const auto& settings = EnumNames<Setting>::names;
  StudyProgress progress(static_cast<int>(settings.size()));
  for (std::size_t s = 0; s < settings.size(); ++s) {
    progress.next(fmt::format("what auto promises, seed {}: {}", seed, settings[s]));
    const auto setting = static_cast<Setting>(s);
    for (int n = 0; n < n_each; ++n) {
      const BenchScene scene = random_hands(setting, seed, n);
      const int poses_hz = poses_hz_of(scene);
      const auto run = [&](std::string_view name, int rate_hz) {
        return run_scene(make_simulator(name), scene, rate_hz, poses_hz, poses_hz);
      };
      const SceneTrack truth = run("boxes", 16 * reference_rate_hz).track;
      for (const KnownError& known : known_errors()) {
        const bool is_push = !known.uneven;
        if (is_push && (setting != Setting::straight || !scene.unique_if_rigid())) continue;
        const int rate_hz = is_push ? poses_hz : static_cast<int>(auto_rate_hz);
        const SceneRun done = run(known.simulator, rate_hz);
        const TrackError error = error_of(done.track, truth, scene);
        const bool ran = done.outcome == RunOutcome::ran;
        runs.push_back({known.simulator, setting, n, done.outcome, error,
                        ran ? times_tolerance(error, scene) : HUGE_VAL});
      }
    }
  }
  return runs;
}

std::string_view PromisedRun::hands() const {
  return has_one_answer(setting) ? "even" : "uneven";
}

namespace {
// What auto_share of all scenes stay within, at a confidence of 95 % (a tolerance limit; Wilks
// 1941); the largest where there are too few scenes for that.
double limit_of(std::vector<double> times) {
  std::ranges::sort(times);
  // So many scenes are expected beyond the limit even if it is too small. Rounded down, 0 at least.
  const boost::math::binomial beyond(static_cast<double>(times.size()), 1 - auto_share);
  const auto n_beyond = static_cast<std::size_t>(boost::math::quantile(beyond, 0.05));
  return times[times.size() - 1 - n_beyond];
}
}  // namespace

void study_promise(const StudyOptions& options) {
  CsvFile csv(options, "promise.csv",
              "seed,simulator,hands,n_scenes,times_tolerance,median_times_tolerance");
  std::map<std::pair<std::string_view, std::string_view>, std::vector<double>> groups;
  for (const PromisedRun& run : promised_runs(options.seed, options.quick ? 1 : 1000))
    groups[{run.simulator, run.hands()}].push_back(run.times_tolerance);
  for (const auto& [group, times] : groups)
    csv.row(fmt::format("{}", options.seed), group.first, group.second,
            static_cast<double>(times.size()), limit_of(times), quantile(times, 0.5).value_or(0));
}

}  // namespace heft
