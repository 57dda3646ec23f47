#include "view/letters/Letters.h"

#include "base/Module.h"

namespace heft {

std::unique_ptr<Letters> make_letters(const std::string& language) {
  static const auto& module = *static_cast<const LettersModule*>(
      from_module("heft-letters.so", "heft_letters", "writes the participant's texts"));
  return module.make(language);
}

}  // namespace heft
