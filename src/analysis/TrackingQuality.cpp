#include "analysis/TrackingQuality.h"

namespace heft {

namespace {
void add(FrameCounts& sum, const FrameCounts& more) {
  const int n = sum.n_frames + more.n_frames;
  if (more.mean_quality) {  // weighted by frames
    const double before = sum.mean_quality ? *sum.mean_quality * sum.n_frames : 0;
    const int n_before = sum.mean_quality ? sum.n_frames : 0;
    sum.mean_quality = (before + *more.mean_quality * more.n_frames) /
                       static_cast<double>(n_before + more.n_frames);
  }
  sum.n_frames = n;
  sum.n_tracked += more.n_tracked;
  sum.n_jumps += more.n_jumps;
}

void add(TrackingCounts& sum, const TrackingCounts& more) {
  sum.n_lost += more.n_lost;
  sum.lost_s += more.lost_s;
  sum.answering_s += more.answering_s;
  add(sum.frames, more.frames);
}
}  // namespace

std::optional<double> PersonTracking::in_view_percent() const {
  if (!(counts.answering_s > 0)) return std::nullopt;
  return 100 * (1 - counts.lost_s / counts.answering_s);
}

std::optional<double> PersonTracking::tracked_percent() const {
  if (counts.frames.n_frames == 0) return std::nullopt;
  return 100.0 * counts.frames.n_tracked / counts.frames.n_frames;
}

void TrackingFold::add(const SessionData& data) {
  const std::string participant = data.participant();
  PersonTracking& person = people_[participant];
  person.participant = participant;
  heft::add(person.counts, data.tracking());
  person.pictures.shown += data.pictures.shown;
  person.pictures.dropped += data.pictures.dropped;
  person.pictures.late += data.pictures.late;
}

std::vector<PersonTracking> TrackingFold::result() const {
  std::vector<PersonTracking> rows;
  for (const auto& [participant, person] : people_) rows.push_back(person);
  return rows;
}

}  // namespace heft
