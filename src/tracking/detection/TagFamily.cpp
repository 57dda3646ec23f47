#include "tracking/detection/TagFamily.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "base/Names.h"

namespace heft {

namespace {

struct FamilyEntry {
  std::string_view name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array families{
    FamilyEntry{"tag36h11", tag36h11_create, tag36h11_destroy},
    FamilyEntry{"tag36h10", tag36h10_create, tag36h10_destroy},
    FamilyEntry{"tag25h9", tag25h9_create, tag25h9_destroy},
    FamilyEntry{"tag16h5", tag16h5_create, tag16h5_destroy},
    FamilyEntry{"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    FamilyEntry{"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy},
    FamilyEntry{"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy},
    FamilyEntry{"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    FamilyEntry{"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
};

// Cells without bits: corners of round tags are paper; the detected border and the ring around it
// are one black, one white.
bool is_white_without_bits(const TagPattern& pattern, int column, int row) {
  const int from_edge =
      std::min({column, row, pattern.n_cells - 1 - column, pattern.n_cells - 1 - row});
  const int from_border = from_edge - pattern.margin_cells();
  if (from_border < -1) return true;
  return from_border == (pattern.bright_outside ? -1 : 0);
}

void paint_borders(TagPattern& pattern) {
  for (int row = 0; row < pattern.n_cells; ++row)
    for (int column = 0; column < pattern.n_cells; ++column)
      pattern.white.push_back(is_white_without_bits(pattern, column, row));
}

// Bits are ordered from the code's most significant one; positions are relative to the detected
// border.
void paint_bits(TagPattern& pattern, const apriltag_family_t& family, std::uint64_t code) {
  const int margin = pattern.margin_cells();
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    const int column = static_cast<int>(family.bit_x[bit]) + margin;
    const int row = static_cast<int>(family.bit_y[bit]) + margin;
    pattern.data.push_back({column, row});
    pattern.white[static_cast<std::size_t>(row * pattern.n_cells + column)] =
        (code >> (family.nbits - 1 - bit) & 1) != 0;
  }
}

}  // namespace

std::vector<std::string_view> tag_family_names() {
  return names_in(std::span<const FamilyEntry>(families));
}

TagFamilyHandle make_tag_family(const std::string& family) {
  const FamilyEntry& entry =
      entry_named("tag family", family, std::span<const FamilyEntry>(families));
  return {entry.create(), entry.destroy};
}

int n_tags_of(const std::string& family) {
  return static_cast<int>(make_tag_family(family)->ncodes);
}

TagPattern tag_pattern(const std::string& family, int id) {
  const TagFamilyHandle handle = make_tag_family(family);
  const auto n_tags = static_cast<int>(handle->ncodes);
  if (id < 0 || id >= n_tags)
    throw Error(fmt::format("{} has no tag {}: its ids are 0 to {}", family, id, n_tags - 1));
  TagPattern pattern{
      handle->total_width, handle->width_at_border, !handle->reversed_border, {}, {}};
  paint_borders(pattern);
  paint_bits(pattern, *handle, handle->codes[id]);
  return pattern;
}

}  // namespace heft
