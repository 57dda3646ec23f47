// SHA-256, through libmd: names a text (a protocol, a consent form) for good.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// 64 lowercase hexadecimal digits.
std::string sha256(std::string_view text);

}  // namespace heft
