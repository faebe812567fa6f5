#include "algorithms/narrow_phase.h"
TOUCHSTONE_NARROW_PHASE { return {}; }
