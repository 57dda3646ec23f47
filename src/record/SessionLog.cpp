#include "record/SessionLog.h"
