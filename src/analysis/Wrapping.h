// Lines of a limited length.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// Lines of at most `width` characters, broken at spaces, or anywhere where a word is longer. None
/// for an empty text. width > 0.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

}  // namespace heft
