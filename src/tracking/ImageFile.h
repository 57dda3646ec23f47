// Pictures as files: PNG, JPEG, PGM, BMP, TIFF... by the file's name.
#pragma once

#include <string>

#include "base/Image.h"

namespace heft {

/// Gray pictures have 1 channel, others 3 (blue, green, red; transparency is dropped); 16-bit
/// pictures are brought to 8 bits.
/// @throws Error naming the file: not there, not a picture, or damaged
Image read_image(const std::string& path);

/// @throws Error naming the file and the reason: an ending that no format has, a full disk...
void write_image(const std::string& path, const Image& image);

/// Whether the file's ending is that of a picture that read_image knows.
bool is_image_file(const std::string& path);

}  // namespace heft
