/* The shortest whole program: renders a blob and prints the colour of the middle pixel. */
#include <minirt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char** argv) {
    const size_t width = 320, height = 240;
    minirt_context* ctx = NULL;
    minirt_scene* scene = NULL;
    const int help = argc == 2 && strcmp(argv[1], "--help") == 0;
    if (argc != 2 || help) {
        fprintf(help ? stdout : stderr, "usage: minirt-hello SCENE.mrt, for example: minirt-hello still_life.mrt\n");
        return help ? 0 : 2;
    }
    float* rgba = malloc(width * height * 4 * sizeof *rgba);
    if (!rgba) return 1;
    minirt_result r = minirt_create(&(minirt_context_desc){0}, &ctx);
    if (!r) r = minirt_load_file(ctx, argv[1], &scene);
    if (!r) r = minirt_render(scene, &(minirt_render_desc){.width = (uint32_t)width, .height = (uint32_t)height}, rgba);
    const float* middle = rgba + (height / 2 * width + width / 2) * 4;
    if (r)
        fprintf(stderr, "%s: %s. %s\n", argv[1], minirt_result_string(r), minirt_last_message(ctx));
    else
        printf("%g %g %g\n", middle[0], middle[1], middle[2]);
    minirt_destroy(ctx);
    free(rgba);
    return r != 0;
}
