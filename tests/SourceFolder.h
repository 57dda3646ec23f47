#pragma once

#include <string>

namespace heft {

/** The folder of the checkout that is tested: protocols, golden files and sources are read from it.
 */
std::string source_folder();

}  // namespace heft
