#include "tracking/Intrinsics.h"
