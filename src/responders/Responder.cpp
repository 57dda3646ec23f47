#include "responders/Responder.h"
