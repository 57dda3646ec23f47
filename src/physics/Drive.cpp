#include "physics/Drive.h"
