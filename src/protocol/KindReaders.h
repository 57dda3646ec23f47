// What files say about each kind of procedure. A further kind has these four for its config, in a
// file of its own.
#pragma once

#include <string>

#include "protocol/TableReader.h"
#include "psychophysics/Constant.h"
#include "psychophysics/UpDown.h"

namespace heft {

// Read the kind's keys, into a config of defaults.
void read_keys(TableReader& table, UpDownConfig& config);
void read_keys(TableReader& table, ConstantConfig& config);

// Note what is wrong between the keys, once the table is closed.
void check_keys(TableReader& table, const UpDownConfig& config);
void check_keys(TableReader& table, const ConstantConfig& config);

// Note levels that would make a comparison, reference_g + level, weigh 0 g or less.
void check_lightest(TableReader& table, const UpDownConfig& config, double reference_g);
void check_lightest(TableReader& table, const ConstantConfig& config, double reference_g);

// What a report says was chosen; levels are grams.
std::string described(const UpDownConfig& config);
std::string described(const ConstantConfig& config);

}  // namespace heft
