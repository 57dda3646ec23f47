// The tag families of libapriltag: their names, how many tags they have and which cells of a tag
// are white. Those who draw tags (sheets, the synthetic camera) and those who find them use it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct apriltag_family;

namespace heft {

/// What is printed: n_cells x n_cells squares, the quiet zone or outer data ring included.
struct TagPattern {
  struct Cell {
    int column, row;
  };
  int n_cells = 0;
  /// The detected corners are those of the border_cells x border_cells squares in the middle.
  int border_cells = 0;
  bool bright_outside = true;  ///< of the detected border
  std::vector<bool> white;     ///< rows from the top
  std::vector<Cell> data;      ///< the cells that tell tags apart

  bool is_white(int column, int row) const {
    return white[static_cast<std::size_t>(row * n_cells + column)];
  }
  /// Cells between a side of the pattern and the detected border.
  int margin_cells() const { return (n_cells - border_cells) / 2; }
  /// How far a print whose detected corners are side_m apart reaches beyond them.
  double margin_m(double side_m) const { return margin_cells() * side_m / border_cells; }
};

/// "tag36h11"...
std::vector<std::string_view> tag_family_names();

/// How many tags a family has: ids are 0 ... n - 1.
/// @throws Error (usage) for a family that there is not, naming the nearest
int n_tags_of(const std::string& family);

/// @throws Error (usage) for a family that there is not; Error for an id that it does not have
TagPattern tag_pattern(const std::string& family, int id);

/// The library's own family, destroyed with the handle. One for each detector: a detector that is
/// destroyed silences the others of its family.
using TagFamilyHandle = std::unique_ptr<apriltag_family, void (*)(apriltag_family*)>;

/// @throws Error (usage) for a family that there is not
TagFamilyHandle make_tag_family(const std::string& family);

}  // namespace heft
