// The runtime, for minirtc's inspect, validate and devices.
#define MINIRT_IMPLEMENTATION
#include "minirt.h"
