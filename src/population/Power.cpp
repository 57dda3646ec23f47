#include "population/Power.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>
#include <tuple>

#include "base/Random.h"
#include "base/math/Quantiles.h"
#include "session/Simulation.h"

namespace heft {

namespace {

// What one study's report says: its hypotheses, and its estimates except curves over levels, masses
// or trials.
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
    findings.push_back(findings_of(analyze(options)));
  }
  return findings;
}

// Distributes studies over threads and keeps their findings in order.
class Studies {
 public:
  Studies(const PowerRequest& request, const std::vector<int>& sizes, const std::atomic<bool>& stop)
      : request_(request),
        sizes_(sizes),
        stop_(stop),
        found_(static_cast<std::size_t>(request.studies)) {}

  // @return whether all were run
  bool run(const std::function<void(double)>& progress) {
    std::vector<std::jthread> threads;
    for (int i = 0; i < request_.jobs; ++i) threads.emplace_back([this] { work(); });
    std::unique_lock lock(mutex_);
    for (int seen = -1; n_done_ < request_.studies && !error_ && !stopped_;) {
      if (seen != n_done_) progress(static_cast<double>(n_done_) / request_.studies);
      seen = n_done_;
      changed_.wait(lock);
    }
    lock.unlock();
    threads.clear();
    if (error_) std::rethrow_exception(error_);
    return !stopped_;
  }

  const std::vector<std::vector<StudyFindings>>& found() const { return found_; }

 private:
  void work() {
    for (;;) {
      int study = 0;
      {
        const std::lock_guard lock(mutex_);
        if (error_ || stopped_ || next_ == request_.studies) return;
        study = next_++;
      }
      try {
        auto findings = run_study(request_, study, sizes_, stop_);
        const std::lock_guard lock(mutex_);
        stopped_ = stopped_ || findings.empty();
        found_[static_cast<std::size_t>(study)] = std::move(findings);
        ++n_done_;
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
      changed_.notify_all();
    }
  }

  const PowerRequest& request_;
  const std::vector<int>& sizes_;
  const std::atomic<bool>& stop_;
  std::vector<std::vector<StudyFindings>> found_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr error_;
  int next_ = 0, n_done_ = 0;
  bool stopped_ = false;
};

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
      power.inconclusive.add(one.verdict == HypothesisVerdict::inconclusive);
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
  };
  std::map<Key, std::size_t> index;
  std::vector<Collected> collected;
  for (const StudyFindings* study : studies)
    for (const StudyEstimate& one : study->estimates) {
      const auto [found, is_new] = index.try_emplace(
          {one.measure->name, one.task, one.condition, one.reference_g, text_of(one.by)},
          collected.size());
      if (is_new) collected.push_back({place_of(one), nullptr, {}, {}, {}});
      Collected& at = collected[found->second];
      const bool is_first = at.last != study;  // others of the same place are variants
      at.last = study;
      if (!is_first || !one.value || !one.low || !one.high) continue;
      at.values.push_back(*one.value);
      at.lows.push_back(*one.low);
      at.highs.push_back(*one.high);
    }
  std::vector<EstimatePrecision> all;
  for (const Collected& one : collected) {
    if (one.values.empty() && one.place.measure->unit.empty()) continue;  // a count
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
  Studies studies(request, sizes, stop);
  if (!studies.run(progress)) return std::nullopt;
  Power power{request.studies, {}};
  for (std::size_t size = 0; size < sizes.size(); ++size) {
    Findings of_size;
    for (const auto& study : studies.found()) of_size.push_back(&study[size]);
    power.sizes.push_back({sizes[size], hypotheses_of(of_size), estimates_of(of_size)});
  }
  return power;
}

}  // namespace heft
