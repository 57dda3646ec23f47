// Pictures at the display's rate, wherever they come from: of a source that gives more, the ones in
// between are neither shown nor dropped. Capture times stay the pictures' own.
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
  /// As the source's. Dropped are only pictures that would have been shown.
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { source_->skip_to(t_s); }
  void listen_again() override;
  std::vector<CheckResult> check(double wanted_rate_hz) override {
    return source_->check(wanted_rate_hz);
  }
  bool has_checks() const override { return source_->has_checks(); }
  bool ended() const override { return source_->ended(); }
  std::optional<double> rate_hz() const override { return source_->rate_hz(); }

 private:
  bool is_due(double t_s) const;
  void show(Picture& picture);

  std::unique_ptr<PictureSource> source_;
  double period_s_;
  // Since the attempt's start.
  std::optional<double> due_s_;    ///< when the next one is to be shown; none: at once
  std::optional<double> taken_s_;  ///< the source's last one
  // Since the picture that was shown last.
  int n_lost_ = 0;
  bool jumped_ = false;
};

}  // namespace heft
