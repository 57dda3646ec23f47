// Pictures as files: PNG, JPEG, PGM, BMP, TIFF... by the file's name.
#pragma once

#include <string>

#include "base/Image.h"

namespace heft {

/// Gray pictures have 1 channel, others 3 (blue, green, red; transparency is dropped); 16-bit
/// pictures are converted to 8 bits.
/// @throws Error naming the file: missing, not a picture, damaged, or too large
Image read_image(const std::string& path);

/// @throws Error naming the file and the reason: an unknown extension, a full disk...
void write_image(const std::string& path, const Image& image);

/// Whether the file's extension is that of a format for read_image.
bool is_image_file(const std::string& path);

}  // namespace heft
