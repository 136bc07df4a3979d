// The one unit that implements the header. Including it again changes nothing.
#define MINIRT_IMPLEMENTATION
// clang-format off
#include "minirt.h"
#include "minirt.h"
// clang-format on
