// Which texts OpenCV's file reader may see: it crashes on XML, never ends on !!binary, and follows
// whatever nests until the stack is used up. So only what a calibration needs is let through.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace heft {

struct YamlFault {
  int line = 0, column = 0;  ///< 0: of the whole text
  std::string what;
};

/// Plain YAML: keys, numbers, words and quoted texts, lists in brackets or by dashes, comments, and
/// no tag but OpenCV's own !!opencv-matrix; no anchors, no braces, nothing that nests deep.
/// @return the first thing in the text that is something else
std::optional<YamlFault> fault_in_plain_yaml(std::string_view text);

}  // namespace heft
