#include "SourceFolder.h"

std::string heft::source_folder() {
  return HEFT_SOURCE_DIR;
}
