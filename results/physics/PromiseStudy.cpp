#include <algorithm>
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
      BenchScene scene = random_scene(setting, seed, n);
      if (n % 2 == 1) scene.scene.contact_compliance_m_per_n = random_compliance_m_per_n;
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
        PromisedRun& one =
            runs.emplace_back(PromisedRun{known.simulator, setting, n, done.outcome});
        one.error = error_of(done.track, truth, scene);
        if (scene.scene.displacement) one.error.lag_error_g = 0;  // the technique has no lag
      }
    }
  }
  return runs;
}

std::string_view PromisedRun::hands() const {
  return has_one_answer(setting) ? "even" : "uneven";
}

std::string PromisedRun::group() const {
  return fmt::format("{}, {}", simulator, hands());
}

bool PromisedRun::is_within(const Tolerance& tolerance) const {
  return outcome == RunOutcome::ran && error.clone_rms_mm <= 1e3 * tolerance.clone_rms_m &&
         std::abs(error.lag_error_g) <= tolerance.lag_g &&
         error.cubes_rms_mm <= 1e3 * tolerance.cubes_rms_m &&
         error.clone_turn_rms_deg <= tolerance.turn_rms_rad * 180 / M_PI;
}

void study_promise(const StudyOptions& options) {
  // Of each of four errors; scenes that exceed one usually exceed others, too.
  constexpr double nearly_all = 0.999;
  CsvFile csv(
      options, "promise.csv",
      "seed,simulator,hands,n_scenes,clone_rms_mm,lag_g,cubes_rms_mm,turn_deg,within_all_percent");
  std::map<std::string, std::vector<PromisedRun>> groups;
  for (PromisedRun& run : promised_runs(options.seed, options.quick ? 1 : 1000))
    groups[run.group()].push_back(std::move(run));
  for (const auto& [group, runs] : groups) {
    const auto most = [&](double TrackError::*error) {
      std::vector<double> errors;
      for (const PromisedRun& run : runs) errors.push_back(std::abs(run.error.*error));
      return quantile(errors, nearly_all).value_or(0);
    };
    const double clone_mm = most(&TrackError::clone_rms_mm), lag_g = most(&TrackError::lag_error_g),
                 cubes_mm = most(&TrackError::cubes_rms_mm),
                 turn_deg = most(&TrackError::clone_turn_rms_deg);
    const Tolerance promised{.clone_rms_m = 1e-3 * clone_mm,
                             .lag_g = lag_g,
                             .cubes_rms_m = 1e-3 * cubes_mm,
                             .turn_rms_rad = turn_deg * M_PI / 180};
    const auto n_within = std::ranges::count_if(
        runs, [&](const PromisedRun& run) { return run.is_within(promised); });
    csv.row(fmt::format("{}", options.seed), runs.front().simulator, runs.front().hands(),
            static_cast<double>(runs.size()), clone_mm, lag_g, cubes_mm, turn_deg,
            100 * static_cast<double>(n_within) / static_cast<double>(runs.size()));
  }
}

}  // namespace heft
