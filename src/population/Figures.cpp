#include "population/Figures.h"

#include <fmt/format.h>

#include <map>

#include "apparatus/SessionClock.h"
#include "apparatus/sources/PictureSource.h"
#include "engine/Engine.h"
#include "inference/Proportion.h"
#include "inference/Statistics.h"
#include "protocol/toml/TableReader.h"
#include "session/Runner.h"
#include "view/ArView.h"

namespace heft {

namespace {

std::optional<double> percent_of(const Tally& tally) {
  return tally.n_trials == 0 ? std::nullopt : std::optional(tally.percent());
}

// Keeps what figures need of a session's events.
class FigureCollector {
 public:
  void add(const Event& event, const Changes& changes) {
    if (event.as<TrialStarted>()) n_choices_ = 0;
    if (const auto* action = event.as<Action>(); action && action->kind == "select") ++n_choices_;
    if (const auto* touch = event.as<CubeTouch>(); touch && touch->max_push_displacement_m) {
      depth_mm_ += 1000 * *touch->max_push_displacement_m;
      ++n_touches_;
    }
    if (changes.trial && changes.trial->status == TrialStatus::completed) add(*changes.trial);
    for (const EstimateRow& estimate : changes.estimates)
      if (estimate.jnd_g) {
        const auto reference_g = reference_of_.find(estimate.staircase);
        if (reference_g != reference_of_.end())
          jnds_g_[reference_g->second].push_back(*estimate.jnd_g);
      }
  }

  std::optional<double> figure(const FigurePlace& place) const {
    switch (place.kind) {
      case FigureKind::jnd:
        return mean_jnd_g(place.reference_g.value_or(0));
      case FigureKind::false_alarms:
        return percent_of(false_alarms_);
      case FigureKind::wrong_choices:
        return percent_of(wrong_choices_);
      case FigureKind::first_try:
        return percent_of(first_tries_);
      case FigureKind::stroke_depth:
        return n_touches_ == 0 ? std::nullopt : std::optional(depth_mm_ / n_touches_);
      case FigureKind::correct:
      case FigureKind::incorrect:
      case FigureKind::dont_know:
        break;
    }
    Tally sorted;
    for (const auto& [condition, outcomes] : sortings_)
      if (place.condition.empty() || place.condition == condition)
        for (const auto& [outcome, n] : outcomes) {
          sorted.n_trials += n;
          if (outcome == name_of(place.kind)) sorted.n_hits += n;
        }
    return percent_of(sorted);
  }

 private:
  void add(const TrialRow& trial) {
    if (trial.plan.is_practice) return;
    if (trial.plan.task == "introduction") first_tries_.add(n_choices_ == 1);
    if (trial.plan.task == "sorting") ++sortings_[trial.plan.condition][*trial.outcome];
    if (trial.plan.task != "comparison") return;
    if (trial.plan.reference_g && !trial.plan.staircase.empty())
      reference_of_[trial.plan.staircase] = *trial.plan.reference_g;
    if (trial.plan.is_catch) return false_alarms_.add(trial.outcome == "difference");
    if (trial.choice_correct) wrong_choices_.add(!*trial.choice_correct);
  }

  std::optional<double> mean_jnd_g(double reference_g) const {
    const auto found = jnds_g_.find(reference_g);
    return found == jnds_g_.end() ? std::nullopt : mean(found->second);
  }

  std::map<std::string, std::map<std::string, int>> sortings_;  // by condition and outcome
  std::map<std::string, double> reference_of_;                  // in g, by staircase
  std::map<double, std::vector<double>> jnds_g_;                // by reference in g
  Tally false_alarms_, wrong_choices_, first_tries_;
  int n_choices_ = 0;  // in the trial
  double depth_mm_ = 0;
  int n_touches_ = 0;
};

ReportedFigure read_figure(TableReader& table) {
  ReportedFigure figure;
  table.require({"figure"});
  table.read("figure", figure.place.kind);
  table.read("reference_g", figure.place.reference_g, above_zero);
  table.read("condition", figure.place.condition);
  table.read("mean", figure.mean);
  table.read("sd", figure.sd, above_zero);
  table.read("n", figure.n, {1, 1'000'000});
  table.read("fitted", figure.fitted);
  table.close();
  const bool is_jnd = figure.place.kind == FigureKind::jnd;
  if (is_jnd != figure.place.reference_g.has_value())
    table.mistake("figure",
                  is_jnd ? "a jnd needs its reference_g" : "only a jnd has a reference_g");
  if (!figure.mean && figure.sd) table.mistake("sd", "an sd needs its mean");
  if (figure.mean && figure.n < 2 && figure.sd) table.mistake("n", "an sd needs n above 1");
  return figure;
}

}  // namespace

std::string_view unit_of(FigureKind kind) {
  if (kind == FigureKind::jnd) return "g";
  return kind == FigureKind::stroke_depth ? "mm" : "%";
}

std::string text_of(const FigurePlace& place) {
  std::string text(name_of(place.kind));
  for (char& c : text)
    if (c == '_') c = ' ';
  if (place.reference_g) text += fmt::format(" at {:g} g", *place.reference_g);
  if (!place.condition.empty()) text += " in " + place.condition;
  return text;
}

std::vector<ReportedFigure> parse_figures(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable document = parse_toml(text, file);
  TableReader root(document, mistakes);
  std::vector<ReportedFigure> figures;
  for (TableReader& table : root.tables("figure")) figures.push_back(read_figure(table));
  root.require({"figure"});
  root.close();
  mistakes.throw_if_any();
  return figures;
}

void run_alone(const ResolvedConfig& config, Responder& responder, std::uint64_t seed,
               std::function<void(const Event&, const Changes&)> each) {
  class EachEvent final : public EventSink {
   public:
    explicit EachEvent(std::function<void(const Event&, const Changes&)> of) : of_(std::move(of)) {}
    void append(const Event& event, const Changes& changes, Durability) override {
      of_(event, changes);
    }
    void add_frame(const FrameRow&) override {}
    void add_info(const std::string&, const std::string&) override {}
    void flush() override {}

   private:
    std::function<void(const Event&, const Changes&)> of_;
  } sink(std::move(each));
  const Protocol& protocol = *config->protocol;
  Engine engine(config->protocol, seed);
  engine.apply(Event{0, config->config});
  SessionClock clock = SessionClock::virtual_from(0);
  HandPictures pictures(responder, protocol.display_rate_hz);
  const auto view = view_named("headless").make({});
  SessionParts parts{protocol, engine, sink, pictures, responder, *view, clock};
  parts.has_pictures = config->tracker->has_pictures;
  Runner(parts, {}).run();
}

std::vector<std::optional<double>> figures_of_one(const ResolvedConfig& config,
                                                  Responder& responder, std::uint64_t seed,
                                                  std::span<const FigurePlace> places) {
  FigureCollector collector;
  run_alone(config, responder, seed,
            [&](const Event& event, const Changes& changes) { collector.add(event, changes); });
  std::vector<std::optional<double>> figures;
  for (const FigurePlace& place : places) figures.push_back(collector.figure(place));
  return figures;
}

}  // namespace heft
