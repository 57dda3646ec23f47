// The mistakes of one file, collected while it is read.
#pragma once

#include <string>
#include <vector>

#include "base/Error.h"
#include "protocol/TomlDocument.h"

namespace heft {

class Mistakes {
 public:
  explicit Mistakes(std::string file) : file_(std::move(file)) {}
  void add(TomlPlace place, std::string message);
  /// All of them in order of place.
  InvalidFile as_error() const;
  /// @throws InvalidFile if there are any
  void throw_if_any() const;

 private:
  std::string file_;
  std::vector<Mistake> mistakes_;
};

}  // namespace heft
