#include "experiment/SessionConfig.h"

#include <sstream>

namespace heft {

std::vector<std::string> settings_of(const SessionConfig& setup) {
  std::vector<std::string> settings;
  std::istringstream lines(setup.settings);
  for (std::string line; std::getline(lines, line);) settings.push_back(line);
  return settings;
}

}  // namespace heft
