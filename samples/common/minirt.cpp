// The one file of the samples that holds the runtime's implementation.
#define MINIRT_IMPLEMENTATION
#include "minirt.h"
