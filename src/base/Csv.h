// Cells of comma-separated files as other programs take them.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// RFC 4180: in quotes where it needs them.
std::string csv_cell(std::string_view text);

/// A text that a spreadsheet would take for a formula or a command (it begins with = + - @ or a
/// control character) with a ' before it; one that begins with ' too, so that it can be undone.
std::string without_formula(std::string_view text);

}  // namespace heft
