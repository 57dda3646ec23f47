// The tag families of libapriltag: names, numbers of tags, and the white cells of a tag. Used for
// drawing (sheets, the synthetic camera) and for detection.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct apriltag_family;

namespace heft {

/// The print: n_cells x n_cells squares, including the quiet zone or outer data ring.
struct TagPattern {
  struct Cell {
    int column, row;
  };
  int n_cells = 0;
  /// The detected corners are those of the border_cells x border_cells squares in the middle.
  int border_cells = 0;
  bool bright_outside = true;  ///< of the detected border
  std::vector<bool> white;     ///< rows from the top
  std::vector<Cell> data;      ///< the cells that distinguish tags

  bool is_white(int column, int row) const {
    return white[static_cast<std::size_t>(row * n_cells + column)];
  }
  /// Cells between a side of the pattern and the detected border.
  int margin_cells() const { return (n_cells - border_cells) / 2; }
  /// Width of the print beyond the detected corners, which are side_m apart.
  double margin_m(double side_m) const { return margin_cells() * side_m / border_cells; }
};

/// "tag36h11"...
std::vector<std::string_view> tag_family_names();

/// Number of tags of a family: ids are 0 ... n - 1.
/// @throws Error (usage) for an unknown family, suggesting the most similar
int n_tags_of(const std::string& family);

/// @throws Error (usage) for an unknown family; Error for an unknown id
TagPattern tag_pattern(const std::string& family, int id);

/// The library's family, destroyed with the handle. One per detector: destroying a detector
/// disables the others of its family.
using TagFamilyHandle = std::unique_ptr<apriltag_family, void (*)(apriltag_family*)>;

/// @throws Error (usage) for an unknown family
TagFamilyHandle make_tag_family(const std::string& family);

}  // namespace heft
