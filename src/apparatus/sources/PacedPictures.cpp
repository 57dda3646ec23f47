#include "apparatus/sources/PacedPictures.h"

#include <algorithm>
#include <utility>

namespace heft {

namespace {
// Jitter of a camera's pictures, as a fraction of their period.
constexpr double jitter_periods = 0.25;
}  // namespace

void PacedPictures::begin_attempt(const AttemptStart& attempt) {
  source_->begin_attempt(attempt);
  due_s_.reset();
  taken_s_.reset();
  n_lost_ = 0;
  jumped_ = false;
}

void PacedPictures::restart_count() {
  source_->restart_count();
  due_s_.reset();
  n_lost_ = 0;
}

std::optional<Picture> PacedPictures::next() {
  while (auto picture = source_->next()) {
    const double t_s = picture->sample.t_capture_s;
    const bool due = is_due(t_s);
    taken_s_ = t_s;
    n_lost_ += picture->n_dropped;
    jumped_ = jumped_ || picture->sample.jump;
    if (!due) continue;
    show(*picture);
    return picture;
  }
  return std::nullopt;
}

// Whether this picture is nearer to the due time than the expected next one.
bool PacedPictures::is_due(double t_s) const {
  if (!due_s_ || !taken_s_) return true;
  return t_s + std::min(t_s - *taken_s_, period_s_) / 2 >= *due_s_;
}

void PacedPictures::show(Picture& picture) {
  const double t_s = picture.sample.t_capture_s;
  const double late_s = t_s - due_s_.value_or(t_s);
  const int n_missing = std::max(0, static_cast<int>(late_s / period_s_ + jitter_periods));
  picture.n_dropped = std::min(std::exchange(n_lost_, 0), n_missing);
  picture.sample.jump = std::exchange(jumped_, false);
  // After a gap, or with a slower source, the schedule restarts instead of catching up.
  due_s_ = (late_s > period_s_ / 2 ? t_s : t_s - late_s) + period_s_;
}

}  // namespace heft
