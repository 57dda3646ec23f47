// The table that `auto` picks from (src/physics/auto/ErrorTable.inc), made from errors.csv.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// @param errors_csv the text of results/physics/errors.csv
/// @return rows of the array in src/physics/auto/ErrorTable.cpp: simulators in the order of the
/// ladder, those that blow up or model nothing of a class left out
std::string error_table_text(std::string_view errors_csv);

}  // namespace heft
