#include "tracking/codecs/Codecs.h"

#include <fmt/format.h>

#include <cstdlib>

#include "base/Program.h"

namespace heft {

const Codecs& codecs() {
  static const Codecs& module = []() -> const Codecs& {
    // imgcodecs reads it when it is loaded.
    setenv("OPENCV_IO_MAX_IMAGE_PIXELS", fmt::format("{:.0f}", most_picture_pixels).c_str(), 1);
    return *static_cast<const Codecs*>(
        from_module("heft-codecs.so", "heft_codecs", "reads and writes pictures"));
  }();
  return module;
}

}  // namespace heft
