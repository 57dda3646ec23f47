#include "population/Power.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "analysis/Analysis.h"
#include "base/Parallel.h"
#include "base/Random.h"
#include "base/math/Quantiles.h"
#include "session/Simulation.h"

namespace heft {

namespace {

// The report of one study: its hypotheses, and its estimates except curves over levels, masses or
// trials.
struct StudyFindings {
  std::vector<Hypothesis> hypotheses;
  std::vector<StudyEstimate> estimates;
};

StudyFindings findings_of(const Summary& summary) {
  StudyFindings findings;
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.applies()) findings.hypotheses.push_back(hypothesis);
  for (const StudyEstimate& estimate : summary.estimates)
    if (estimate.participant.empty() && std::ranges::none_of(estimate.by, [](const Coordinate& at) {
          return at.value.has_value();
        }))
      findings.estimates.push_back(estimate);
  return findings;
}

// The log of one study, removed with its companions.
class StudyLog {
 public:
  explicit StudyLog(std::string path) : path_(std::move(path)) { remove(); }
  ~StudyLog() { remove(); }
  StudyLog(const StudyLog&) = delete;
  StudyLog& operator=(const StudyLog&) = delete;
  const std::string& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    for (const char* end : {"", "-wal", "-shm", "-lock"})
      std::filesystem::remove(path_ + end, ignored);
  }
  std::string path_;
};

// The findings of one study at each size. Empty: stopped.
std::vector<StudyFindings> run_study(const PowerRequest& request, int study,
                                     const std::vector<int>& sizes, const std::atomic<bool>& stop) {
  const std::uint64_t seed =
      RandomStream(request.config->seed, "study", static_cast<std::uint64_t>(study)).bits() >> 1;
  const StudyLog log(fmt::format("{}/study-{}.db", request.folder, study));
  SimulationRequest simulation{request.config.with_seed(seed), log.path(), sizes.back()};
  if (simulate(
          simulation, [](int) {}, stop) < sizes.back())
    return {};
  std::vector<StudyFindings> findings;
  for (const int n : sizes) {
    std::vector<std::int64_t> first_n(static_cast<std::size_t>(n));
    std::iota(first_n.begin(), first_n.end(), 1);
    AnalysisOptions options{{log.path()}, first_n, false, "heft power"};
    options.check_models = false;
    findings.push_back(findings_of(analyze(options)));
  }
  return findings;
}

using Findings = std::vector<const StudyFindings*>;

std::vector<HypothesisPower> hypotheses_of(const Findings& studies) {
  std::map<std::string, HypothesisPower> by_name;
  for (const StudyFindings* study : studies)
    for (const Hypothesis& one : study->hypotheses) {
      HypothesisPower& power = by_name[one.name];
      power.name = one.name;
      power.statement = one.statement;
      power.declared = one.declared;
      power.supported.add(one.verdict == HypothesisVerdict::supported);
      power.not_supported.add(one.verdict == HypothesisVerdict::not_supported);
      const bool is_tested = one.verdict != HypothesisVerdict::not_tested;
      power.inconclusive.add(one.verdict == HypothesisVerdict::inconclusive || !is_tested);
      power.is_tested = power.is_tested || is_tested;
    }
  std::vector<HypothesisPower> all;
  for (auto& [name, power] : by_name) {
    power.interval = exact_interval(power.supported.n_hits, power.supported.n_trials);
    all.push_back(power);
  }
  return all;
}

StudyEstimate place_of(const StudyEstimate& estimate) {
  StudyEstimate place;
  place.measure = estimate.measure;
  place.task = estimate.task;
  place.condition = estimate.condition;
  place.reference_g = estimate.reference_g;
  place.by = estimate.by;
  return place;
}

std::string text_of(const std::vector<Coordinate>& coordinates) {
  std::string text;
  for (const Coordinate& one : coordinates) text += fmt::format("{}={} ", one.name, one.text);
  return text;
}

double median_of(const std::vector<double>& values) {
  return quantile(values, 0.5).value_or(0);
}

std::vector<EstimatePrecision> estimates_of(const Findings& studies) {
  using Key =
      std::tuple<std::string_view, std::string, std::string, std::optional<double>, std::string>;
  struct Collected {
    StudyEstimate place;
    const StudyFindings* last = nullptr;
    std::vector<double> values, lows, highs;
    bool has_method = false;  // of its interval, which a count never has
  };
  std::map<Key, std::size_t> index;
  std::vector<Collected> collected;
  for (const StudyFindings* study : studies)
    for (const StudyEstimate& one : study->estimates) {
      const auto [found, is_new] = index.try_emplace(
          {one.measure->name, one.task, one.condition, one.reference_g, text_of(one.by)},
          collected.size());
      if (is_new) collected.push_back({place_of(one), nullptr, {}, {}, {}, false});
      Collected& at = collected[found->second];
      const bool is_first = at.last != study;  // others of the same place are variants
      at.last = study;
      at.has_method = at.has_method || !one.method.empty();
      if (!is_first || !one.value || !one.low || !one.high) continue;
      at.values.push_back(*one.value);
      at.lows.push_back(*one.low);
      at.highs.push_back(*one.high);
    }
  std::vector<EstimatePrecision> all;
  for (const Collected& one : collected) {
    const bool is_count = one.place.measure->unit.empty() && !one.has_method;
    if (one.values.empty() && is_count) continue;
    all.push_back({one.place,
                   {static_cast<int>(one.values.size()), static_cast<int>(studies.size())},
                   median_of(one.values),
                   median_of(one.lows),
                   median_of(one.highs),
                   sample_sd(one.values)});
  }
  return all;
}

}  // namespace

std::optional<Power> power_of(const PowerRequest& request,
                              const std::function<void(double)>& progress,
                              const std::atomic<bool>& stop) {
  const std::set<int> distinct(request.participants.begin(), request.participants.end());
  const std::vector<int> sizes(distinct.begin(), distinct.end());
  std::vector<std::vector<StudyFindings>> studies(static_cast<std::size_t>(request.studies));
  const auto run = [&](int study) {
    auto& findings = studies[static_cast<std::size_t>(study)];
    findings = run_study(request, study, sizes, stop);
    return !findings.empty();
  };
  if (!run_jobs(request.studies, request.jobs, run, progress)) return std::nullopt;
  Power power{request.studies, {}};
  for (std::size_t size = 0; size < sizes.size(); ++size) {
    Findings of_size;
    for (const auto& study : studies) of_size.push_back(&study[size]);
    power.sizes.push_back({sizes[size], hypotheses_of(of_size), estimates_of(of_size)});
  }
  return power;
}

}  // namespace heft
