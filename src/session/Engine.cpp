#include "session/Engine.h"
