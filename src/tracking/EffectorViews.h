// Which pictures of a stream are worth placing the effector's tags from: those with two tags or
// more, that differ from each other.
#pragma once

#include <string>
#include <vector>

#include "tracking/TagViews.h"

namespace heft {

class EffectorViews {
 public:
  EffectorViews(const MarkerBody& effector, const Intrinsics& camera);

  /// @throws Error for a picture of another size than the camera was calibrated at
  void offer(const Image& image, const std::string& name);

  /// Enough of them, and of every tag.
  bool complete() const;
  bool full() const { return views_.size() >= most; }
  /// How far towards enough of them: 1 is there.
  double share() const { return static_cast<double>(views_.size()) / enough; }
  /// "12 pictures; tag 30: 7 tag 31: 5".
  std::string counts() const;
  const std::vector<TagView>& views() const { return views_; }

 private:
  static constexpr std::size_t enough = 46, most = 120;
  static constexpr int enough_of_a_tag = 12;

  void require_size(const Image& image, const std::string& name) const;

  MarkerBody effector_;
  Intrinsics camera_;
  TagViewer viewer_;
  std::vector<TagView> views_;
  std::vector<int> counts_;  ///< of each tag
};

}  // namespace heft
