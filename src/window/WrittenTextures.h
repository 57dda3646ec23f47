// Lines of text as textures of an OpenGL context: made when first drawn, deleted after a frame
// without them.
#pragma once

#include <map>

#include "view/text/Letters.h"

namespace heft {

class Typeface;

/// Where its ink is, from the line's left end at its top.
struct WrittenTexture {
  unsigned texture = 0;  ///< white; its opacity is the ink
  int left = 0, top = 0, width = 0, height = 0;
  bool used = true;  ///< in this frame
};

/// Its context is current whenever it is used or goes.
class WrittenTextures {
 public:
  WrittenTextures() = default;
  ~WrittenTextures();
  WrittenTextures(const WrittenTextures&) = delete;
  WrittenTextures& operator=(const WrittenTextures&) = delete;

  const WrittenTexture& of(const WrittenLine& line, const Typeface& typeface);
  /// The frame is shown. Textures that it did without are dropped.
  void end_frame();

 private:
  std::map<WrittenLine, WrittenTexture> textures_;
};

}  // namespace heft
