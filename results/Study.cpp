#include "results/Study.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "analysis/charts/Plot.h"
#include "base/Error.h"
#include "base/Names.h"
#include "base/files/Csv.h"
#include "results/paper/PaperStudy.h"
#include "results/physics/PhysicsStudy.h"
#include "results/pipeline/Chain.h"
#include "results/procedures/ProceduresStudy.h"
#include "results/tracking/TrackingStudy.h"

namespace heft {

namespace {
constexpr auto table = std::to_array<StudyEntry>({
    {"physics", "simulators: error against CPU time, where they fail, input, lag against mass",
     run_physics_study},
    {"tracking", "trackers: error against time, where they fail, filters' jitter against lag",
     run_tracking_study},
    {"effectors", "the shipped effectors over random grips: how many faces they show, how exactly",
     run_effector_study},
    {"paper", "rival models of participants: which give the figures that the paper reports",
     run_paper_study},
    {"procedures", "which procedure finds a threshold in few trials, for 24 kinds of people",
     run_procedures_study},
    {"pipeline", "what each stage of a picture costs, and memory over an hour", run_pipeline_study},
});
}  // namespace

std::span<const StudyEntry> studies() {
  return table;
}

const StudyEntry& study_named(std::string_view name) {
  return entry_named("study", name, studies());
}

namespace {
// The commit of the current folder's checkout, which holds the results.
std::string commit() {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
      popen("git describe --always --dirty --exclude '*' 2>/dev/null", "r"), pclose);
  std::array<char, 64> line{};
  if (!pipe || !fgets(line.data(), line.size(), pipe.get())) return "unknown";
  std::string name = line.data();
  while (!name.empty() && name.back() == '\n') name.pop_back();
  return name;
}

const std::string& this_commit() {
  static const std::string name = commit();
  return name;
}
}  // namespace

std::string provenance(const StudyOptions& options) {
  return provenance(this_commit(), options.command);
}

std::string provenance(std::string_view commit, std::string_view command) {
  return fmt::format("commit {} \u00b7 {}", commit, command);
}

CsvFile::CsvFile(const StudyOptions& options, const std::string& name, std::string_view columns)
    : end_(this_commit() + ',' + cell(options.command)), out_(options.out + '/' + name) {
  if (!out_)
    throw Error(fmt::format("{}/{} can't be written; is the folder yours?", options.out, name));
  out_ << columns << ",commit,command\n";
}

std::string CsvFile::cell(std::string_view text) {
  return csv_cell(text);
}

std::string CsvFile::cell(double value) {
  return std::isnan(value) ? "" : fmt::format("{:.6g}", value);
}

StudyProgress::~StudyProgress() {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
}

void StudyProgress::next(std::string_view what) {
  ++done_;
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K{} of {}: {}", done_, n_, what);
}

void draw(const StudyOptions& options, const std::string& name, const std::string& script) {
  const std::string file = name + ".gnuplot";
  std::ofstream(options.out + '/' + file) << script;
  if (!run_gnuplot(options.out, file))
    fmt::print(stderr, "no {}.svg: gnuplot is not installed\n", name);
  std::filesystem::remove(options.out + '/' + file);
}

}  // namespace heft
