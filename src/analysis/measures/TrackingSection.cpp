// Tracking quality of each participant's effector.
#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure in_view{
    "in_view", "%", "in view",
    "share of the time from all cubes shown to the answer with the effector in "
    "view"};
constexpr Measure n_lost{"tracking_losses", "", "tracking losses",
                         "how often tracking of the effector was lost in a trial"};
constexpr Measure lost{"tracking_loss_time", "s", "time lost", "total time without tracking"};
constexpr Measure n_frames{"frames", "", "frames", "displayed frames, where they were kept"};
constexpr Measure tracked{"tracked", "%", "tracked", "share of frames with the effector tracked"};
constexpr Measure n_jumps{"jumps", "", "jumps",
                          "times the effector reappeared or jumped, and the clone was moved to it"};
constexpr Measure quality{"tracking_quality", "", "mean quality", "mean over frames, 0 to 1"};
constexpr Measure n_pictures{"pictures", "", "camera pictures", "pictures of the camera shown"};
constexpr Measure n_dropped{"pictures_dropped", "", "dropped", "camera pictures never shown"};
constexpr Measure n_late{"pictures_late", "", "late", "camera pictures that came late"};
constexpr Measure n_doubled{"pictures_doubled", "", "doubled",
                            "camera pictures with a second print of a tag in view"};

struct PersonTracking {
  TrackingCounts counts;
  PictureCounts pictures;  // of the camera; none for simulated participants

  void add(const SessionData& data) {
    const TrackingCounts more = data.tracking();
    counts.n_lost += more.n_lost;
    counts.lost_s += more.lost_s;
    counts.answering_s += more.answering_s;
    add_frames(more.frames);
    pictures += data.pictures;
  }
  // Percentage of the time from all cubes shown to the answer, without pauses; none without such a
  // time.
  std::optional<double> in_view_percent() const {
    if (!(counts.answering_s > 0)) return std::nullopt;
    return 100 * (1 - counts.lost_s / counts.answering_s);
  }
  std::optional<double> tracked_percent() const {
    if (counts.frames.n_frames == 0) return std::nullopt;
    return 100.0 * counts.frames.n_tracked / counts.frames.n_frames;
  }

 private:
  void add_frames(const FrameCounts& more) {
    FrameCounts& sum = counts.frames;
    if (more.mean_quality) {  // weighted by frames
      const int n_before = sum.mean_quality ? sum.n_frames : 0;
      sum.mean_quality =
          (sum.mean_quality.value_or(0) * n_before + *more.mean_quality * more.n_frames) /
          static_cast<double>(n_before + more.n_frames);
    }
    sum.n_frames += more.n_frames;
    sum.n_tracked += more.n_tracked;
    sum.n_jumps += more.n_jumps;
  }
};

class TrackingSection final : public Section {
 public:
  bool of_everyone() const override { return true; }
  void add(const SessionData& data) override { people_[data.participant()].add(data); }
  void put(Summary&) override {}

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const auto& [participant, person] : people_) {
      const auto put = [&, &id = participant](const Measure& measure, std::optional<double> value) {
        StudyEstimate& estimate = all.emplace_back(StudyEstimate{&measure});
        estimate.participant = id;
        estimate.value = value;
        estimate.n = 1;
      };
      const FrameCounts& frames = person.counts.frames;
      put(n_lost, person.counts.n_lost);
      put(in_view, person.in_view_percent());
      put(lost, person.counts.lost_s);
      put(n_frames, frames.n_frames);
      put(tracked, person.tracked_percent());
      put(n_jumps, frames.n_jumps);
      put(quality, frames.mean_quality);
      put(n_pictures, person.pictures.shown);
      put(n_dropped, person.pictures.dropped);
      put(n_late, person.pictures.late);
      put(n_doubled, person.pictures.doubled);
    }
    return all;
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable table{"tracking_quality",
                        "Tracking of each participant's effector",
                        {key_column("participant", "participant"),
                         column(n_lost, Field::value, "n_lost", "tracking losses", 0),
                         column(in_view, Field::value, "in_view_percent", "in view % of the time"),
                         column(lost, Field::value, "lost_s", "lost s"),
                         column(n_frames, Field::value, "n_frames", "frames", 0),
                         column(tracked, Field::value, "tracked_percent", "tracked %"),
                         column(n_jumps, Field::value, "n_jumps", "jumps", 0),
                         column(quality, Field::value, "mean_quality", "mean quality", 2),
                         column(n_pictures, Field::value, "n_pictures", "camera pictures", 0),
                         column(n_dropped, Field::value, "n_dropped", "dropped", 0),
                         column(n_late, Field::value, "n_late", "late", 0),
                         column(n_doubled, Field::value, "n_doubled", "doubled", 0)},
                        "time: from all cubes shown to the answer; frames: where they were kept; "
                        "jumps: the effector reappeared or jumped, and the clone was moved to it; "
                        "doubled: with a second print of a tag in view",
                        TablePlace::run_only,
                        "tracking[]"};
    table.participants = true;
    return {table};
  }

  std::vector<ChartSpec> charts() const override {
    return {{.name = "tracking_quality",
             .title = "Tracking of each participant's effector",
             .caption =
                 "A column for each participant, the worst tracked first: percentage of the "
                 "time until the answer with the effector in view, and of displayed frames with "
                 "it tracked, where frames were kept.",
             .csv = "tracking_quality.csv",
             .shape = ChartShape::people,
             .importance = 90,
             .series = {{&in_view, "% of the time in view"}, {&tracked, "% of frames tracked"}},
             .x_label = "participant, worst first",
             .y_label = "%",
             .axes = "set yrange [0:105]\n"}};
  }

 private:
  std::map<std::string, PersonTracking> people_;
};
}  // namespace

std::shared_ptr<Section> tracking_section() {
  return std::make_shared<TrackingSection>();
}

}  // namespace heft
