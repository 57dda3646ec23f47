// Sheets to print: the board, and the effector's net. True millimeters, a ruler line to measure the
// print, and instructions on a second page.
#pragma once

#include <string>

#include "base/Names.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

enum class Paper { a4, letter };
template <>
struct EnumNames<Paper> {
  static constexpr std::array<std::string_view, 2> names{"a4", "letter"};
};

/// The board's tags in the middle of the sheet, portrait or landscape.
/// @param board from its file; drawn as designed, whatever ruler length was measured since
/// @throws Error if the board is larger than the paper, or not flat on the table, or the file
/// cannot be
///   written
void write_board_sheet(const MarkerBody& board, Paper paper, const std::string& path);

/// The effector's faces with flaps, to cut out and fold.
/// @throws Error if the net is larger than the paper, a tag is on no face, or the file cannot be
/// written
void write_effector_sheet(const MarkerBody& effector, Paper paper, const std::string& path);

}  // namespace heft
