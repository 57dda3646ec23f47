// The studies behind `heft bench`: each writes CSV and SVG into a folder of results/. One table, in
// Study.cpp, names them all.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace heft {

struct StudyOptions {
  std::string out;         ///< the folder for its files
  std::string command;     ///< how it was called, for captions
  bool quick = false;      ///< a small part, to see that everything works
  std::uint64_t seed = 1;  ///< of what a study draws at random
};

struct StudyEntry {
  std::string_view name;
  std::string_view summary;
  void (*run)(const StudyOptions& options);
};

std::span<const StudyEntry> studies();

/// @throws Error (usage) naming the nearest study when there is none of that name
const StudyEntry& study_named(std::string_view name);

}  // namespace heft
