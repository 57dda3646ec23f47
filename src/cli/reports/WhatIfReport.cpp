#include <fmt/format.h>

#include <array>

#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"

namespace heft::cli {

namespace {
void print_positions(const std::vector<PathDifference>& differences) {
  print(
      "  positions with the change against the log (mm):\n"
      "  {:<13} {:<4} {:>9} {:>11} {:>10} {:>11} {:>10}\n",
      "task", "", "frames", "clone RMS", "clone max", "cubes RMS", "cubes max");
  for (const PathDifference& d : differences)
    print("  {:<13} {:<4} {:>9} {:>11.4f} {:>10.4f} {:>11.4f} {:>10.4f}\n", name_of(d.task),
          d.condition, d.n_pictures, 1e3 * d.clone_rms_m, 1e3 * d.clone_max_m, 1e3 * d.cubes_rms_m,
          1e3 * d.cubes_max_m);
}

std::string both(const std::string& logged, const std::string& would_be) {
  return fmt::format("{:>6} > {:<6}", logged, would_be);
}

std::string millimeters(double logged_m, double would_be_m) {
  return both(fmt::format("{:.2f}", 1e3 * logged_m), fmt::format("{:.2f}", 1e3 * would_be_m));
}

std::string as_grams(double lag_m, const std::optional<double>& g_per_m) {
  return g_per_m ? fmt::format("{:.1f}", *g_per_m * lag_m) : "-";
}

// Cues of cubes of one mass, logged > recomputed.
struct CueColumn {
  const char* title;
  bool in_short;
  std::string (*value)(const PathDifference& trials, const CueDifference& cubes);
};

constexpr std::array cue_columns{
    CueColumn{"pushes", false,
              [](const PathDifference&, const CueDifference& cubes) {
                return both(std::to_string(cubes.logged.n_pushes),
                            std::to_string(cubes.would_be.n_pushes));
              }},
    CueColumn{"lag mm", true,
              [](const PathDifference&, const CueDifference& cubes) {
                return millimeters(cubes.logged.mean_lag_m(), cubes.would_be.mean_lag_m());
              }},
    CueColumn{"largest lag mm", false,
              [](const PathDifference&, const CueDifference& cubes) {
                return millimeters(cubes.logged.largest_lag_m, cubes.would_be.largest_lag_m);
              }},
    CueColumn{"lag as g", true,
              [](const PathDifference& trials, const CueDifference& cubes) {
                return both(as_grams(cubes.logged.mean_lag_m(), trials.logged_g_per_m),
                            as_grams(cubes.would_be.mean_lag_m(), trials.would_be_g_per_m));
              }},
    CueColumn{"path mm", false,
              [](const PathDifference&, const CueDifference& cubes) {
                return millimeters(cubes.logged.mean_path_m(), cubes.would_be.mean_path_m());
              }},
    CueColumn{"end mm", true,
              [](const PathDifference&, const CueDifference& cubes) {
                return millimeters(cubes.logged.mean_end_m(), cubes.would_be.mean_end_m());
              }},
};

// Largest lag of each push, mean over pushes; path of each pushed cube, mean over cubes.
void print_visible_cues(const std::vector<PathDifference>& differences, bool all) {
  print(
      "  visible cues, logged > recomputed: the clone's largest lag in a push, also in\n"
      "  grams if it depends on mass, and how far from its start a pushed cube ended\n"
      "  (means)\n"
      "  {:<13} {:<4} {:>7}",
      "task", "", "cube g");
  for (const CueColumn& column : cue_columns)
    if (all || column.in_short) print(" {:^15}", column.title);
  print("\n");
  for (const PathDifference& trials : differences)
    for (const CueDifference& cubes : trials.cues) {
      const bool is_end = &cubes == &trials.cues.front() || &cubes == &trials.cues.back();
      if (!all && !is_end) continue;
      print("  {:<13} {:<4} {:>7g}", name_of(trials.task), trials.condition, cubes.mass_g);
      for (const CueColumn& column : cue_columns)
        if (all || column.in_short) print(" {}", column.value(trials, cubes));
      print("\n");
    }
  if (!all) print("  All masses and more cues: --tables\n");
}

std::string grams(const std::optional<double>& value_g) {
  return value_g ? fmt::format("{:.1f} g", *value_g) : "none";
}
}  // namespace

void print_paths(const std::vector<PathDifference>& differences, bool tables) {
  print_positions(differences);
  print_visible_cues(differences, tables);
}

void print_rerun(const OtherResponder& other) {
  print("  {:<13} {:<4} {:>20} {:>20}\n", "task", "", "logged, right of n", "would be, right of n");
  for (const OutcomeDifference& o : other.outcomes)
    print("  {:<13} {:<4} {:>20} {:>20}\n", name_of(o.task), o.condition,
          fmt::format("{} of {}", o.n_logged_correct, o.n_logged),
          fmt::format("{} of {}", o.n_would_be_correct, o.n_would_be));
  for (const EstimateDifference& e : other.estimates)
    print("  JND of staircase {:<12} logged {:>9}, would be {:>9}\n", '"' + e.staircase + '"',
          grams(e.logged_g), grams(e.would_be_g));
}

}  // namespace heft::cli
