// SQL text of the log's tables and views. Private to this room.
#pragma once

#include <string>

#include "record/Schema.h"

namespace heft::schema {

/// CREATE statements of all tables and indexes, from the rows' descriptions.
std::string tables();

extern const char* const views;

}  // namespace heft::schema
