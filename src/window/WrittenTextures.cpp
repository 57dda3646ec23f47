#include "window/WrittenTextures.h"

#include <SDL_opengl.h>

#include <utility>
#include <vector>

#include "view/text/Typeface.h"

namespace heft {

namespace {
unsigned texture_of(const Ink& ink) {
  constexpr std::uint8_t white = 255;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(4 * ink.coverage.size());
  for (const std::uint8_t covered : ink.coverage)
    pixels.insert(pixels.end(), {white, white, white, covered});
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, ink.width, ink.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               pixels.data());
  return texture;
}
}  // namespace

WrittenTextures::~WrittenTextures() {
  for (const auto& [line, made] : textures_) glDeleteTextures(1, &made.texture);
}

const WrittenTexture& WrittenTextures::of(const WrittenLine& line, const Typeface& typeface) {
  const auto [place, is_new] = textures_.try_emplace(line);
  WrittenTexture& made = place->second;
  made.used = true;
  if (!is_new) return made;
  const Ink ink = typeface.ink(line);
  made.left = ink.left;
  made.top = ink.top;
  if (ink.coverage.empty()) return made;
  made.width = ink.width;
  made.height = ink.height;
  made.texture = texture_of(ink);
  return made;
}

void WrittenTextures::end_frame() {
  for (auto at = textures_.begin(); at != textures_.end();) {
    if (std::exchange(at->second.used, false)) {
      ++at;
    } else {
      glDeleteTextures(1, &at->second.texture);
      at = textures_.erase(at);
    }
  }
}

}  // namespace heft
