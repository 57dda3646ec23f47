#include "psychophysics/Staircase.h"
