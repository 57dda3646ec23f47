// SQL text of the log's tables and views, version by version.
#pragma once

namespace heft::schema {

/// Version 1. A released version's text never changes; a change is one more version with its own
/// migration (Schema.cpp).
extern const char* const tables_1;
extern const char* const views_1;

/// Version 2: where the time of a displayed picture went.
extern const char* const changes_2;

}  // namespace heft::schema
