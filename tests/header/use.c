/* A C99 unit that only uses the header; also compiled as C++. */
#include <string.h>

#include "minirt.h"

int useFromC(void);

int useFromC(void) {
    minirt_context_desc context;
    minirt_render_desc render;
    minirt_validation validation;
    memset(&context, 0, sizeof context);
    memset(&render, 0, sizeof render);
    return minirt_validate(NULL, 0, NULL, &validation) == MINIRT_ERROR_INVALID_ARGUMENT && validation.message[0] != 0;
}
