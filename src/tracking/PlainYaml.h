// The plain YAML that camera files are written in. Read by ourselves, because files from elsewhere
// make OpenCV's reader crash (XML), never end (!!binary) or use up the stack (whatever nests).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace heft {

/// What follows a key: one scalar, or all those of its list; quoted ones with their quotes.
struct YamlValue {
  int line = 0, column = 0;  ///< of the key
  std::vector<std::string> scalars;
};

/// By key; a key within another one goes by both names: "camera_matrix.data".
using YamlValues = std::map<std::string, YamlValue, std::less<>>;

/// Reads keys, numbers, words and quoted texts, lists in brackets or by dashes, comments, and no
/// tag but OpenCV's own !!opencv-matrix; no anchors, no braces, nothing that nests deep.
/// @param file its name, for messages
/// @throws InvalidFile at the first thing in the text that is something else
YamlValues parse_plain_yaml(std::string_view text, const std::string& file);

}  // namespace heft
