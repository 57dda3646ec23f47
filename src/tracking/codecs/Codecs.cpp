#include "tracking/codecs/Codecs.h"

#include "base/Program.h"

namespace heft {

const Codecs& codecs() {
  static const Codecs& module = *static_cast<const Codecs*>(
      from_module("heft-codecs.so", "heft_codecs", "reads and writes pictures"));
  return module;
}

}  // namespace heft
