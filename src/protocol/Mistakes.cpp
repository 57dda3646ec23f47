#include "protocol/Mistakes.h"

#include <algorithm>
#include <tuple>

namespace heft {

void Mistakes::add(TomlPlace place, std::string message) {
  mistakes_.push_back({{file_, place.line, place.column}, std::move(message)});
}

InvalidFile Mistakes::as_error() const {
  std::vector<Mistake> sorted = mistakes_;
  std::ranges::stable_sort(sorted, {}, [](const Mistake& mistake) {
    return std::tuple(mistake.place.line, mistake.place.column);
  });
  return InvalidFile(std::move(sorted));
}

void Mistakes::throw_if_any() const {
  if (!mistakes_.empty()) throw as_error();
}

}  // namespace heft
