// What kind of file a TOML text is, by the keys at its top level.
#pragma once

#include <string>

#include "base/Names.h"

namespace heft {

enum class FileKind { protocol, procedure, scene, board, effector, synthetic_camera, texts };
template <>
struct EnumNames<FileKind> {
  static constexpr std::array<std::string_view, 7> names{
      "protocol",      "procedure file",        "scene file", "board file",
      "effector file", "synthetic camera file", "text file"};
};

/// The kind whose tables the text has, or else most of whose keys.
/// @throws InvalidFile when the text is no TOML, or has no key of any kind
FileKind recognized_kind(const std::string& text, const std::string& file);

}  // namespace heft
