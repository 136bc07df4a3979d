// The one unit that implements the header. Including it again changes nothing.
#define MINIRT_IMPLEMENTATION
#include "minirt.h"
