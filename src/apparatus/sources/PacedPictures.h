// Reduces a faster source to the display's rate. Pictures left out count neither as displayed nor
// as dropped. Capture times are kept.
#pragma once

#include <memory>
#include <optional>

#include "apparatus/sources/PictureSource.h"

namespace heft {

class PacedPictures final : public PictureSource {
 public:
  PacedPictures(std::unique_ptr<PictureSource> source, double display_rate_hz)
      : source_(std::move(source)), period_s_(1 / display_rate_hz) {}

  void begin_attempt(const AttemptStart& attempt) override;
  /// Dropped pictures are counted only if they would have been displayed.
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { source_->skip_to(t_s); }
  void restart_count() override;
  std::vector<CheckResult> check(double wanted_rate_hz) override {
    return source_->check(wanted_rate_hz);
  }
  bool has_checks() const override { return source_->has_checks(); }
  bool is_endless() const override { return source_->is_endless(); }
  bool ended() const override { return source_->ended(); }
  std::optional<double> rate_hz() const override { return source_->rate_hz(); }

 private:
  bool is_due(double t_s) const;
  void show(Picture& picture);

  std::unique_ptr<PictureSource> source_;
  double period_s_;
  // Since the attempt's start:
  std::optional<double> due_s_;    ///< when the next one is to be displayed; none: immediately
  std::optional<double> taken_s_;  ///< the source's last one
  // Since the last displayed picture:
  int n_lost_ = 0;
  bool jumped_ = false;
};

}  // namespace heft
