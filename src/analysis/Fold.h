// Figures that are made of sessions one by one, so that of a thousand no more than one is in
// memory: a fold takes each (add) and says at last what they come to (result).
#pragma once

#include <span>

#include "analysis/Dataset.h"

namespace heft {

template <typename Fold>
auto folded(std::span<const SessionData> sessions) {
  Fold fold;
  for (const SessionData& data : sessions) fold.add(data);
  return fold.result();
}

}  // namespace heft
