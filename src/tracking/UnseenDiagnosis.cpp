#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "tracking/Tracker.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/detection/TagDetector.h"

namespace heft {

namespace {
constexpr double clear_margin = 20;  // minimum contrast of a tag in gray levels

std::vector<int> ids_in(const Image& gray, const std::string& family) {
  TagDetector detector(family, 1);
  std::vector<int> ids;
  for (const DetectedTag& tag : detector.detect(gray, whole(gray), EdgeSearch::everywhere))
    if (tag.decision_margin > clear_margin) ids.push_back(tag.id);
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

Image mirrored(Image gray) {
  for (int y = 0; y < gray.height; ++y) {
    const auto row = gray.pixels.begin() + y * static_cast<std::ptrdiff_t>(gray.row_bytes());
    std::reverse(row, row + gray.width);
  }
  return gray;
}

int median_of(const Image& gray) {
  std::vector<std::uint8_t> values = gray.pixels;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

bool is_on(const MarkerBody& body, int id) {
  return std::ranges::find(body.tags, id, &Tag::id) != body.tags.end();
}

// "0, 1, 2 and 21 more"
std::string listed(std::vector<int> ids) {
  constexpr std::size_t most = 6;
  if (ids.size() <= most) return fmt::format("{}", fmt::join(ids, ", "));
  const std::size_t more = ids.size() - most;
  ids.resize(most);
  return fmt::format("{} and {} more", fmt::join(ids, ", "), more);
}
}  // namespace

std::string why_unseen(const Image& picture, const MarkerBody& body, const std::string& what,
                       const MarkerBody& beside) {
  constexpr int dark = 40, white = 250;
  if (picture.empty() || body.tags.empty()) return "there is no picture or no tag";
  const Image gray = gray_of(picture);
  std::vector<int> ids = ids_in(gray, body.family);
  if (beside.family == body.family) std::erase_if(ids, [&](int id) { return is_on(beside, id); });
  const auto n_own = std::ranges::count_if(ids, [&](int id) { return is_on(body, id); });
  if (n_own > 0)
    return fmt::format(
        "{} of the {}'s {} tags can be read, but too few of their edges are clear, or they do not "
        "fit "
        "together: check its file, the focus, the light, and that it is uncovered",
        n_own, what, body.tags.size());
  if (const int median = median_of(gray); median < dark || median >= white)
    return fmt::format("the picture is {} (median {} of 255): {}",
                       median < dark ? "dark" : "overexposed", median,
                       median < dark ? "use more light, or a longer exposure"
                                     : "use less light, or a shorter exposure");
  if (std::ranges::any_of(ids_in(mirrored(gray), body.family),
                          [&](int id) { return is_on(body, id); }))
    return "the picture is mirrored: turn that off in the camera's settings, or print the sheet "
           "without mirroring";
  if (!ids.empty())
    return fmt::format("the picture shows other tags of {} ({}), none of the {}'s: check its file",
                       body.family, listed(ids), what);
  return fmt::format(
      "the picture shows none of the {0}'s tags: check that it is in view, uncovered, sharp, not "
      "too "
      "far away, and printed with tags of {1}",
      what, body.family);
}

}  // namespace heft
