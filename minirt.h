/* minirt: renders scenes that minirtc baked, on any Vulkan device, with a few lines of host code.

   CONTENTS   >>manual  >>config  >>layout  >>api  >>implementation

   >>manual
   One C++17 file of the application defines MINIRT_IMPLEMENTATION before including this header; all others, C99 or C++, just
   include it. It needs the Vulkan headers and the C++ standard library. It links nothing but the platform's dynamic loader: it
   loads Vulkan by itself, or through the host's vkGetInstanceProcAddr.

       #include "minirt.h"
       int main(void) {
         minirt_context *ctx = NULL; minirt_scene *scene = NULL;
         minirt_result r = minirt_create(&(minirt_context_desc){0}, &ctx);
         if (!r) r = minirt_load_file(ctx, "whisky.mrt", &scene);
         float *rgba = malloc(1280 * 720 * 4 * sizeof *rgba);
         if (!r) r = minirt_render(scene, &(minirt_render_desc){.width = 1280, .height = 720, .samples = 64}, rgba);
         if (r) fprintf(stderr, "%s: %s\n", minirt_result_string(r), minirt_last_message(ctx));
         minirt_destroy(ctx);
         return r != 0;
       }

   Every desc struct may be zero-initialised: each default is zero. Every function that can fail returns a minirt_result, 0 on
   success. The header never prints, exits, aborts or throws. A context and its scenes belong to one thread at a time; different
   contexts are independent. After MINIRT_ERROR_DEVICE_LOST every call on that context returns the same; destroy it and start over.

   Progressive rendering and cancel: minirt_begin, minirt_step until progress.done, minirt_read at any time between, minirt_end.
   A step submits one dispatch, sized by measurement to last about minirt_render_desc::max_dispatch_ms, so that neither watchdogs
   nor users wait. In a host's own frame: minirt_record.

   The blob's layout is described in docs/blob_format.md and defined below, under >>layout. */
#ifndef MINIRT_H
#define MINIRT_H

#include <stddef.h>
#include <stdint.h>

#ifndef VK_NO_PROTOTYPES
#define MINIRT_UNDEF_VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>
#ifdef MINIRT_UNDEF_VK_NO_PROTOTYPES
#undef MINIRT_UNDEF_VK_NO_PROTOTYPES
#undef VK_NO_PROTOTYPES
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* >>config
   MINIRT_API        linkage of the functions; default extern.
   MINIRT_NO_DLOPEN  define where there is no dynamic loader: minirt_host_device::get_instance_proc_addr must then be given.
   MINIRT_NO_THREADS define where there are no threads. Else a load checks on one while it uploads, and the pipelines of an integrator
                     are made on one each; all end before the call returns. They call Vulkan, and nothing else of the host's.
                     Without exceptions there are none either. */
#ifndef MINIRT_API
#define MINIRT_API
#endif

/* >>layout
   The part between the marks is compiled as C99, C++ and GLSL. Rows of 16 bytes; uint for bool. */
typedef struct minirt_vec4 {
    float x, y, z, w;
} minirt_vec4;
typedef struct minirt_uvec4 {
    uint32_t x, y, z, w;
} minirt_uvec4;
#define MINIRT_UINT uint32_t
/* layout-begin */
#define MINIRT_FORMAT_VERSION 4

#define MINIRT_NONE 0xffffffffu
#define MINIRT_RAY_END 3.0e38f

/* Bindings of descriptor set 0. */
#define MINIRT_BINDING_SCENE 0
#define MINIRT_BINDING_NODES 1
#define MINIRT_BINDING_PRIMITIVES 2
#define MINIRT_BINDING_NORMALS 3
#define MINIRT_BINDING_UVS 4
#define MINIRT_BINDING_MATERIALS 5
#define MINIRT_BINDING_LIGHTS 6
#define MINIRT_BINDING_IMAGES 7
#define MINIRT_BINDING_TEXELS 8
#define MINIRT_BINDING_MEDIA 9
#define MINIRT_BINDING_SPECTRUM 10
#define MINIRT_BINDING_EMITTERS 11
#define MINIRT_BINDING_ENVIRONMENT 12
#define MINIRT_BINDING_FILM 13
#define MINIRT_BINDING_RAY_COUNTS 14
#define MINIRT_BINDING_STATE 15
#define MINIRT_BINDING_COUNTERS 16
#define MINIRT_BINDING_QUEUES 17
#define MINIRT_BINDING_NODE_STORAGE 18
#define MINIRT_BINDING_PRIMITIVE_STORAGE 19
#define MINIRT_BINDING_COUNT 20

/* Specialisation constants: what differs between a CPU device and a GPU. */
#define MINIRT_SPEC_GROUP_SIZE 0
#define MINIRT_SPEC_STACK_IS_SHARED 1
#define MINIRT_SPEC_SHARED_STACK_WORDS 2
#define MINIRT_SPEC_PRIVATE_STACK_WORDS 3
#define MINIRT_SPEC_STEP_BUDGET 4
#define MINIRT_SPEC_INTERLEAVE_GROUPS 5
#define MINIRT_SPEC_STACK_LEVELS 6
#define MINIRT_SPEC_FETCH_TEXELS 7
#define MINIRT_SPEC_MASKS_LANES 8
#define MINIRT_SPEC_COUNT 9

/* Words of a pixel's saved state (shaders/common/suspend.glsl, shaders/whitted/walk.glsl, shaders/path/path.glsl); `volumes`: entries of a ray's VolumeList. */
#define MINIRT_WALK_WORDS(volumes) (21u + 2u * (volumes))
#define MINIRT_PATH_WORDS(volumes) (22u + 2u * (volumes))
#define MINIRT_TRAVERSAL_WORDS 10u
#define MINIRT_SEGMENT_WORDS(volumes) (10u + (volumes))

/* Words of the kernel whitted_shared (shaders/whitted/shared_work.glsl): counters, places of its queue, a segment with its pixel, sums of a pixel, a ring's own. */
#define MINIRT_SHARED_COUNTER_WORDS 128u
#define MINIRT_SHARED_QUEUE 262144u
#define MINIRT_SHARED_SEGMENT_WORDS(volumes) (11u + (volumes))
#define MINIRT_SHARED_SUM_WORDS 12u
#define MINIRT_SHARED_RING_WORDS 2u

/* Queues of the wavefront: each has a header, which an indirect dispatch reads: groups, 1, 1, paths; then come the paths of each.
   A round of an even number empties the first four, one of an odd number the last four. */
#define MINIRT_QUEUE_EVEN_RAYS 0u
#define MINIRT_QUEUE_EVEN_SHADOWS 1u
#define MINIRT_QUEUE_HITS 2u
#define MINIRT_QUEUE_MISSES 3u
#define MINIRT_QUEUE_ODD_RAYS 4u
#define MINIRT_QUEUE_ODD_SHADOWS 5u
#define MINIRT_QUEUE_COUNT 6u
#define MINIRT_QUEUE_HEADER_WORDS 4u

/* Node references. */
#define MINIRT_LEAF 0x80000000u

/* In the w of a primitive's first row. */
#define MINIRT_PRIMITIVE_SPHERE 0x80000000u

#define MINIRT_MATERIAL_FRESNEL 1u
#define MINIRT_MATERIAL_CHECKER 2u
#define MINIRT_MATERIAL_THIN 4u
#define MINIRT_MATERIAL_CLEAR_SHADOWS 8u
#define MINIRT_MATERIAL_PHYSICAL 16u
#define MINIRT_MATERIAL_ALPHA_MASK 32u
#define MINIRT_MATERIAL_ALPHA_BLEND 64u
#define MINIRT_MATERIAL_SHINES_BOTH_WAYS 128u

#define MINIRT_LIGHT_DIRECTIONAL 1u
#define MINIRT_LIGHT_INVERSE_SQUARE 2u
#define MINIRT_LIGHT_SPOT 4u

/* What an entry of section "EMITTERS" stands for: a primitive, a light or the environment in the upper two bits; below them its number. */
#define MINIRT_EMITTER_PRIMITIVE 0u
#define MINIRT_EMITTER_LIGHT 0x40000000u
#define MINIRT_EMITTER_ENVIRONMENT 0x80000000u
#define MINIRT_EMITTER_INDEX 0x3fffffffu

/* Of minirt_frame.sampling.y; above them is how light is found: lights are picked and surfaces followed, weighed by the power or the balance
   heuristic, or only one of both. */
#define MINIRT_FRAME_CAMERA_INSIDE 1u
#define MINIRT_FRAME_LIGHTS_SHIFT 8
#define MINIRT_LIGHT_SAMPLING_MIS 0u
#define MINIRT_LIGHT_SAMPLING_MIS_BALANCE 1u
#define MINIRT_LIGHT_SAMPLING_LIGHTS 2u
#define MINIRT_LIGHT_SAMPLING_SURFACES 3u

#define MINIRT_FILTER_BOX 0u
#define MINIRT_FILTER_TENT 1u
#define MINIRT_FILTER_GAUSSIAN 2u

#define MINIRT_IMAGE_REPEAT_V 1u
#define MINIRT_IMAGE_CLAMP_U 2u
#define MINIRT_IMAGE_MIRROR_U 4u
#define MINIRT_IMAGE_MIRROR_V 8u

/* Section "SPECTRUM" has 2^BITS equally likely wavelengths, by which white light is sampled: a row each. rgb: colour, white in the mean
   of all; w: 1 / wavelength^2 in 1/um^2. */
#define MINIRT_SPECTRUM_BITS 10u

/* Rows of 16 bytes of an element in its texel buffer. */
#define MINIRT_PRIMITIVE_ROWS 3
#define MINIRT_NORMAL_ROWS 3
#define MINIRT_UV_ROWS 2
#define MINIRT_MATERIAL_ROWS 10
#define MINIRT_LIGHT_ROWS 4
#define MINIRT_IMAGE_ROWS 2
#define MINIRT_MEDIUM_ROWS 6
#define MINIRT_PICK_ROWS 1

/* What a kernel reads of the scene as a whole. Positions in the blob are relative to minirt_scene_desc::origin ("scene space"). */
struct minirt_scene_rows {
    minirt_vec4 gridOrigin; /* xyz: position of plane 0 of the nodes' boxes */
    minirt_vec4 gridScale;  /* xyz: metres between planes */
    minirt_vec4 gridPlanes; /* xyz: the largest plane number in use */
    minirt_vec4 background; /* rgb: radiance, or the factor of the image; w: rotation of the image in turns */
    minirt_vec4 boundsMin;  /* xyz: of all volumes, scene space */
    minirt_vec4 boundsMax;
    minirt_uvec4 counts;      /* x: lights, y: background image or MINIRT_NONE, z: volumes, w: emitters */
    minirt_uvec4 environment; /* x, y: columns and rows of picks; z: bits of the probability to be picked; w: MINIRT_FILTER_ */
};

struct minirt_material {
    minirt_vec4 diffuse;  /* rgb: radiance per irradiance; w: exponent of the highlight */
    minirt_vec4 specular; /* rgb: weight of the highlight; w: index of refraction */
    minirt_vec4 reflect;  /* rgb: weight of the mirror ray */
    minirt_vec4 transmit; /* rgb: weight of the refracted ray; w: alpha */
    minirt_vec4 emission; /* rgb: radiance; w: density over area with which a point is picked as a light, 1/m^2 */
    minirt_vec4 checker;  /* xyz: added to scene-space positions; w: cell size in metres */
    minirt_uvec4 options; /* x: MINIRT_MATERIAL_ flags; y: image times diffuse and base or MINIRT_NONE; z, w: of a checker */
    minirt_vec4 base;     /* rgb: base colour; w: metallic */
    minirt_vec4 finish;  /* x: roughness, y: transmission, z: strength of the normal map, w: alpha below which a mask is a hole */
    minirt_uvec4 images; /* x: roughness (green) and metallic (blue), y: normals, z: emission; or MINIRT_NONE */
};

struct minirt_light {
    minirt_vec4 position;  /* xyz: scene space, or the unit direction towards a directional light; w: cosine where a spot ends */
    minirt_vec4 intensity; /* rgb: W/sr, or W/m^2 of a directional light; w: cosine up to which a spot is full */
    minirt_vec4 axis;      /* xyz: unit direction into which a spot shines */
    minirt_uvec4 options;  /* x: MINIRT_LIGHT_ flags */
};

/* An entry of a table that picks by weight (Walker 1977, Vose 1991: the alias method). Section "EMITTERS" picks lights by their power,
   "ENVIRON" cells of the environment: of equal width in longitude and equal height in latitude, row by row from +Y, the first from u = 0. */
struct minirt_pick {
    minirt_uvec4 entry; /* x: MINIRT_EMITTER_, y: entry instead, z: where 32 random bits reach this, w: bits of the probability */
};

struct minirt_image {
    minirt_uvec4 extent; /* x: width, y: height, z: first texel, w: MINIRT_IMAGE_ flags */
    minirt_vec4 scale;   /* x: factor of the stored texels */
};

/* Medium 0 surrounds the scene; medium v + 1 fills volume v. */
struct minirt_medium {
    minirt_vec4 absorption;  /* rgb: 1/m; w: share of the light taken away that comes back as the medium's own */
    minirt_vec4 ior;         /* rgb: index of refraction for each channel by itself; w: for all light */
    minirt_vec4 iorCurve;    /* index of refraction at c = 1 / wavelength^2 in 1/um^2: terms in c^-1, 1, c, c^2 */
    minirt_vec4 iorCurveEnd; /* x: in c^3, y: in c^4 */
    minirt_vec4 boundsMin;   /* xyz: of the volume, scene space */
    minirt_vec4 boundsMax;
};

/* Pushed with each dispatch. */
struct minirt_frame {
    minirt_vec4 position;  /* xyz: camera in scene space; w: rays with no larger throughput are weak */
    minirt_vec4 forward;   /* unit; w: radius of the lens */
    minirt_vec4 right;     /* scaled to the half width of the image at distance 1; w: distance in focus */
    minirt_vec4 up;        /* scaled to its half height; w: limit of what one path may add, 0: none */
    minirt_uvec4 size;     /* x, y: image; z: room for waiting segments or in a queue; w: 1 in the last pass */
    minirt_uvec4 region;   /* x, y: first pixel; z, w: one past the last */
    minirt_uvec4 blocks;   /* x: first of this dispatch, y: in a row, z: seed, w: words of state a slot, or slots */
    minirt_uvec4 sampling; /* x: sample index, y: MINIRT_FRAME_ flags, z: depth limit, w: 1 goes on, 2 ends; parity */
};

struct minirt_counters {
    MINIRT_UINT pending;          /* pixels that saved their state in this dispatch */
    MINIRT_UINT nan_pixels;       /* samples that were NaN and count as black */
    MINIRT_UINT segment_overflow; /* rays dropped because the state had no room */
    MINIRT_UINT unfinished;       /* pixels that were pending in the last pass they get */
    MINIRT_UINT volume_overflow;  /* boundaries passed over because a ray was in more volumes than its list holds */
    MINIRT_UINT reserved0;
    MINIRT_UINT reserved1;
    MINIRT_UINT reserved2;
};
/* layout-end */

/* The blob: this header, the section table, then the sections, each aligned to MINIRT_SECTION_ALIGNMENT. Little endian. */
#define MINIRT_SIGNATURE "\xABMRT1\r\n\x1A\n\0\0\0"
#define MINIRT_SIGNATURE_SIZE 12
#define MINIRT_ENDIAN_MARK 0x01020304u
#define MINIRT_SECTION_ALIGNMENT 256u
#define MINIRT_MAX_SECTIONS 32u

typedef struct minirt_blob_header {
    uint8_t signature[MINIRT_SIGNATURE_SIZE];
    uint32_t version;
    uint32_t endian;
    uint32_t section_count;
    uint64_t total_size; /* of the file, a multiple of the alignment */
    uint64_t checksum;   /* minirt_checksum of header and table up to the first section, with this field 0 */
    uint64_t reserved[3];
} minirt_blob_header;

typedef struct minirt_blob_section {
    char tag[8]; /* padded with blanks */
    uint64_t offset;
    uint64_t size;     /* without the padding that follows */
    uint64_t checksum; /* minirt_checksum of the section with its padding */
} minirt_blob_section;

typedef enum minirt_integrator {
    MINIRT_INTEGRATOR_SCENE = 0, /* the one that the scene names; of two that draw the same, the one for this class of devices */
    MINIRT_INTEGRATOR_WHITTED = 1,
    MINIRT_INTEGRATOR_PATH = 2,
    MINIRT_INTEGRATOR_WAVEFRONT = 3,     /* paths, by several kernels */
    MINIRT_INTEGRATOR_WHITTED_SHARED = 4 /* Whitted's trees, shared by a GPU's lanes; elsewhere WHITTED */
} minirt_integrator;

typedef enum minirt_node_layout { MINIRT_NODES_QUANTISED = 0, MINIRT_NODES_FLOAT = 1 } minirt_node_layout;

/* World space, right-handed. */
typedef struct minirt_camera {
    double position[3];
    double target[3];
    double up[3];
    double vfov;           /* degrees, of the image's height */
    double aperture;       /* diameter of the lens in metres; 0: a pinhole. The path tracers' only */
    double focus_distance; /* of the plane in focus in metres, along the view */
} minirt_camera;

/* Section "SCENE": what the host needs to know. */
typedef struct minirt_scene_desc {
    double origin[3];                    /* world position of scene-space zero */
    double bounds_min[3], bounds_max[3]; /* scene space */
    minirt_camera camera;
    uint32_t width, height, samples, max_depth; /* defaults of a rendering */
    uint32_t integrator;                        /* minirt_integrator */
    uint32_t node_layout;                       /* minirt_node_layout */
    uint32_t bvh_depth;                         /* entries that a traversal's stack needs */
    float throughput_cutoff;
    uint32_t volume_capacity; /* entries of a ray's list of volumes; 0: kernels keep none */
    uint32_t reserved_word;
    uint64_t reserved[3];
} minirt_scene_desc;

/* Section "KERNELS": an entry a kernel; its SPIR-V is in section "SPIRV". */
typedef struct minirt_kernel {
    char name[16];
    uint64_t spirv_offset, spirv_size; /* bytes in section "SPIRV", multiples of 4 */
    uint32_t bindings;                 /* bit b: the kernel uses binding b */
    uint32_t waits; /* 0: no ray waits for another; else a pixel's list holds the depth limit + waits - 1 of them */
    uint64_t reserved[3];
} minirt_kernel;

typedef struct minirt_scene_rows minirt_scene_rows;
typedef struct minirt_material minirt_material;
typedef struct minirt_light minirt_light;
typedef struct minirt_image minirt_image;
typedef struct minirt_medium minirt_medium;
typedef struct minirt_pick minirt_pick;
typedef struct minirt_frame minirt_frame;
typedef struct minirt_counters minirt_counters;

/* >>api */
typedef enum minirt_result {
    MINIRT_OK = 0,
    MINIRT_ERROR_INVALID_ARGUMENT,
    MINIRT_ERROR_OUT_OF_MEMORY,
    MINIRT_ERROR_NO_VULKAN,
    MINIRT_ERROR_NO_DEVICE,
    MINIRT_ERROR_DEVICE_UNSUPPORTED,
    MINIRT_ERROR_DEVICE_OUT_OF_MEMORY,
    MINIRT_ERROR_DEVICE_LOST,
    MINIRT_ERROR_VULKAN,
    MINIRT_ERROR_FILE,
    MINIRT_ERROR_NOT_A_BLOB,
    MINIRT_ERROR_VERSION,
    MINIRT_ERROR_TRUNCATED,
    MINIRT_ERROR_CHECKSUM,
    MINIRT_ERROR_SECTION_OUT_OF_BOUNDS,
    MINIRT_ERROR_SECTION_MISSING,
    MINIRT_ERROR_CORRUPT,
    MINIRT_ERROR_NO_KERNEL,
    MINIRT_ERROR_BUSY,
    MINIRT_CANCELLED
} minirt_result;

/* A constant English phrase, never NULL. */
MINIRT_API const char* minirt_result_string(minirt_result result);

typedef struct minirt_context minirt_context; /* a device */
typedef struct minirt_scene minirt_scene;     /* a blob on the device */
typedef struct minirt_job minirt_job;         /* a rendering in progress */

typedef enum minirt_log_level { MINIRT_LOG_ERROR = 0, MINIRT_LOG_WARNING = 1, MINIRT_LOG_VALIDATION = 2 } minirt_log_level;
typedef void (*minirt_log_callback)(void* user, minirt_log_level level, const char* message);

/* Host memory. Both callbacks or none; `allocate` returns NULL when out of memory, aligned as malloc's. */
typedef struct minirt_allocator {
    void* (*allocate)(void* user, size_t size);
    void (*release)(void* user, void* memory);
    void* user;
} minirt_allocator;

/* The host's own device, which it keeps and destroys after the context. All fields up to the queue or none (get_instance_proc_addr alone is
   also fine). The queue must support compute; no other thread may use it during a call. Vulkan 1.1 or later. */
typedef struct minirt_host_device {
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    VkQueue queue;
    uint32_t queue_family;
    int shader_float64; /* 1: the device has the feature shaderFloat64 enabled, which kernels in double precision need */
} minirt_host_device;

typedef struct minirt_context_desc {
    const char* device_name; /* a part of the device's name, or its number from minirt_list_devices; NULL: the best */
    minirt_log_callback log; /* may be NULL */
    void* log_user;
    minirt_allocator allocator;
    minirt_host_device host;
    int validation; /* 1: with the Khronos validation layer where it is installed, 2: its GPU-assisted checks too; messages go to log */
} minirt_context_desc;

typedef struct minirt_device_info {
    char name[256];
    char driver[256];
    uint32_t api_version, driver_version;
    int is_cpu;
    uint64_t memory_bytes; /* of the largest device-local heap */
} minirt_device_info;

/* Devices that can render, best first. `count`: in, room in `infos`; out, the number of devices. infos may be NULL. */
MINIRT_API minirt_result minirt_list_devices(const minirt_context_desc* desc, minirt_device_info* infos, uint32_t* count);

/* Opens a device. On failure *out is NULL and nothing is left behind. */
MINIRT_API minirt_result minirt_create(const minirt_context_desc* desc, minirt_context** out);
/* Frees the context, its scenes and their jobs. NULL is fine. */
MINIRT_API void minirt_destroy(minirt_context* context);
/* What went wrong last, for people; "" if nothing did or context is NULL. Valid until the next call on the context. */
MINIRT_API const char* minirt_last_message(const minirt_context* context);
MINIRT_API void minirt_get_device_info(const minirt_context* context, minirt_device_info* info);

/* Typed pointers into a valid blob; NULL where the section is absent. Counts are of elements. */
typedef struct minirt_blob {
    const minirt_scene_desc* scene;
    const minirt_scene_rows* rows;
    const uint32_t* nodes; /* 8 words each, or 16 (MINIRT_NODES_FLOAT) */
    const minirt_vec4*
        primitives; /* 3 rows each; w: material | MINIRT_PRIMITIVE_SPHERE, body (volumes first), corners or MINIRT_NONE */
    const minirt_vec4* normals; /* 3 rows each: the corners' unit normals */
    const minirt_vec4* uvs;     /* 2 rows each: u0 v0 u1 v1, u2 v2 0 0 */
    const minirt_material* materials;
    const minirt_light* lights;
    const minirt_image* images;
    const minirt_medium* media;     /* one more than there are volumes, or none at all */
    const minirt_vec4* spectrum;    /* 2^MINIRT_SPECTRUM_BITS rows, or none */
    const minirt_pick* emitters;    /* lights to pick from, or none */
    const minirt_pick* environment; /* cells of the environment to pick from, or none */
    const uint16_t* texels;         /* 4 half floats each: linear rgba */
    const minirt_kernel* kernels;
    const uint8_t* spirv;
    const char* explain; /* JSON: effects with their reasons, objects, sizes (docs/blob_format.md); not terminated */
    uint64_t node_count, primitive_count, normal_count, uv_count, material_count, light_count, image_count, medium_count,
        spectrum_count, emitter_count, environment_count, texel_count, kernel_count, spirv_size, explain_size, total_size;
} minirt_blob;

typedef struct minirt_validation {
    char message[192]; /* what is wrong and where; "" when valid */
} minirt_validation;

/* Checks a blob completely (bounds, checksums, references, numbers) and gives its parts: no Vulkan, no allocation beyond one scratch
   array. `data` must be aligned to 16 bytes. Out-parameters may be NULL. SPIR-V is checked for its envelope only: load blobs from
   sources that you trust to run code on your device (docs/threat_model.md). */
MINIRT_API minirt_result minirt_validate(const void* data, size_t size, minirt_blob* blob, minirt_validation* validation);

/* 64-bit checksum of `size` bytes, a multiple of 32; any change of one byte changes it. */
MINIRT_API uint64_t minirt_checksum(const void* data, size_t size);
/* What belongs into minirt_blob_header::checksum: of the first `size` bytes (header, table, padding; at least 64), that field counted as 0. */
MINIRT_API uint64_t minirt_header_checksum(const void* data, size_t size);

/* Validates and uploads. The data may be freed afterwards. On failure *out is NULL. */
MINIRT_API minirt_result minirt_load_memory(minirt_context* context, const void* data, size_t size, minirt_scene** out);
MINIRT_API minirt_result minirt_load_file(minirt_context* context, const char* path, minirt_scene** out);
MINIRT_API void minirt_unload(minirt_scene* scene);
MINIRT_API void minirt_get_scene_desc(const minirt_scene* scene, minirt_scene_desc* desc);

typedef struct minirt_stats {
    uint32_t width, height, samples;
    double wall_ms;     /* from minirt_begin to the last step */
    double gpu_ms;      /* dispatches, by the device's clock where it has one */
    double pipeline_ms; /* pipeline creation and first dispatch */
    double load_ms;     /* reading and validating the blob */
    double upload_ms;   /* at the same time, where there are threads */
    uint64_t primary_rays, shadow_rays, secondary_rays;
    uint64_t nan_pixels, volume_overflow, segment_overflow;
    uint64_t traversal_cap; /* pixels left unfinished: only minirt_record, and only when its passes were too few */
    uint64_t dispatches, resumed_dispatches;
} minirt_stats;

typedef struct minirt_progress {
    int done;
    double fraction;       /* 0..1 */
    uint32_t samples_done; /* complete samples of every pixel */
} minirt_progress;

/* Called between dispatches; return non-zero to cancel. */
typedef int (*minirt_progress_callback)(void* user, const minirt_progress* progress);

typedef struct minirt_region {
    uint32_t x, y, width, height;
} minirt_region;

typedef struct minirt_render_desc {
    uint32_t width, height;       /* both 0: the scene's */
    uint32_t samples;             /* a pixel; 0: the scene's */
    uint32_t first_sample;        /* index of the first */
    uint32_t max_depth;           /* 0: the scene's; otherwise the limit plus one, so 1 means camera rays only */
    minirt_integrator integrator; /* 0: the scene's */
    uint32_t light_sampling;      /* of the path tracers: MINIRT_LIGHT_SAMPLING_; same mean, the first with the least noise */
    uint32_t seed;                /* of the path tracers and of Whitted's roulette: another one gives noise of its own */
    float throughput_cutoff;      /* of Whitted's tracer: rays that carry no more are weak; 0: the scene's, below 0: none is */
    float clamp;                  /* of the path tracers: what one sample of a pixel may add at most; 0: no limit, and no bias */
    const minirt_camera* camera;  /* NULL: the scene's */
    minirt_region region;         /* all zero: the whole image */
    float max_dispatch_ms;        /* 0: 100 */
    minirt_progress_callback progress; /* may be NULL */
    void* progress_user;
    minirt_stats* stats; /* may be NULL: written by minirt_render */
} minirt_render_desc;

/* Renders into `rgba`: width * height * 4 floats, top row first, linear radiance (mean of the samples), alpha 1.
   MINIRT_CANCELLED: the callback asked for it; rgba holds what is there so far. On other failures rgba is undefined. */
MINIRT_API minirt_result minirt_render(minirt_scene* scene, const minirt_render_desc* desc, float* rgba);

/* The same in steps. One job a scene at a time (else MINIRT_ERROR_BUSY). desc and its camera are copied. */
MINIRT_API minirt_result minirt_begin(minirt_scene* scene, const minirt_render_desc* desc, minirt_job** out);
/* Submits one dispatch and waits for it. `progress` may be NULL. After `done` it does nothing. */
MINIRT_API minirt_result minirt_step(minirt_job* job, minirt_progress* progress);
/* The picture so far; pixels without a sample are 0 with alpha 0. */
MINIRT_API minirt_result minirt_read(minirt_job* job, float* rgba);
MINIRT_API minirt_result minirt_get_stats(minirt_job* job, minirt_stats* stats);
MINIRT_API void minirt_end(minirt_job* job);

/* Records one sample (index `sample`) of the job's whole image into the host's command buffer and copies it into `image`
   (VK_FORMAT_R32G32B32A32_SFLOAT, usage TRANSFER_DST, layout TRANSFER_DST_OPTIMAL, at least as large as the job's image).
   `camera` NULL: the job's. Pixels that need more than `passes` (0: 4) budgets of steps stay incomplete and count in traversal_cap.
   A later minirt_step starts over with the job's own first sample. The host submits; the next call on the scene must wait until that has
   finished. */
MINIRT_API minirt_result minirt_record(minirt_job* job, VkCommandBuffer commands, VkImage image, const minirt_camera* camera,
                                       uint32_t sample, uint32_t passes);

#ifdef __cplusplus
}
#endif
#endif /* MINIRT_H */

/* >>implementation */
#if defined(MINIRT_IMPLEMENTATION) && !defined(MINIRT_IMPLEMENTATION_DONE)
#define MINIRT_IMPLEMENTATION_DONE
#ifndef __cplusplus
#error "minirt.h: compile the file that defines MINIRT_IMPLEMENTATION as C++17"
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <chrono>
#include <new>
#include <type_traits>

/* Without exceptions a thread that the system refuses would end the program. */
#if !defined(MINIRT_NO_THREADS) && defined(__cpp_exceptions)
#define MINIRT_HAS_THREADS
#include <thread>
#endif
#if !defined(MINIRT_NO_DLOPEN)
#if defined(_WIN32)
extern "C" __declspec(dllimport) void* __stdcall LoadLibraryA(const char*);
extern "C" __declspec(dllimport) void* __stdcall GetProcAddress(void*, const char*);
extern "C" __declspec(dllimport) int __stdcall FreeLibrary(void*);
#else
#include <dlfcn.h>
#endif
#endif
#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#define MINIRT_HAS_MMAP
#endif

static_assert(sizeof(minirt_blob_header) == 64, "layout of the blob");
static_assert(sizeof(minirt_blob_section) == 32, "layout of the blob");
static_assert(sizeof(minirt_scene_desc) == 232, "layout of the blob");
static_assert(sizeof(minirt_kernel) == 64, "layout of the blob");
static_assert(sizeof(minirt_scene_rows) == 128, "layout shared with shaders");
static_assert(sizeof(minirt_material) == 160, "layout shared with shaders");
static_assert(sizeof(minirt_light) == 64, "layout shared with shaders");
static_assert(sizeof(minirt_image) == 32, "layout shared with shaders");
static_assert(sizeof(minirt_pick) == 16, "layout shared with shaders");
static_assert(sizeof(minirt_medium) == 96, "layout shared with shaders");
static_assert(sizeof(minirt_frame) == 128, "the push constants that every device has");
static_assert(std::is_trivially_copyable<minirt_scene_desc>::value, "read from files");

namespace minirt_detail {

inline double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <typename T>
T smaller(T a, T b) {
    return a < b ? a : b;
}
template <typename T>
T larger(T a, T b) {
    return a > b ? a : b;
}

/* >>implementation-allocation */
inline void* hostAllocate(const minirt_allocator& allocator, size_t size) {
    return allocator.allocate ? allocator.allocate(allocator.user, size) : malloc(size);
}

inline void hostRelease(const minirt_allocator& allocator, void* memory) {
    if (!memory) return;
    if (allocator.release)
        allocator.release(allocator.user, memory);
    else
        free(memory);
}

template <typename T>
T* hostNew(const minirt_allocator& allocator) {
    void* memory = hostAllocate(allocator, sizeof(T));
    return memory ? new (memory) T() : nullptr;
}

template <typename T>
void hostDelete(const minirt_allocator& allocator, T* object) {
    if (!object) return;
    object->~T();
    hostRelease(allocator, object);
}

/* >>implementation-threads */
constexpr uint32_t kMostTasks = 6;

#if defined(MINIRT_HAS_THREADS)
/* task(i) on a thread of its own, or at once where the system gives none: then what is returned cannot be joined. */
template <typename Task>
std::thread startThread(const Task& task, uint32_t i) {
    try {
        return std::thread(task, i);
    } catch (...) {
        task(i);
        return std::thread();
    }
}
#endif

/* Runs task(0) on this thread and task(1) .. task(count - 1) on others; returns when all are done. */
template <typename Task>
void atOnce(uint32_t count, const Task& task) {
#if !defined(MINIRT_HAS_THREADS)
    for (uint32_t i = 0; i < count; ++i) task(i);
#else
    std::thread threads[kMostTasks];
    for (uint32_t i = 1; i < count; ++i) threads[i] = startThread(task, i);
    if (count) task(0);
    for (std::thread& thread : threads)
        if (thread.joinable()) thread.join();
#endif
}

/* >>implementation-validation */
struct BlobReader {
    const uint8_t* data;
    size_t size;
    minirt_blob_header header;
    minirt_validation* validation;
    minirt_result result = MINIRT_OK;

    minirt_result fail(minirt_result code, const char* format, uint64_t a = 0, uint64_t b = 0) {
        result = code;
        if (validation) {
            snprintf(validation->message, sizeof validation->message, format, static_cast<unsigned long long>(a),
                     static_cast<unsigned long long>(b));
        }
        return code;
    }
};

inline uint64_t mixLane(uint64_t lane, uint64_t word) {
    lane = (lane ^ word) * 0x9E3779B185EBCA87ull;
    return lane ^ (lane >> 29);
}

/* Negative where one of the floats has an exponent of all ones: one more carries into the sign. */
template <uint64_t kUsed>
int32_t nonFinite(const uint32_t* words) {
    uint32_t bits = 0;
    for (uint64_t k = 0; k < kUsed; ++k) bits |= (words[k] & 0x7f800000u) + 0x00800000u;
    return static_cast<int32_t>(bits);
}

/* Index of the first element with a float that is not finite, or count: of kStride words, the first kUsed are floats. Looks at all before it asks
   which, as loops without a way out run on vectors. */
template <uint64_t kStride, uint64_t kUsed>
uint64_t firstNonFinite(const void* data, uint64_t count) {
    const uint32_t* words = static_cast<const uint32_t*>(data);
    int32_t all = 0;
    for (uint64_t i = 0; i < count; ++i) all |= nonFinite<kUsed>(words + i * kStride);
    for (uint64_t i = 0; all < 0 && i < count; ++i)
        if (nonFinite<kUsed>(words + i * kStride) < 0) return i;
    return count;
}

inline minirt_result readHeader(BlobReader& r) {
    if (r.size < sizeof r.header) {
        return r.size >= MINIRT_SIGNATURE_SIZE && memcmp(r.data, MINIRT_SIGNATURE, MINIRT_SIGNATURE_SIZE) == 0
                   ? r.fail(MINIRT_ERROR_TRUNCATED, "the file ends inside the header (%llu bytes); bake it again", r.size)
                   : r.fail(MINIRT_ERROR_NOT_A_BLOB, "no minirt blob: %llu bytes without the signature", r.size);
    }
    memcpy(&r.header, r.data, sizeof r.header);
    if (memcmp(r.header.signature, MINIRT_SIGNATURE, MINIRT_SIGNATURE_SIZE) != 0)
        return r.fail(MINIRT_ERROR_NOT_A_BLOB, "no minirt blob: the signature is missing");
    if (r.header.endian != MINIRT_ENDIAN_MARK) return r.fail(MINIRT_ERROR_VERSION, "the blob has another byte order");
    if (r.header.version != MINIRT_FORMAT_VERSION)
        return r.fail(MINIRT_ERROR_VERSION, "format version %llu, this header reads %llu; bake the scene again", r.header.version,
                      MINIRT_FORMAT_VERSION);
    if (r.header.total_size > r.size)
        return r.fail(MINIRT_ERROR_TRUNCATED, "the blob has %llu bytes, its header says %llu; bake it again", r.size,
                      r.header.total_size);
    if (r.header.total_size < r.size)
        return r.fail(MINIRT_ERROR_TRUNCATED, "%llu bytes where the header says %llu; bake it again", r.size,
                      r.header.total_size);
    if (r.header.section_count == 0 || r.header.section_count > MINIRT_MAX_SECTIONS)
        return r.fail(MINIRT_ERROR_CORRUPT, "%llu sections; 1 to %llu are possible", r.header.section_count, MINIRT_MAX_SECTIONS);
    return MINIRT_OK;
}

inline uint64_t alignSection(uint64_t size) {
    return (size + (MINIRT_SECTION_ALIGNMENT - 1)) & ~uint64_t(MINIRT_SECTION_ALIGNMENT - 1);
}

inline minirt_result readTable(BlobReader& r, minirt_blob_section* table) {
    const uint64_t tableEnd = sizeof r.header + uint64_t(r.header.section_count) * sizeof(minirt_blob_section);
    const uint64_t headerSize = alignSection(tableEnd);
    if (headerSize > r.size) return r.fail(MINIRT_ERROR_TRUNCATED, "the file ends inside the section table; bake it again");
    if (minirt_header_checksum(r.data, static_cast<size_t>(headerSize)) != r.header.checksum)
        return r.fail(MINIRT_ERROR_CHECKSUM, "header or section table are damaged; bake the scene again");
    memcpy(table, r.data + sizeof r.header, r.header.section_count * sizeof(minirt_blob_section));
    uint64_t expected = headerSize;
    for (uint32_t i = 0; i < r.header.section_count; ++i) {
        const minirt_blob_section& s = table[i];
        if (s.offset != expected || s.offset > r.size || s.size > r.size - s.offset || alignSection(s.size) > r.size - s.offset)
            return r.fail(MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section %llu lies outside of the file", i);
        expected = s.offset + alignSection(s.size);
    }
    if (expected != r.size) return r.fail(MINIRT_ERROR_TRUNCATED, "%llu bytes of sections in a file of %llu", expected, r.size);
    return MINIRT_OK;
}

inline minirt_result checkSums(BlobReader& r, const minirt_blob_section* table) {
    for (uint32_t i = 0; i < r.header.section_count; ++i) {
        if (minirt_checksum(r.data + table[i].offset, static_cast<size_t>(alignSection(table[i].size))) != table[i].checksum)
            return r.fail(MINIRT_ERROR_CHECKSUM, "section %llu is damaged; bake the scene again", i);
    }
    return MINIRT_OK;
}

/* Finds sections by tag and hands out typed pointers; the first failure sticks. */
struct SectionFinder {
    BlobReader& reader;
    const minirt_blob_section* table;

    template <typename T>
    const T* find(const char* tag, uint64_t stride, uint64_t* count, bool required) {
        char padded[9];
        snprintf(padded, sizeof padded, "%-8s", tag);
        for (uint32_t i = 0; i < reader.header.section_count; ++i) {
            if (memcmp(table[i].tag, padded, 8) != 0) continue;
            if (table[i].size % stride != 0 || table[i].size == 0) {
                if (!reader.result)
                    reader.fail(MINIRT_ERROR_CORRUPT, "section %llu has a size of %llu bytes, which does not fit its kind", i,
                                table[i].size);
                return nullptr;
            }
            *count = table[i].size / stride;
            return static_cast<const T*>(static_cast<const void*>(reader.data + table[i].offset));
        }
        if (required && !reader.result) {
            reader.fail(MINIRT_ERROR_SECTION_MISSING, "a section is missing");
            if (reader.validation)
                snprintf(reader.validation->message, sizeof reader.validation->message, "section %s is missing", tag);
        }
        return nullptr;
    }
};

inline minirt_result findSections(BlobReader& r, const minirt_blob_section* table, minirt_blob& blob) {
    SectionFinder finder{r, table};
    uint64_t one = 0;
    uint64_t rows = 0;
    blob.scene = finder.find<minirt_scene_desc>("SCENE", sizeof(minirt_scene_desc), &one, true);
    blob.rows = finder.find<minirt_scene_rows>("ROWS", sizeof(minirt_scene_rows), &rows, true);
    if (r.result) return r.result;
    if (one != 1 || rows != 1) return r.fail(MINIRT_ERROR_CORRUPT, "more than one scene");
    if (blob.scene->node_layout > MINIRT_NODES_FLOAT)
        return r.fail(MINIRT_ERROR_CORRUPT, "unknown node layout %llu", blob.scene->node_layout);
    const uint64_t nodeBytes = blob.scene->node_layout == MINIRT_NODES_FLOAT ? 64 : 32;
    blob.nodes = finder.find<uint32_t>("NODES", nodeBytes, &blob.node_count, true);
    blob.primitives = finder.find<minirt_vec4>("PRIMS", 48, &blob.primitive_count, true);
    blob.normals = finder.find<minirt_vec4>("NORMALS", MINIRT_NORMAL_ROWS * uint64_t(16), &blob.normal_count, false);
    blob.uvs = finder.find<minirt_vec4>("UVS", MINIRT_UV_ROWS * uint64_t(16), &blob.uv_count, false);
    blob.materials = finder.find<minirt_material>("MATERIAL", sizeof(minirt_material), &blob.material_count, true);
    blob.lights = finder.find<minirt_light>("LIGHTS", sizeof(minirt_light), &blob.light_count, false);
    blob.images = finder.find<minirt_image>("IMAGES", sizeof(minirt_image), &blob.image_count, false);
    blob.media = finder.find<minirt_medium>("MEDIA", sizeof(minirt_medium), &blob.medium_count, false);
    blob.spectrum = finder.find<minirt_vec4>("SPECTRUM", 16, &blob.spectrum_count, false);
    blob.emitters = finder.find<minirt_pick>("EMITTERS", sizeof(minirt_pick), &blob.emitter_count, false);
    blob.environment = finder.find<minirt_pick>("ENVIRON", sizeof(minirt_pick), &blob.environment_count, false);
    blob.texels = finder.find<uint16_t>("TEXELS", 8, &blob.texel_count, false);
    blob.kernels = finder.find<minirt_kernel>("KERNELS", sizeof(minirt_kernel), &blob.kernel_count, true);
    blob.spirv = finder.find<uint8_t>("SPIRV", 4, &blob.spirv_size, true);
    blob.explain = finder.find<char>("EXPLAIN", 1, &blob.explain_size, true);
    blob.spirv_size *= 4;
    blob.total_size = r.size;
    return r.result;
}

inline bool finiteDoubles(const double* values, int count) {
    for (int i = 0; i < count; ++i)
        if (!isfinite(values[i])) return false;
    return true;
}

/* Of bits of a float: 0 to 1. */
inline bool isProbability(uint32_t bits) {
    return bits <= 0x3f800000u;
}

inline minirt_result checkScene(BlobReader& r, const minirt_blob& b) {
    const minirt_scene_desc& s = *b.scene;
    if (!finiteDoubles(s.origin, 9) || !finiteDoubles(s.camera.position, 12) || !isfinite(s.throughput_cutoff) ||
        s.throughput_cutoff < 0)
        return r.fail(MINIRT_ERROR_CORRUPT, "the scene holds a number that is not finite");
    if (s.width == 0 || s.height == 0 || s.width > 16384 || s.height > 16384 || s.samples == 0 || s.max_depth > 255)
        return r.fail(MINIRT_ERROR_CORRUPT, "defaults of the rendering are out of range");
    if (s.camera.aperture < 0 || s.camera.focus_distance <= 0) return r.fail(MINIRT_ERROR_CORRUPT, "a lens that is none");
    if (s.integrator < MINIRT_INTEGRATOR_WHITTED || s.integrator > MINIRT_INTEGRATOR_WHITTED_SHARED)
        return r.fail(MINIRT_ERROR_CORRUPT, "unknown integrator %llu", s.integrator);
    if (s.bvh_depth == 0 || s.bvh_depth > 64) return r.fail(MINIRT_ERROR_CORRUPT, "a hierarchy of depth %llu", s.bvh_depth);
    const minirt_scene_rows& rows = *b.rows;
    if (firstNonFinite<24, 24>(&rows, 1) != 1)
        return r.fail(MINIRT_ERROR_CORRUPT, "the scene's rows hold a number that is not finite");
    if (rows.gridScale.x <= 0 || rows.gridScale.y <= 0 || rows.gridScale.z <= 0)
        return r.fail(MINIRT_ERROR_CORRUPT, "a grid of no size");
    if (rows.counts.x != b.light_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "%llu lights in a section of %llu", rows.counts.x, b.light_count);
    if (b.medium_count && b.medium_count != uint64_t(rows.counts.z) + 1)
        return r.fail(MINIRT_ERROR_CORRUPT, "%llu volumes and %llu media", rows.counts.z, b.medium_count);
    if (s.volume_capacity > 64) return r.fail(MINIRT_ERROR_CORRUPT, "lists of %llu volumes", s.volume_capacity);
    if (rows.counts.y != MINIRT_NONE && rows.counts.y >= b.image_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "no background image %llu", rows.counts.y);
    if (rows.counts.w != b.emitter_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "%llu emitters in a section of %llu", rows.counts.w, b.emitter_count);
    if (uint64_t(rows.environment.x) * rows.environment.y != b.environment_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "%llu columns of the environment do not fit its %llu cells", rows.environment.x,
                      b.environment_count);
    if (!isProbability(rows.environment.z) || rows.environment.w > MINIRT_FILTER_GAUSSIAN)
        return r.fail(MINIRT_ERROR_CORRUPT, "no such filter, or no such probability of the environment");
    return MINIRT_OK;
}

/* Every reference leads to a later node or into the primitives, no path is deeper than stated: traversal ends and stays in bounds. */
inline minirt_result checkNodes(BlobReader& r, const minirt_blob& b, uint8_t* depth) {
    const bool isFloat = b.scene->node_layout == MINIRT_NODES_FLOAT;
    const uint64_t words = isFloat ? 16 : 8;
    if (b.node_count >= MINIRT_LEAF) return r.fail(MINIRT_ERROR_CORRUPT, "%llu nodes are too many", b.node_count);
    memset(depth, 0, static_cast<size_t>(b.node_count));
    depth[0] = 1;
    for (uint64_t i = 0; i < b.node_count; ++i) {
        const uint32_t* node = b.nodes + i * words;
        if (depth[i] == 0) return r.fail(MINIRT_ERROR_CORRUPT, "node %llu has no parent before it", i);
        for (int child = 0; child < 2; ++child) {
            const uint32_t ref = node[3 + (isFloat ? 8 : 4) * child];
            if (ref & MINIRT_LEAF) {
                const uint64_t first = (ref & ~MINIRT_LEAF) >> 3;
                const uint64_t count = (ref & 7u) + 1;
                if (ref == 0xffffffffu || first >= b.primitive_count || count > b.primitive_count - first)
                    return r.fail(MINIRT_ERROR_CORRUPT, "a leaf of node %llu lies outside of the primitives", i);
            } else {
                if (ref <= i || ref >= b.node_count || depth[ref] != 0)
                    return r.fail(MINIRT_ERROR_CORRUPT, "node %llu has no valid child", i);
                if (depth[i] >= b.scene->bvh_depth)
                    return r.fail(MINIRT_ERROR_CORRUPT, "the hierarchy is deeper than %llu", b.scene->bvh_depth);
                depth[ref] = static_cast<uint8_t>(depth[i] + 1);
            }
        }
    }
    if (isFloat) {
        for (uint64_t row = 0; row < 4; ++row)
            if (firstNonFinite<16, 3>(b.nodes + row * 4, b.node_count) != b.node_count)
                return r.fail(MINIRT_ERROR_CORRUPT, "a node's box is not finite");
    }
    return MINIRT_OK;
}

inline uint32_t bitsOf(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

inline minirt_result checkPrimitives(BlobReader& r, const minirt_blob& b) {
    const uint64_t rows = b.primitive_count * 3;
    const uint64_t bad = firstNonFinite<4, 3>(b.primitives, rows);
    if (bad != rows) return r.fail(MINIRT_ERROR_CORRUPT, "primitive %llu holds a number that is not finite", bad / 3);
    const uint64_t cornerCount = b.normal_count ? b.normal_count : b.uv_count;
    if (b.normal_count && b.uv_count && b.normal_count != b.uv_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "normals and texture coordinates differ in number");
    for (uint64_t i = 0; i < b.primitive_count; ++i) {
        const uint32_t material = bitsOf(b.primitives[3 * i].w) & ~MINIRT_PRIMITIVE_SPHERE;
        const uint32_t corners = bitsOf(b.primitives[3 * i + 2].w);
        if (material >= b.material_count) return r.fail(MINIRT_ERROR_CORRUPT, "primitive %llu has no material", i);
        if (corners != MINIRT_NONE && corners >= cornerCount)
            return r.fail(MINIRT_ERROR_CORRUPT, "primitive %llu has no corners", i);
    }
    if (firstNonFinite<4, 4>(b.normals, b.normal_count * 3) != b.normal_count * 3)
        return r.fail(MINIRT_ERROR_CORRUPT, "a normal is not finite");
    if (firstNonFinite<4, 4>(b.uvs, b.uv_count * 2) != b.uv_count * 2)
        return r.fail(MINIRT_ERROR_CORRUPT, "a texture coordinate is not finite");
    return MINIRT_OK;
}

/* What an entry of "EMITTERS" stands for is there. */
inline bool isEmitter(const minirt_blob& b, uint32_t what) {
    const uint32_t index = what & MINIRT_EMITTER_INDEX;
    switch (what & ~MINIRT_EMITTER_INDEX) {
        case MINIRT_EMITTER_PRIMITIVE:
            return index < b.primitive_count;
        case MINIRT_EMITTER_LIGHT:
            return index < b.light_count;
        case MINIRT_EMITTER_ENVIRONMENT:
            return index == 0 && b.environment_count > 0;
        default:
            return false;
    }
}

inline minirt_result checkPicks(BlobReader& r, const minirt_blob& b) {
    for (uint64_t i = 0; i < b.emitter_count; ++i) {
        const minirt_uvec4& entry = b.emitters[i].entry;
        if (!isEmitter(b, entry.x) || entry.y >= b.emitter_count || !isProbability(entry.w))
            return r.fail(MINIRT_ERROR_CORRUPT, "emitter %llu is none", i);
    }
    for (uint64_t i = 0; i < b.environment_count; ++i) {
        const minirt_uvec4& entry = b.environment[i].entry;
        if (entry.x != 0 || entry.y >= b.environment_count || !isProbability(entry.w))
            return r.fail(MINIRT_ERROR_CORRUPT, "cell %llu of the environment is none", i);
    }
    return MINIRT_OK;
}

inline bool isImage(const minirt_blob& b, uint32_t image) {
    return image == MINIRT_NONE || image < b.image_count;
}

inline bool isPlainMaterial(const minirt_blob& b, uint32_t index) {
    return index < b.material_count && (b.materials[index].options.x & MINIRT_MATERIAL_CHECKER) == 0;
}

inline minirt_result checkAppearance(BlobReader& r, const minirt_blob& b) {
    for (uint64_t i = 0; i < b.material_count; ++i) {
        const minirt_material& m = b.materials[i];
        if (firstNonFinite<24, 24>(&m, 1) != 1 || firstNonFinite<8, 8>(&m.base, 1) != 1)
            return r.fail(MINIRT_ERROR_CORRUPT, "material %llu holds a number that is not finite", i);
        if (m.emission.w < 0) return r.fail(MINIRT_ERROR_CORRUPT, "material %llu is picked with a negative density", i);
        if (!isImage(b, m.options.y) || !isImage(b, m.images.x) || !isImage(b, m.images.y) || !isImage(b, m.images.z))
            return r.fail(MINIRT_ERROR_CORRUPT, "material %llu has no image", i);
        if ((m.options.x & MINIRT_MATERIAL_CHECKER) &&
            (!isPlainMaterial(b, m.options.z) || !isPlainMaterial(b, m.options.w) || m.checker.w <= 0))
            return r.fail(MINIRT_ERROR_CORRUPT, "material %llu is no valid checker", i);
    }
    if (b.light_count && firstNonFinite<16, 12>(b.lights, b.light_count) != b.light_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "a light is not finite");
    for (uint64_t i = 0; i < b.image_count; ++i) {
        const minirt_image& image = b.images[i];
        const uint64_t texels = uint64_t(image.extent.x) * image.extent.y;
        if (texels == 0 || image.extent.z > b.texel_count || texels > b.texel_count - image.extent.z || !isfinite(image.scale.x))
            return r.fail(MINIRT_ERROR_CORRUPT, "image %llu lies outside of the texels", i);
        if (image.extent.w >= 2 * MINIRT_IMAGE_MIRROR_V)
            return r.fail(MINIRT_ERROR_CORRUPT, "image %llu wraps in an unknown way", i);
    }
    for (uint64_t i = 0; i < b.medium_count; ++i) {
        const minirt_medium& m = b.media[i];
        if (firstNonFinite<20, 20>(&m, 1) != 1 || !(m.ior.x > 0 && m.ior.y > 0 && m.ior.z > 0 && m.ior.w > 0) ||
            !(m.absorption.x >= 0 && m.absorption.y >= 0 && m.absorption.z >= 0))
            return r.fail(MINIRT_ERROR_CORRUPT, "medium %llu is none", i);
    }
    if (b.spectrum_count && b.spectrum_count != 1u << MINIRT_SPECTRUM_BITS)
        return r.fail(MINIRT_ERROR_CORRUPT, "a spectrum of %llu wavelengths", b.spectrum_count);
    if (firstNonFinite<4, 4>(b.spectrum, b.spectrum_count) != b.spectrum_count)
        return r.fail(MINIRT_ERROR_CORRUPT, "the spectrum holds a number that is not finite");
    for (uint64_t i = 0; i < b.spectrum_count; ++i)
        if (b.spectrum[i].w <= 0) return r.fail(MINIRT_ERROR_CORRUPT, "entry %llu of the spectrum has no wavelength", i);
    uint32_t bad = 0;
    for (uint64_t i = 0; i < b.texel_count * 4; ++i) bad |= (b.texels[i] & 0x7c00u) == 0x7c00u ? 1u : 0u;
    return bad ? r.fail(MINIRT_ERROR_CORRUPT, "a texel is not finite") : MINIRT_OK;
}

inline minirt_result checkKernels(BlobReader& r, const minirt_blob& b) {
    for (uint64_t i = 0; i < b.kernel_count; ++i) {
        const minirt_kernel& k = b.kernels[i];
        if (k.spirv_offset > b.spirv_size || k.spirv_size > b.spirv_size - k.spirv_offset || k.spirv_size < 20 ||
            k.spirv_size % 4 || k.spirv_offset % 4 || k.name[sizeof k.name - 1] != 0 || k.bindings >> MINIRT_BINDING_COUNT ||
            k.waits > 64)
            return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu is malformed", i);
        uint32_t magic;
        memcpy(&magic, b.spirv + k.spirv_offset, sizeof magic);
        if (magic != 0x07230203u) return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu is not SPIR-V", i);
        const bool lacksNormals = (k.bindings >> MINIRT_BINDING_NORMALS & 1u) && !b.normal_count;
        const bool lacksUvs = (k.bindings >> MINIRT_BINDING_UVS & 1u) && !b.uv_count;
        if ((k.bindings >> MINIRT_BINDING_SPECTRUM & 1u) && !b.spectrum_count)
            return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu reads a spectrum that is not there", i);
        if ((lacksNormals || lacksUvs) && (b.normal_count || b.uv_count))
            return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu reads corners that are not there", i);
        if ((k.bindings >> MINIRT_BINDING_MEDIA & 1u) && !b.medium_count)
            return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu reads media that are not there", i);
        if ((k.bindings >> MINIRT_BINDING_EMITTERS & 1u) && !b.emitter_count)
            return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu picks emitters that are not there", i);
        if ((k.bindings >> MINIRT_BINDING_ENVIRONMENT & 1u) && !b.environment_count)
            return r.fail(MINIRT_ERROR_CORRUPT, "kernel %llu picks cells of an environment that is not there", i);
    }
    return MINIRT_OK;
}

/* A blob that is being checked. */
struct BlobCheck {
    BlobReader reader;
    minirt_blob_section table[MINIRT_MAX_SECTIONS];
    minirt_blob blob;
    uint8_t* depth; /* of each node; scratch of checkNodes */
};

/* Finds the sections, all within the data, and the memory that checkContents needs. */
inline minirt_result openBlob(BlobCheck& check, const minirt_allocator& allocator) {
    BlobReader& r = check.reader;
    if (r.validation) r.validation->message[0] = 0;
    if (!r.data) return r.fail(MINIRT_ERROR_INVALID_ARGUMENT, "no data");
    if (reinterpret_cast<uintptr_t>(r.data) % 16)
        return r.fail(MINIRT_ERROR_INVALID_ARGUMENT, "the data is not aligned to 16 bytes");
    if (readHeader(r) || readTable(r, check.table)) return r.result;
    if (findSections(r, check.table, check.blob)) {
        checkSums(r, check.table); /* where it fails, it explains what else is wrong */
        return r.result;
    }
    check.depth = static_cast<uint8_t*>(hostAllocate(allocator, static_cast<size_t>(check.blob.node_count)));
    return check.depth ? MINIRT_OK : r.fail(MINIRT_ERROR_OUT_OF_MEMORY, "no memory to check the hierarchy");
}

/* What the sections hold. */
inline minirt_result checkContents(BlobCheck& check) {
    BlobReader& r = check.reader;
    const minirt_blob& blob = check.blob;
    if (checkSums(r, check.table) || checkScene(r, blob) || checkNodes(r, blob, check.depth) || checkPrimitives(r, blob) ||
        checkAppearance(r, blob) || checkPicks(r, blob) || checkKernels(r, blob))
        return r.result;
    return MINIRT_OK;
}

inline minirt_result validate(const void* data, size_t size, minirt_blob* out, minirt_validation* validation,
                              const minirt_allocator& allocator) {
    BlobCheck check = {{static_cast<const uint8_t*>(data), size, {}, validation}, {}, {}, nullptr};
    minirt_result r = openBlob(check, allocator);
    if (!r) r = checkContents(check);
    hostRelease(allocator, check.depth);
    if (out) *out = r ? minirt_blob() : check.blob;
    return r;
}

/* >>implementation-vulkan */
/* clang-format off */
#define MINIRT_INSTANCE_FUNCTIONS(X) \
    X(DestroyInstance) X(EnumeratePhysicalDevices) X(GetPhysicalDeviceProperties) X(GetPhysicalDeviceProperties2) \
    X(GetPhysicalDeviceFeatures) X(GetPhysicalDeviceMemoryProperties) X(GetPhysicalDeviceQueueFamilyProperties) \
    X(CreateDevice) X(GetDeviceProcAddr)
#define MINIRT_DEVICE_FUNCTIONS(X) \
    X(DestroyDevice) X(GetDeviceQueue) X(QueueSubmit) X(QueueWaitIdle) X(CreateBuffer) X(DestroyBuffer) \
    X(GetBufferMemoryRequirements) X(AllocateMemory) X(FreeMemory) X(BindBufferMemory) X(MapMemory) \
    X(CreateBufferView) X(DestroyBufferView) X(CreateShaderModule) X(DestroyShaderModule) X(CreateComputePipelines) \
    X(DestroyPipeline) X(CreatePipelineLayout) X(DestroyPipelineLayout) X(CreateDescriptorSetLayout) \
    X(DestroyDescriptorSetLayout) X(CreateDescriptorPool) X(DestroyDescriptorPool) X(AllocateDescriptorSets) \
    X(UpdateDescriptorSets) X(CreateCommandPool) X(DestroyCommandPool) X(AllocateCommandBuffers) X(BeginCommandBuffer) \
    X(EndCommandBuffer) X(CmdBindPipeline) X(CmdBindDescriptorSets) X(CmdPushConstants) X(CmdDispatch) \
    X(CmdDispatchIndirect) X(CmdUpdateBuffer) \
    X(CmdPipelineBarrier) X(CmdCopyBuffer) X(CmdFillBuffer) X(CmdCopyBufferToImage) X(CreateFence) X(DestroyFence) \
    X(WaitForFences) X(ResetFences) X(CreateQueryPool) X(DestroyQueryPool) X(CmdResetQueryPool) X(CmdWriteTimestamp) \
    X(GetQueryPoolResults)
/* clang-format on */

struct Functions {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
    PFN_vkCreateInstance CreateInstance = nullptr;
    PFN_vkEnumerateInstanceLayerProperties EnumerateInstanceLayerProperties = nullptr;
    PFN_vkEnumerateInstanceVersion EnumerateInstanceVersion = nullptr;
    PFN_vkCreateDebugUtilsMessengerEXT CreateDebugUtilsMessenger = nullptr;
    PFN_vkDestroyDebugUtilsMessengerEXT DestroyDebugUtilsMessenger = nullptr;
#define MINIRT_DECLARE(name) PFN_vk##name name = nullptr;
    MINIRT_INSTANCE_FUNCTIONS(MINIRT_DECLARE)
    MINIRT_DEVICE_FUNCTIONS(MINIRT_DECLARE)
#undef MINIRT_DECLARE
};

/* A device buffer with memory of its own. */
struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkBufferView view = VK_NULL_HANDLE;
    void* mapped = nullptr;  // where the host can see it
    VkDeviceSize size = 0;
};

enum class Placement { device, readBack, upload };

constexpr uint32_t kMostKernels = 6; /* of an integrator */
static_assert(kMostKernels <= kMostTasks, "their pipelines are made at once");

}  // namespace minirt_detail

struct minirt_context {
    minirt_allocator allocator = {};
    minirt_log_callback log = nullptr;
    void* logUser = nullptr;
    char message[512] = "";
    bool lost = false;
    bool float64 = false; /* shaderFloat64 is enabled */
    bool ownsDevice = true;
    void* loader = nullptr;
    minirt_detail::Functions vk;
    VkInstance instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queueFamily = 0;
    minirt_device_info info = {};
    VkPhysicalDeviceLimits limits = {};
    VkPhysicalDeviceMemoryProperties memoryProperties = {};
    uint32_t stepBudget = 0;       // of a pixel in a dispatch
    bool hasBallots = false;       // in subgroups, by which the wavefront fills its queues
    bool canShareTrees = false;    // whitted_shared may run: there are ballots, and no driver that ends loops
    double timestampPeriodNs = 0;  // 0: the queue has no timestamps
    uint64_t timestampMask = 0;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkQueryPool queries = VK_NULL_HANDLE;
    minirt_scene* scenes = nullptr;  // list of all
};

struct minirt_scene {
    minirt_context* context = nullptr;
    minirt_scene* next = nullptr;
    minirt_scene_desc desc = {};
    minirt_detail::Buffer buffers[MINIRT_BINDING_COUNT];  // those of the blob, then film, ray counts, state, counters of the job
    minirt_detail::Buffer filmReadBack;                   // where the film itself cannot be mapped
    minirt_detail::Buffer countsReadBack;
    uint32_t mediumCount = 0;
    minirt_medium* media = nullptr;
    uint32_t kernelCount = 0;
    minirt_kernel* kernels = nullptr;
    uint8_t* spirv = nullptr;
    uint32_t activeIntegrator = MINIRT_INTEGRATOR_SCENE;  // the one that the pipelines below are of
    uint32_t activeBindings = 0;                          // of its kernels together
    uint32_t activeWaits = 0;                             // minirt_kernel::waits
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
    VkPipeline pipelines[minirt_detail::kMostKernels] = {};  // in the order of integratorKernels; null where the scene needs none
    VkDescriptorPool descriptorPool = VK_NULL_HANDLE;
    VkDescriptorSet descriptorSet = VK_NULL_HANDLE;
    double blocksPerMs = 0;  // measured; 0: not yet
    double loadMs = 0;
    double uploadMs = 0;
    double pipelineMs = 0;
    minirt_job* job = nullptr;
};

struct minirt_job {
    minirt_scene* scene = nullptr;
    minirt_render_desc desc = {};
    minirt_camera camera = {};
    minirt_frame frame = {};
    uint32_t stateBlocks = 0;  // blocks that the state buffer has room for
    uint32_t blockCount = 0;   // of the region
    uint32_t nextBlock = 0;
    uint32_t dispatchBlocks = 0;  // of the dispatch that is under way
    double dispatchMs = 0;
    bool resume = false;
    bool recorded = false;  // the film holds one sample that minirt_record made
    uint32_t samplesDone = 0;
    double startMs = 0;
    minirt_stats stats = {};
};

namespace minirt_detail {

constexpr uint32_t kBlockPixels = 64;

inline minirt_result fail(minirt_context* c, minirt_result result, const char* format, const char* detail = "",
                          long long number = 0) {
    if (result == MINIRT_ERROR_DEVICE_LOST) c->lost = true;
    snprintf(c->message, sizeof c->message, format, detail, number);
    if (c->log) c->log(c->logUser, MINIRT_LOG_ERROR, c->message);
    return result;
}

inline minirt_result check(minirt_context* c, VkResult result, const char* what) {
    switch (result) {
        case VK_SUCCESS:
            return MINIRT_OK;
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return fail(c, MINIRT_ERROR_OUT_OF_MEMORY, "%s: out of host memory", what);
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return fail(c, MINIRT_ERROR_DEVICE_OUT_OF_MEMORY, "%s: out of device memory", what);
        case VK_ERROR_DEVICE_LOST:
            return fail(c, MINIRT_ERROR_DEVICE_LOST, "%s: the device was lost; destroy the context and start over", what);
        default:
            return fail(c, MINIRT_ERROR_VULKAN, "%s failed with VkResult %lld", what, result);
    }
}

inline minirt_result openLoader(minirt_context* c, const minirt_host_device& host) {
    c->vk.GetInstanceProcAddr = host.get_instance_proc_addr;
#if !defined(MINIRT_NO_DLOPEN)
    if (!c->vk.GetInstanceProcAddr) {
#if defined(_WIN32)
        c->loader = LoadLibraryA("vulkan-1.dll");
        void* symbol = c->loader ? GetProcAddress(c->loader, "vkGetInstanceProcAddr") : nullptr;
#else
        const char* names[] = {"libvulkan.so.1", "libvulkan.so", "libvulkan.1.dylib", "libMoltenVK.dylib"};
        for (const char* name : names)
            if (!c->loader) c->loader = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        void* symbol = c->loader ? dlsym(c->loader, "vkGetInstanceProcAddr") : nullptr;
#endif
        memcpy(&c->vk.GetInstanceProcAddr, &symbol, sizeof symbol);
    }
#endif
    if (!c->vk.GetInstanceProcAddr)
        return fail(c, MINIRT_ERROR_NO_VULKAN, "no Vulkan loader found; install one (Debian: libvulkan1 mesa-vulkan-drivers)");
    return MINIRT_OK;
}

inline void closeLoader(minirt_context* c) {
#if !defined(MINIRT_NO_DLOPEN)
    if (!c->loader) return;
#if defined(_WIN32)
    FreeLibrary(c->loader);
#else
    dlclose(c->loader);
#endif
    c->loader = nullptr;
#else
    (void)c;
#endif
}

template <typename F>
bool loadFunction(F& function, PFN_vkVoidFunction found) {
    static_assert(sizeof function == sizeof found, "function pointers have one size");
    memcpy(&function, &found, sizeof function);
    return found != nullptr;
}

inline VKAPI_ATTR VkBool32 VKAPI_CALL onDebugMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const minirt_context* c = static_cast<const minirt_context*>(user);
    if (c->log) c->log(c->logUser, MINIRT_LOG_VALIDATION, data->pMessage);
    return VK_FALSE;
}

inline VkDebugUtilsMessengerCreateInfoEXT messengerInfo(minirt_context* c) {
    VkDebugUtilsMessengerCreateInfoEXT info = {};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = onDebugMessage;
    info.pUserData = c;
    return info;
}

inline bool hasValidationLayer(minirt_context* c) {
    uint32_t count = 0;
    if (!c->vk.EnumerateInstanceLayerProperties || c->vk.EnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS ||
        !count)
        return false;
    VkLayerProperties* layers = static_cast<VkLayerProperties*>(hostAllocate(c->allocator, count * sizeof(VkLayerProperties)));
    if (!layers) return false;
    bool found = false;
    if (c->vk.EnumerateInstanceLayerProperties(&count, layers) >= VK_SUCCESS)
        for (uint32_t i = 0; i < count; ++i) found |= strcmp(layers[i].layerName, "VK_LAYER_KHRONOS_validation") == 0;
    hostRelease(c->allocator, layers);
    return found;
}

inline minirt_result createInstance(minirt_context* c, int validation) {
    const PFN_vkGetInstanceProcAddr get = c->vk.GetInstanceProcAddr;
    loadFunction(c->vk.EnumerateInstanceLayerProperties, get(nullptr, "vkEnumerateInstanceLayerProperties"));
    loadFunction(c->vk.EnumerateInstanceVersion, get(nullptr, "vkEnumerateInstanceVersion"));
    if (!loadFunction(c->vk.CreateInstance, get(nullptr, "vkCreateInstance")))
        return fail(c, MINIRT_ERROR_NO_VULKAN, "the Vulkan loader has no vkCreateInstance");
    uint32_t version = VK_API_VERSION_1_0;
    if (c->vk.EnumerateInstanceVersion) c->vk.EnumerateInstanceVersion(&version);
    if (version < VK_API_VERSION_1_1)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED, "Vulkan 1.1 is needed; the loader is older");

    VkApplicationInfo application = {};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "minirt";
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;

    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
                                                    VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
                                                    VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
    VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(c);
    VkValidationFeaturesEXT features = {};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = validation > 1 ? 3 : 1;
    features.pEnabledValidationFeatures = enables;
    const bool validate = validation && hasValidationLayer(c);
    if (validation && !validate && c->log) c->log(c->logUser, MINIRT_LOG_WARNING, "VK_LAYER_KHRONOS_validation is not installed");
    if (validate) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
        info.enabledExtensionCount = 2;
        info.ppEnabledExtensionNames = extensions;
    }
    const VkResult created = c->vk.CreateInstance(&info, nullptr, &c->instance);
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER)
        return fail(c, MINIRT_ERROR_NO_DEVICE,
                    "no Vulkan driver found; install one (Debian: mesa-vulkan-drivers renders without a GPU)");
    if (minirt_result r = check(c, created, "vkCreateInstance")) return r;
    if (validate) {
        loadFunction(c->vk.CreateDebugUtilsMessenger, get(c->instance, "vkCreateDebugUtilsMessengerEXT"));
        loadFunction(c->vk.DestroyDebugUtilsMessenger, get(c->instance, "vkDestroyDebugUtilsMessengerEXT"));
        if (c->vk.CreateDebugUtilsMessenger) c->vk.CreateDebugUtilsMessenger(c->instance, &messenger, nullptr, &c->messenger);
    }
    return MINIRT_OK;
}

inline minirt_result loadInstanceFunctions(minirt_context* c) {
    bool complete = true;
#define MINIRT_LOAD(name) complete &= loadFunction(c->vk.name, c->vk.GetInstanceProcAddr(c->instance, "vk" #name));
    MINIRT_INSTANCE_FUNCTIONS(MINIRT_LOAD)
#undef MINIRT_LOAD
    return complete ? MINIRT_OK : fail(c, MINIRT_ERROR_VULKAN, "the Vulkan loader lacks functions of version 1.1");
}

inline minirt_result loadDeviceFunctions(minirt_context* c) {
    bool complete = true;
#define MINIRT_LOAD(name) complete &= loadFunction(c->vk.name, c->vk.GetDeviceProcAddr(c->device, "vk" #name));
    MINIRT_DEVICE_FUNCTIONS(MINIRT_LOAD)
#undef MINIRT_LOAD
    return complete ? MINIRT_OK : fail(c, MINIRT_ERROR_VULKAN, "the Vulkan driver lacks functions of version 1.1");
}

/* >>implementation-devices */
/* The family to compute on: one with timestamps before one without; UINT32_MAX when there is none. */
inline uint32_t computeFamily(const minirt_context* c, VkPhysicalDevice device, uint32_t* timestampBits) {
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    c->vk.GetPhysicalDeviceQueueFamilyProperties(device, &count, families);
    uint32_t best = UINT32_MAX;
    *timestampBits = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) || families[i].queueCount == 0) continue;
        if (best != UINT32_MAX && families[i].timestampValidBits <= *timestampBits) continue;
        best = i;
        *timestampBits = families[i].timestampValidBits;
    }
    return best;
}

inline minirt_device_info describe(const minirt_context* c, VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    c->vk.GetPhysicalDeviceProperties(device, &properties);
    VkPhysicalDeviceMemoryProperties memory;
    c->vk.GetPhysicalDeviceMemoryProperties(device, &memory);
    minirt_device_info info = {};
    snprintf(info.name, sizeof info.name, "%s", properties.deviceName);
    snprintf(info.driver, sizeof info.driver, "Vulkan %u.%u.%u, driver %u.%u.%u", VK_API_VERSION_MAJOR(properties.apiVersion),
             VK_API_VERSION_MINOR(properties.apiVersion), VK_API_VERSION_PATCH(properties.apiVersion),
             properties.driverVersion >> 22, (properties.driverVersion >> 12) & 0x3ffu, properties.driverVersion & 0xfffu);
    info.api_version = properties.apiVersion;
    info.driver_version = properties.driverVersion;
    info.is_cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            info.memory_bytes = larger<uint64_t>(info.memory_bytes, memory.memoryHeaps[i].size);
    return info;
}

inline int rank(const minirt_context* c, VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    c->vk.GetPhysicalDeviceProperties(device, &properties);
    switch (properties.deviceType) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 4;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 3;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 1;
        default:
            return 0;
    }
}

constexpr uint32_t kMaxDevices = 16;

/* Usable devices, best first (stable). */
inline uint32_t rankedDevices(minirt_context* c, VkPhysicalDevice* devices) {
    uint32_t count = kMaxDevices;
    VkPhysicalDevice all[kMaxDevices];
    if (c->vk.EnumeratePhysicalDevices(c->instance, &count, all) < VK_SUCCESS) count = 0;
    uint32_t usable = 0;
    for (int wanted = 4; wanted >= 0; --wanted) {
        for (uint32_t i = 0; i < count; ++i) {
            VkPhysicalDeviceProperties properties;
            c->vk.GetPhysicalDeviceProperties(all[i], &properties);
            uint32_t bits;
            if (rank(c, all[i]) == wanted && properties.apiVersion >= VK_API_VERSION_1_1 &&
                computeFamily(c, all[i], &bits) != UINT32_MAX)
                devices[usable++] = all[i];
        }
    }
    return usable;
}

inline bool isNumber(const char* text) {
    for (; *text; ++text)
        if (*text < '0' || *text > '9') return false;
    return true;
}

inline minirt_result pickDevice(minirt_context* c, const char* wanted) {
    VkPhysicalDevice devices[kMaxDevices];
    const uint32_t count = rankedDevices(c, devices);
    if (!count)
        return fail(c, MINIRT_ERROR_NO_DEVICE,
                    "no Vulkan device found; install a driver (Debian: mesa-vulkan-drivers renders without a GPU)");
    uint32_t chosen = 0;
    if (wanted && *wanted) {
        chosen = isNumber(wanted) && strlen(wanted) < 9 ? static_cast<uint32_t>(strtoul(wanted, nullptr, 10)) : count;
        for (uint32_t i = count; i-- > 0 && !isNumber(wanted);)
            if (strstr(describe(c, devices[i]).name, wanted)) chosen = i;
        if (chosen >= count)
            return fail(c, MINIRT_ERROR_NO_DEVICE, "no Vulkan device matches '%s'; list them with: minirtc devices", wanted);
    }
    c->physicalDevice = devices[chosen];
    return MINIRT_OK;
}

inline void readDeviceProperties(minirt_context* c, uint32_t timestampBits) {
    VkPhysicalDeviceSubgroupProperties subgroup = {};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceProperties2 properties = {};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &subgroup;
    c->vk.GetPhysicalDeviceProperties2(c->physicalDevice, &properties);
    c->vk.GetPhysicalDeviceMemoryProperties(c->physicalDevice, &c->memoryProperties);
    c->limits = properties.properties.limits;
    c->hasBallots = (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) &&
                    (subgroup.supportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT);
    c->canShareTrees = c->hasBallots && properties.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
    /* Some CPU drivers end all loops of a subgroup together after 65535 passes without saying so; a pixel whose own
       passes stay below 65535 / subgroup size can never get there. The margin is for saving and loading a traversal's stack. */
    c->stepBudget = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU
                        ? 65535u / larger(subgroup.subgroupSize, 1u) - 256u
                        : 1u << 18;
    c->timestampPeriodNs = timestampBits ? static_cast<double>(c->limits.timestampPeriod) : 0.0;
    c->timestampMask = timestampBits >= 64 ? ~uint64_t(0) : (uint64_t(1) << timestampBits) - 1;
    c->info = describe(c, c->physicalDevice);
}

inline minirt_result createDevice(minirt_context* c) {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = c->queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures offered;
    c->vk.GetPhysicalDeviceFeatures(c->physicalDevice, &offered);
    VkPhysicalDeviceFeatures enabled = {};
    enabled.shaderFloat64 = offered.shaderFloat64;
    c->float64 = offered.shaderFloat64 != 0;
    VkDeviceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &enabled;
    return check(c, c->vk.CreateDevice(c->physicalDevice, &info, nullptr, &c->device), "vkCreateDevice");
}

inline minirt_result createCommandObjects(minirt_context* c) {
    VkCommandPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = c->queueFamily;
    if (minirt_result r = check(c, c->vk.CreateCommandPool(c->device, &pool, nullptr, &c->commandPool), "vkCreateCommandPool"))
        return r;
    VkCommandBufferAllocateInfo buffers = {};
    buffers.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffers.commandPool = c->commandPool;
    buffers.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffers.commandBufferCount = 1;
    if (minirt_result r = check(c, c->vk.AllocateCommandBuffers(c->device, &buffers, &c->commands), "vkAllocateCommandBuffers"))
        return r;
    VkFenceCreateInfo fence = {};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    if (minirt_result r = check(c, c->vk.CreateFence(c->device, &fence, nullptr, &c->fence), "vkCreateFence")) return r;
    if (c->timestampPeriodNs <= 0) return MINIRT_OK;
    VkQueryPoolCreateInfo queries = {};
    queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = 2;
    return check(c, c->vk.CreateQueryPool(c->device, &queries, nullptr, &c->queries), "vkCreateQueryPool");
}

inline minirt_result openContext(minirt_context* c, const minirt_context_desc& desc) {
    if (minirt_result r = openLoader(c, desc.host)) return r;
    c->ownsDevice = desc.host.device == VK_NULL_HANDLE;
    if (c->ownsDevice) {
        if (minirt_result r = createInstance(c, desc.validation)) return r;
        if (minirt_result r = loadInstanceFunctions(c)) return r;
        if (minirt_result r = pickDevice(c, desc.device_name)) return r;
    } else {
        if (!desc.host.get_instance_proc_addr || !desc.host.instance || !desc.host.physical_device || !desc.host.queue)
            return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "minirt_host_device: with a device, all other fields are needed too");
        c->instance = desc.host.instance;
        c->physicalDevice = desc.host.physical_device;
        c->device = desc.host.device;
        c->queue = desc.host.queue;
        c->queueFamily = desc.host.queue_family;
        c->float64 = desc.host.shader_float64 != 0;
        if (minirt_result r = loadInstanceFunctions(c)) return r;
    }
    uint32_t timestampBits;
    const uint32_t family = computeFamily(c, c->physicalDevice, &timestampBits);
    if (c->ownsDevice) c->queueFamily = family;
    if (!c->ownsDevice && family != c->queueFamily) timestampBits = 0;
    readDeviceProperties(c, timestampBits);
    constexpr uint32_t kStorageBuffers = 7;
    if (c->limits.maxPerStageDescriptorStorageBuffers < kStorageBuffers)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED, "the device offers %sfewer than %lld storage buffers to a kernel", "",
                    kStorageBuffers);
    if (c->info.api_version < VK_API_VERSION_1_1)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED, "the device is older than Vulkan 1.1");
    if (c->ownsDevice)
        if (minirt_result r = createDevice(c)) return r;
    if (minirt_result r = loadDeviceFunctions(c)) return r;
    if (c->ownsDevice) c->vk.GetDeviceQueue(c->device, c->queueFamily, 0, &c->queue);
    return createCommandObjects(c);
}

inline void closeContext(minirt_context* c) {
    if (c->device) {
        if (c->fence) c->vk.DestroyFence(c->device, c->fence, nullptr);
        if (c->queries) c->vk.DestroyQueryPool(c->device, c->queries, nullptr);
        if (c->commandPool) c->vk.DestroyCommandPool(c->device, c->commandPool, nullptr);
        if (c->ownsDevice && c->vk.DestroyDevice) c->vk.DestroyDevice(c->device, nullptr);
    }
    if (c->ownsDevice && c->instance) {
        if (c->messenger) c->vk.DestroyDebugUtilsMessenger(c->instance, c->messenger, nullptr);
        if (c->vk.DestroyInstance) c->vk.DestroyInstance(c->instance, nullptr);
    }
    closeLoader(c);
}

/* >>implementation-buffers */
/* Index of a memory type in `allowed` with all of `wanted`, the first in the driver's order of preference; UINT32_MAX: none. */
inline uint32_t memoryType(const minirt_context* c, uint32_t allowed, VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < c->memoryProperties.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (c->memoryProperties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return UINT32_MAX;
}

inline uint32_t pickMemoryType(const minirt_context* c, uint32_t allowed, Placement placement) {
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags cached = visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const VkMemoryPropertyFlags preferences[3][3] = {
        {local | cached, local, 0}, {cached, visible, visible}, {visible, visible, visible}};
    for (VkMemoryPropertyFlags wanted : preferences[static_cast<int>(placement)]) {
        const uint32_t type = memoryType(c, allowed, wanted);
        if (type != UINT32_MAX) return type;
    }
    return UINT32_MAX;
}

inline void destroyBuffer(minirt_context* c, Buffer& buffer) {
    if (buffer.view) c->vk.DestroyBufferView(c->device, buffer.view, nullptr);
    if (buffer.buffer) c->vk.DestroyBuffer(c->device, buffer.buffer, nullptr);
    if (buffer.memory) c->vk.FreeMemory(c->device, buffer.memory, nullptr);
    buffer = Buffer();
}

/* Of a CPU device's memory, before it is written: large pages are filled sooner and found sooner. A hint, no more. */
inline void wantLargePages(const minirt_context* c, void* memory, VkDeviceSize size) {
#if defined(MINIRT_HAS_MMAP) && defined(MADV_HUGEPAGE)
    constexpr uintptr_t kLargePage = 2u << 20;
    const uintptr_t start = reinterpret_cast<uintptr_t>(memory);
    const uintptr_t first = (start + kLargePage - 1) / kLargePage * kLargePage;
    const uintptr_t end = (start + static_cast<uintptr_t>(size)) / kLargePage * kLargePage;
    if (c->info.is_cpu && first < end) madvise(static_cast<uint8_t*>(memory) + (first - start), end - first, MADV_HUGEPAGE);
#else
    (void)c, (void)memory, (void)size;
#endif
}

inline minirt_result makeBuffer(minirt_context* c, VkDeviceSize size, VkBufferUsageFlags usage, Placement placement,
                                Buffer& buffer) {
    VkBufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    if (minirt_result r = check(c, c->vk.CreateBuffer(c->device, &info, nullptr, &buffer.buffer), "vkCreateBuffer")) return r;
    VkMemoryRequirements needs;
    c->vk.GetBufferMemoryRequirements(c->device, buffer.buffer, &needs);
    const uint32_t type = pickMemoryType(c, needs.memoryTypeBits, placement);
    if (type == UINT32_MAX) return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED, "the device has no memory for a buffer");
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needs.size;
    allocation.memoryTypeIndex = type;
    if (minirt_result r = check(c, c->vk.AllocateMemory(c->device, &allocation, nullptr, &buffer.memory), "vkAllocateMemory"))
        return r;
    if (minirt_result r = check(c, c->vk.BindBufferMemory(c->device, buffer.buffer, buffer.memory, 0), "vkBindBufferMemory"))
        return r;
    buffer.size = size;
    constexpr VkMemoryPropertyFlags mappable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags flags = c->memoryProperties.memoryTypes[type].propertyFlags;
    const bool map =
        (flags & mappable) == mappable && (placement != Placement::device || (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT));
    if (!map) return MINIRT_OK;
    if (minirt_result r = check(c, c->vk.MapMemory(c->device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped), "vkMapMemory"))
        return r;
    wantLargePages(c, buffer.mapped, size);
    return MINIRT_OK;
}

/* Replaces `buffer`; on failure it is empty. */
inline minirt_result createBuffer(minirt_context* c, VkDeviceSize size, VkBufferUsageFlags usage, Placement placement,
                                  Buffer& buffer) {
    destroyBuffer(c, buffer);
    const minirt_result r = makeBuffer(c, size, usage, placement, buffer);
    if (r) destroyBuffer(c, buffer);
    return r;
}

inline minirt_result beginCommands(minirt_context* c) {
    VkCommandBufferBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    return check(c, c->vk.BeginCommandBuffer(c->commands, &begin), "vkBeginCommandBuffer");
}

inline minirt_result submitAndWait(minirt_context* c) {
    if (minirt_result r = check(c, c->vk.EndCommandBuffer(c->commands), "vkEndCommandBuffer")) return r;
    VkSubmitInfo submit = {};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &c->commands;
    if (minirt_result r = check(c, c->vk.QueueSubmit(c->queue, 1, &submit, c->fence), "vkQueueSubmit")) return r;
    if (minirt_result r = check(c, c->vk.WaitForFences(c->device, 1, &c->fence, VK_TRUE, UINT64_MAX), "vkWaitForFences"))
        return r;
    return check(c, c->vk.ResetFences(c->device, 1, &c->fence), "vkResetFences");
}

/* Makes everything written before visible to everything after, the host included. */
inline void memoryBarrier(minirt_context* c, VkCommandBuffer commands) {
    VkMemoryBarrier barrier = {};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_HOST_READ_BIT;
    const VkPipelineStageFlags work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    c->vk.CmdPipelineBarrier(commands, work, work | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &barrier, 0, nullptr, 0, nullptr);
}

constexpr VkDeviceSize kStagingBytes = 64u << 20;

inline minirt_result uploadThroughStaging(minirt_context* c, const Buffer& target, const void* data, VkDeviceSize size,
                                          Buffer& staging) {
    if (!staging.buffer)
        if (minirt_result r = createBuffer(c, kStagingBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Placement::upload, staging))
            return r;
    for (VkDeviceSize at = 0; at < size; at += kStagingBytes) {
        const VkDeviceSize part = smaller(kStagingBytes, size - at);
        memcpy(staging.mapped, static_cast<const uint8_t*>(data) + at, static_cast<size_t>(part));
        if (minirt_result r = beginCommands(c)) return r;
        const VkBufferCopy copy = {0, at, part};
        c->vk.CmdCopyBuffer(c->commands, staging.buffer, target.buffer, 1, &copy);
        memoryBarrier(c, c->commands);
        if (minirt_result r = submitAndWait(c)) return r;
    }
    return MINIRT_OK;
}

/* How a kernel sees a binding. What it reads of the scene lies in texel buffers of 16-byte rows, but for images' texels. */
inline VkDescriptorType descriptorType(uint32_t binding) {
    if (binding == MINIRT_BINDING_SCENE) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    return binding < MINIRT_BINDING_FILM ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

inline VkFormat viewFormat(uint32_t binding) {
    if (descriptorType(binding) != VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) return VK_FORMAT_UNDEFINED;
    return binding == MINIRT_BINDING_TEXELS ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_UINT;
}

/* The buffer behind a binding: nodes and primitives are bound twice. */
inline uint32_t bufferOf(uint32_t binding) {
    if (binding == MINIRT_BINDING_NODE_STORAGE) return MINIRT_BINDING_NODES;
    return binding == MINIRT_BINDING_PRIMITIVE_STORAGE ? MINIRT_BINDING_PRIMITIVES : binding;
}

inline minirt_result fillBuffer(minirt_scene* s, uint32_t binding, const void* data, VkDeviceSize size, Buffer& staging) {
    minirt_context* c = s->context;
    Buffer& buffer = s->buffers[binding];
    const VkFormat format = viewFormat(binding);
    const bool texel = format != VK_FORMAT_UNDEFINED;
    const VkDeviceSize texelBytes = format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 16;
    if (texel && size / texelBytes > c->limits.maxTexelBufferElements)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED,
                    "the scene has too many %s for this device, which takes %lld in one buffer",
                    binding == MINIRT_BINDING_TEXELS ? "texels of images" : "rows of data", c->limits.maxTexelBufferElements);
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                     (texel ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    if (minirt_result r = createBuffer(c, size, usage, Placement::device, buffer)) return r;
    if (buffer.mapped)
        memcpy(buffer.mapped, data, static_cast<size_t>(size));
    else if (minirt_result r = uploadThroughStaging(c, buffer, data, size, staging))
        return r;
    if (!texel) return MINIRT_OK;
    VkBufferViewCreateInfo view = {};
    view.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    view.buffer = buffer.buffer;
    view.format = format;
    view.range = VK_WHOLE_SIZE;
    return check(c, c->vk.CreateBufferView(c->device, &view, nullptr, &buffer.view), "vkCreateBufferView");
}

/* One part of the blob as a buffer of the given binding; an absent part gets none, nor does one that fails. */
inline minirt_result uploadPart(minirt_scene* s, uint32_t binding, const void* data, VkDeviceSize size, Buffer& staging) {
    if (!data || !size) return MINIRT_OK;
    const minirt_result r = fillBuffer(s, binding, data, size, staging);
    if (r) destroyBuffer(s->context, s->buffers[binding]);
    return r;
}

inline minirt_result uploadScene(minirt_scene* s, const minirt_blob& b) {
    struct Part {
        uint32_t binding;
        const void* data;
        uint64_t size;
    };
    const Part parts[] = {
        {MINIRT_BINDING_SCENE, b.rows, sizeof *b.rows},
        {MINIRT_BINDING_NODES, b.nodes, b.node_count * (b.scene->node_layout == MINIRT_NODES_FLOAT ? 64 : 32)},
        {MINIRT_BINDING_PRIMITIVES, b.primitives, b.primitive_count * 48},
        {MINIRT_BINDING_NORMALS, b.normals, b.normal_count * MINIRT_NORMAL_ROWS * 16},
        {MINIRT_BINDING_UVS, b.uvs, b.uv_count * MINIRT_UV_ROWS * 16},
        {MINIRT_BINDING_MATERIALS, b.materials, b.material_count * sizeof *b.materials},
        {MINIRT_BINDING_LIGHTS, b.lights, b.light_count * sizeof *b.lights},
        {MINIRT_BINDING_IMAGES, b.images, b.image_count * sizeof *b.images},
        {MINIRT_BINDING_TEXELS, b.texels, b.texel_count * 8},
        {MINIRT_BINDING_MEDIA, b.media, b.medium_count * sizeof *b.media},
        {MINIRT_BINDING_SPECTRUM, b.spectrum, b.spectrum_count * sizeof *b.spectrum},
        {MINIRT_BINDING_EMITTERS, b.emitters, b.emitter_count * sizeof *b.emitters},
        {MINIRT_BINDING_ENVIRONMENT, b.environment, b.environment_count * sizeof *b.environment},
    };
    Buffer staging;
    minirt_result result = MINIRT_OK;
    for (const Part& part : parts)
        if (!result) result = uploadPart(s, part.binding, part.data, part.size, staging);
    destroyBuffer(s->context, staging);
    if (result) return result;
    return createBuffer(s->context, sizeof(minirt_counters),
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::readBack,
                        s->buffers[MINIRT_BINDING_COUNTERS]);
}

/* >>implementation-pipeline */
inline minirt_result createLayouts(minirt_scene* s, uint32_t bindings) {
    minirt_context* c = s->context;
    VkDescriptorSetLayoutBinding entries[MINIRT_BINDING_COUNT] = {};
    uint32_t count = 0;
    for (uint32_t b = 0; b < MINIRT_BINDING_COUNT; ++b) {
        if (!(bindings >> b & 1u)) continue;
        entries[count].binding = b;
        entries[count].descriptorType = descriptorType(b);
        entries[count].descriptorCount = 1;
        entries[count].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        ++count;
    }
    VkDescriptorSetLayoutCreateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = count;
    set.pBindings = entries;
    if (minirt_result r =
            check(c, c->vk.CreateDescriptorSetLayout(c->device, &set, nullptr, &s->setLayout), "vkCreateDescriptorSetLayout"))
        return r;
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(minirt_frame)};
    VkPipelineLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &s->setLayout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    if (minirt_result r =
            check(c, c->vk.CreatePipelineLayout(c->device, &layout, nullptr, &s->pipelineLayout), "vkCreatePipelineLayout"))
        return r;

    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, MINIRT_BINDING_COUNT},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, MINIRT_BINDING_COUNT}};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 3;
    pool.pPoolSizes = sizes;
    if (minirt_result r =
            check(c, c->vk.CreateDescriptorPool(c->device, &pool, nullptr, &s->descriptorPool), "vkCreateDescriptorPool"))
        return r;
    VkDescriptorSetAllocateInfo allocate = {};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = s->descriptorPool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &s->setLayout;
    return check(c, c->vk.AllocateDescriptorSets(c->device, &allocate, &s->descriptorSet), "vkAllocateDescriptorSets");
}

/* How a kernel is specialised for the class of the device. */
struct Specialisation {
    uint32_t groupSize, stackIsShared, sharedStackWords, privateStackWords, stepBudget, interleaveGroups, stackLevels,
        fetchTexels, masksLanes;
};

inline Specialisation specialisation(const minirt_scene* scene) {
    const minirt_context* c = scene->context;
    const uint32_t stackLevels = scene->desc.bvh_depth;
    const bool cpu = c->info.is_cpu != 0;
    Specialisation s = {};
    s.groupSize = kBlockPixels;
    s.stackLevels = stackLevels;
    s.stackIsShared = cpu && stackLevels * kBlockPixels * 4 <= c->limits.maxComputeSharedMemorySize;
    s.sharedStackWords = s.stackIsShared ? stackLevels * kBlockPixels : 1;
    s.privateStackWords = s.stackIsShared ? 1 : stackLevels;
    s.stepBudget = c->stepBudget;
    s.interleaveGroups = cpu;
    s.masksLanes = cpu;
    const VkDeviceSize range = c->limits.maxStorageBufferRange;
    s.fetchTexels =
        cpu || scene->buffers[MINIRT_BINDING_NODES].size > range || scene->buffers[MINIRT_BINDING_PRIMITIVES].size > range;
    return s;
}

/* Whether a module declares the capability Float64. Capabilities are the first instructions after the header of five words. */
inline bool needsFloat64(const uint32_t* words, size_t count) {
    constexpr uint32_t kOpCapability = 17;
    constexpr uint32_t kFloat64 = 10;
    for (size_t i = 5; i + 1 < count && words[i] == (2u << 16 | kOpCapability); i += 2)
        if (words[i + 1] == kFloat64) return true;
    return false;
}

inline minirt_result requirePrecision(const minirt_scene* s, const minirt_kernel& kernel) {
    minirt_context* c = s->context;
    const uint32_t* words = static_cast<const uint32_t*>(static_cast<const void*>(s->spirv + kernel.spirv_offset));
    if (c->float64 || !needsFloat64(words, static_cast<size_t>(kernel.spirv_size / 4))) return MINIRT_OK;
    return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED,
                c->ownsDevice ? "the kernels are in double precision, which the device does not offer (shaderFloat64); bake "
                                "with precision=float"
                              : "the kernels are in double precision; enable shaderFloat64 and say so in minirt_host_device");
}

/* Calls nothing but the driver: it runs on several threads. */
inline VkResult makePipeline(const minirt_scene* s, const minirt_kernel& kernel, VkPipeline* out) {
    const minirt_context* c = s->context;
    VkShaderModuleCreateInfo module = {};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = static_cast<size_t>(kernel.spirv_size);
    module.pCode = static_cast<const uint32_t*>(static_cast<const void*>(s->spirv + kernel.spirv_offset));
    VkShaderModule shader = VK_NULL_HANDLE;
    if (const VkResult r = c->vk.CreateShaderModule(c->device, &module, nullptr, &shader)) return r;

    const Specialisation values = specialisation(s);
    static_assert(sizeof values == MINIRT_SPEC_COUNT * sizeof(uint32_t), "one word a constant, in the order of their ids");
    VkSpecializationMapEntry entries[MINIRT_SPEC_COUNT];
    for (uint32_t i = 0; i < MINIRT_SPEC_COUNT; ++i) entries[i] = {i, i * 4, 4};
    const VkSpecializationInfo info = {MINIRT_SPEC_COUNT, entries, sizeof values, &values};
    VkComputePipelineCreateInfo pipeline = {};
    pipeline.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipeline.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline.stage.module = shader;
    pipeline.stage.pName = "main";
    pipeline.stage.pSpecializationInfo = &info;
    pipeline.layout = s->pipelineLayout;
    const VkResult r = c->vk.CreateComputePipelines(c->device, VK_NULL_HANDLE, 1, &pipeline, nullptr, out);
    c->vk.DestroyShaderModule(c->device, shader, nullptr);
    return r;
}

inline void destroyPipelines(minirt_scene* s) {
    minirt_context* c = s->context;
    for (VkPipeline& pipeline : s->pipelines) {
        if (pipeline) c->vk.DestroyPipeline(c->device, pipeline, nullptr);
        pipeline = VK_NULL_HANDLE;
    }
    if (s->descriptorPool) c->vk.DestroyDescriptorPool(c->device, s->descriptorPool, nullptr);
    if (s->pipelineLayout) c->vk.DestroyPipelineLayout(c->device, s->pipelineLayout, nullptr);
    if (s->setLayout) c->vk.DestroyDescriptorSetLayout(c->device, s->setLayout, nullptr);
    s->descriptorPool = VK_NULL_HANDLE;
    s->pipelineLayout = VK_NULL_HANDLE;
    s->setLayout = VK_NULL_HANDLE;
    s->activeIntegrator = MINIRT_INTEGRATOR_SCENE;
}

/* Kernels may declare buffers that this scene does not fill (a kernel with all effects); they get a few zeros. */
inline minirt_result fillAbsentBuffers(minirt_scene* s, uint32_t bindings) {
    const uint8_t zeros[64] = {};
    Buffer staging;
    minirt_result result = MINIRT_OK;
    for (uint32_t b = 0; b < MINIRT_BINDING_FILM && !result; ++b) {
        if (!(bindings >> b & 1u) || s->buffers[b].buffer) continue;
        result = uploadPart(s, b, zeros, sizeof zeros, staging);
    }
    destroyBuffer(s->context, staging);
    return result;
}

inline void writeDescriptors(minirt_scene* s) {
    VkDescriptorBufferInfo buffers[MINIRT_BINDING_COUNT];
    VkWriteDescriptorSet writes[MINIRT_BINDING_COUNT] = {};
    uint32_t count = 0;
    const uint32_t bindings = s->activeBindings;
    for (uint32_t b = 0; b < MINIRT_BINDING_COUNT; ++b) {
        if (!(bindings >> b & 1u)) continue;
        const Buffer& buffer = s->buffers[bufferOf(b)];
        const bool storage = descriptorType(b) == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        buffers[b] = {buffer.buffer, 0,
                      storage ? smaller<VkDeviceSize>(buffer.size, s->context->limits.maxStorageBufferRange) : VK_WHOLE_SIZE};
        VkWriteDescriptorSet& write = writes[count++];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = s->descriptorSet;
        write.dstBinding = b;
        write.descriptorCount = 1;
        write.descriptorType = descriptorType(b);
        write.pBufferInfo = &buffers[b];
        write.pTexelBufferView = &buffer.view;
    }
    s->context->vk.UpdateDescriptorSets(s->context->device, count, writes, 0, nullptr);
}

/* The kernels of the wavefront, in the order of a round. */
enum WaveKernel { kWaveGenerate, kWaveClosest, kWaveHit, kWaveMiss, kWaveShadow, kWaveAccumulate };

/* Names of an integrator's kernels; a scene that nothing lights has no shadow kernel, one with a black background none for misses. */
inline const char* integratorKernel(uint32_t integrator, uint32_t i) {
    const char* wavefront[kMostKernels] = {"wave_generate", "wave_closest", "wave_hit",
                                           "wave_miss",     "wave_shadow",  "wave_accumulate"};
    if (integrator == MINIRT_INTEGRATOR_WAVEFRONT) return wavefront[i];
    if (i > 0) return "";
    if (integrator == MINIRT_INTEGRATOR_WHITTED_SHARED) return "whitted_shared";
    return integrator == MINIRT_INTEGRATOR_PATH ? "path" : "whitted";
}

/* NULL: the blob does not hold it. */
inline const minirt_kernel* findKernel(const minirt_scene* s, const char* name) {
    for (uint32_t i = 0; i < s->kernelCount; ++i)
        if (strcmp(s->kernels[i].name, name) == 0) return &s->kernels[i];
    return nullptr;
}

inline bool hasIntegrator(const minirt_scene* s, uint32_t integrator) {
    return findKernel(s, integratorKernel(integrator, 0)) != nullptr;
}

/* At once, as drivers translate each kernel by itself; but one after the other where the validation layer may call back. */
inline minirt_result createPipelines(minirt_scene* s, const minirt_kernel* const* kernels) {
    VkResult results[kMostKernels] = {};
    uint32_t present[kMostKernels];
    uint32_t count = 0;
    for (uint32_t i = 0; i < kMostKernels; ++i) {
        if (!kernels[i]) continue;
        if (minirt_result r = requirePrecision(s, *kernels[i])) return r;
        present[count++] = i;
    }
    const auto make = [&](uint32_t i) { results[i] = makePipeline(s, *kernels[present[i]], &s->pipelines[present[i]]); };
    const uint32_t atATime = s->context->messenger ? 1 : count;
    for (uint32_t first = 0; first < count; first += atATime) atOnce(atATime, [&](uint32_t i) { make(first + i); });
    for (VkResult result : results)
        if (minirt_result r = check(s->context, result, "making a pipeline")) return r;
    return MINIRT_OK;
}

/* Pipelines of kernels that share one descriptor set; NULL where there is none. */
inline minirt_result activateKernels(minirt_scene* s, const minirt_kernel* const* kernels) {
    destroyPipelines(s);
    const double start = nowMs();
    s->activeBindings = 0;
    s->activeWaits = 0;
    for (uint32_t i = 0; i < kMostKernels; ++i) {
        if (!kernels[i]) continue;
        s->activeBindings |= kernels[i]->bindings;
        s->activeWaits = larger(s->activeWaits, kernels[i]->waits);
    }
    minirt_result r = fillAbsentBuffers(s, s->activeBindings);
    if (!r) r = createLayouts(s, s->activeBindings);
    if (!r) r = createPipelines(s, kernels);
    if (r) destroyPipelines(s);
    s->blocksPerMs = 0;
    s->pipelineMs = nowMs() - start;
    return r;
}

inline minirt_result activateIntegrator(minirt_scene* s, uint32_t integrator) {
    if (s->activeIntegrator == integrator) return MINIRT_OK;
    const minirt_kernel* kernels[kMostKernels];
    for (uint32_t i = 0; i < kMostKernels; ++i) kernels[i] = findKernel(s, integratorKernel(integrator, i));
    if (minirt_result r = activateKernels(s, kernels)) return r;
    s->activeIntegrator = integrator;
    return MINIRT_OK;
}

/* >>implementation-job */
/* True where a point in scene space lies in the bounds of a volume: rays from there find out first what they start in. */
inline bool mayBeInVolume(const minirt_scene* s, const float* p) {
    for (uint32_t i = 1; i < s->mediumCount; ++i) {
        const minirt_vec4& lo = s->media[i].boundsMin;
        const minirt_vec4& hi = s->media[i].boundsMax;
        if (p[0] >= lo.x && p[1] >= lo.y && p[2] >= lo.z && p[0] <= hi.x && p[1] <= hi.y && p[2] <= hi.z) return true;
    }
    return false;
}

/* Camera basis for a pinhole at `camera` (world space) into the frame (scene space). */
inline bool aimCamera(const minirt_scene* s, const minirt_camera& camera, minirt_frame& frame) {
    const minirt_scene_desc& scene = s->desc;
    double forward[3];
    double right[3];
    double length2 = 0;
    for (int i = 0; i < 3; ++i) {
        forward[i] = camera.target[i] - camera.position[i];
        length2 += forward[i] * forward[i];
    }
    for (double& f : forward) f /= sqrt(length2);
    for (int i = 0; i < 3; ++i)
        right[i] = forward[(i + 1) % 3] * camera.up[(i + 2) % 3] - forward[(i + 2) % 3] * camera.up[(i + 1) % 3];
    const double rightLength = sqrt(right[0] * right[0] + right[1] * right[1] + right[2] * right[2]);
    for (double& x : right) x /= rightLength;
    const double halfHeight = tan(camera.vfov * 3.14159265358979323846 / 360.0);
    const double halfWidth = halfHeight * frame.size.x / frame.size.y;
    float position[3];
    float upward[3];
    for (int i = 0; i < 3; ++i) {
        position[i] = static_cast<float>(camera.position[i] - scene.origin[i]);
        upward[i] = static_cast<float>((right[(i + 1) % 3] * forward[(i + 2) % 3] - right[(i + 2) % 3] * forward[(i + 1) % 3]) *
                                       halfHeight);
    }
    frame.position = {position[0], position[1], position[2], frame.position.w};
    frame.forward = {static_cast<float>(forward[0]), static_cast<float>(forward[1]), static_cast<float>(forward[2]),
                     static_cast<float>(camera.aperture * 0.5)};
    frame.right = {static_cast<float>(right[0] * halfWidth), static_cast<float>(right[1] * halfWidth),
                   static_cast<float>(right[2] * halfWidth), static_cast<float>(camera.focus_distance)};
    frame.up = {upward[0], upward[1], upward[2], frame.up.w};
    const bool inside = scene.volume_capacity && mayBeInVolume(s, position);
    frame.sampling.y = (frame.sampling.y & ~MINIRT_FRAME_CAMERA_INSIDE) | (inside ? MINIRT_FRAME_CAMERA_INSIDE : 0u);
    const minirt_vec4* rows[] = {&frame.position, &frame.forward, &frame.right, &frame.up};
    for (const minirt_vec4* row : rows)
        if (!isfinite(row->x) || !isfinite(row->y) || !isfinite(row->z)) return false;
    const bool lens = camera.aperture >= 0 && isfinite(camera.aperture) && isfinite(camera.focus_distance) &&
                      (camera.aperture == 0 || camera.focus_distance > 0);
    return lens && camera.vfov > 0 && camera.vfov < 180;
}

/* Of Whitted's tracers, which give the same picture but for rounding: the one that shares trees where the blob holds it and the device can. */
inline minirt_integrator whittedIntegrator(const minirt_scene* s) {
    const bool shares = s->context->canShareTrees && hasIntegrator(s, MINIRT_INTEGRATOR_WHITTED_SHARED);
    return shares || !hasIntegrator(s, MINIRT_INTEGRATOR_WHITTED) ? MINIRT_INTEGRATOR_WHITTED_SHARED : MINIRT_INTEGRATOR_WHITTED;
}

/* The scene's integrator. The two path tracers give the same picture, so of them the faster one on this class of devices: the wavefront on a CPU, whose
   driver runs both sides of every branch; one kernel on a GPU, which need not keep paths in memory (docs/performance.md). */
inline minirt_integrator defaultIntegrator(const minirt_scene* s) {
    if (s->desc.integrator == MINIRT_INTEGRATOR_WHITTED || s->desc.integrator == MINIRT_INTEGRATOR_WHITTED_SHARED)
        return whittedIntegrator(s);
    const bool waves = s->context->info.is_cpu && s->context->hasBallots;
    const minirt_integrator faster = waves ? MINIRT_INTEGRATOR_WAVEFRONT : MINIRT_INTEGRATOR_PATH;
    return hasIntegrator(s, faster) ? faster : static_cast<minirt_integrator>(s->desc.integrator);
}

inline minirt_result resolveDesc(minirt_job* job, const minirt_render_desc* desc) {
    const minirt_scene_desc& scene = job->scene->desc;
    if (desc) job->desc = *desc;
    minirt_render_desc& d = job->desc;
    minirt_context* c = job->scene->context;
    if (!d.width && !d.height) {
        d.width = scene.width;
        d.height = scene.height;
    }
    if (!d.samples) d.samples = scene.samples;
    d.max_depth = d.max_depth ? d.max_depth - 1 : scene.max_depth;
    if (!d.integrator) d.integrator = defaultIntegrator(job->scene);
    if (d.integrator == MINIRT_INTEGRATOR_WHITTED_SHARED) d.integrator = whittedIntegrator(job->scene);
    if (!(d.max_dispatch_ms > 0)) d.max_dispatch_ms = 100.0f;
    if (d.throughput_cutoff == 0) d.throughput_cutoff = scene.throughput_cutoff;
    if (!d.region.width && !d.region.height && !d.region.x && !d.region.y) d.region = {0, 0, d.width, d.height};
    if (!d.width || !d.height || d.width > 16384 || d.height > 16384)
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "width and height must be 1 to 16384 (or both 0 for the scene's)");
    if (d.max_depth > 255)
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "max_depth must be at most 256 (a limit of 255 bounces)");
    if (d.integrator > MINIRT_INTEGRATOR_WHITTED_SHARED) return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "unknown integrator");
    if (d.light_sampling > MINIRT_LIGHT_SAMPLING_SURFACES)
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "unknown light_sampling");
    if (!(d.clamp >= 0)) return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "clamp must not be negative");
    if (isnan(d.throughput_cutoff)) return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "throughput_cutoff is not a number");
    if (!d.region.width || !d.region.height || d.region.x > d.width || d.region.width > d.width - d.region.x ||
        d.region.y > d.height || d.region.height > d.height - d.region.y)
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "the region lies outside of the image");
    if (d.samples > UINT32_MAX - d.first_sample)
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "first_sample + samples is too large");
    job->camera = d.camera ? *d.camera : scene.camera;
    d.camera = &job->camera;
    return MINIRT_OK;
}

/* Segments that a pixel's list can hold. */
inline uint32_t waitingRoom(const minirt_job* job) {
    const uint32_t waits = job->scene->activeWaits;
    return waits ? job->desc.max_depth + waits - 1 : 0;
}

inline bool sharesTrees(const minirt_job* job) {
    return job->desc.integrator == MINIRT_INTEGRATOR_WHITTED_SHARED;
}

/* Places of a group's rings for each of its lanes: as many as wait on a pixel's own list, and some for what all lanes leave at once. */
inline uint32_t ringPlaces(const minirt_job* job) {
    return larger(waitingRoom(job) + 4u, 16u);
}

/* Most bytes of state. */
inline VkDeviceSize stateBudget(const minirt_context* c) {
    const VkDeviceSize budget =
        c->info.is_cpu ? VkDeviceSize(64) << 20 : smaller<VkDeviceSize>(VkDeviceSize(1) << 30, c->info.memory_bytes / 8);
    return smaller<VkDeviceSize>(budget, c->limits.maxStorageBufferRange);
}

/* Of a segment that waits, with its pixel. */
inline VkDeviceSize sharedSegmentBytes(const minirt_job* job) {
    return VkDeviceSize(4) * MINIRT_SHARED_SEGMENT_WORDS(job->scene->desc.volume_capacity);
}

/* Of a group of the kernel whitted_shared; it has a subgroup a lane at most. */
inline VkDeviceSize sharedGroupBytes(const minirt_job* job) {
    return kBlockPixels * (ringPlaces(job) * sharedSegmentBytes(job) + VkDeviceSize(4) * MINIRT_SHARED_RING_WORDS);
}

/* Groups of the kernel whitted_shared over so many blocks: no more than a device runs at once, or have room for their rings in half of the state; each takes
   pixels until there are no more. */
inline uint32_t sharedGroups(const minirt_job* job, uint32_t blocks) {
    const VkDeviceSize fits = larger<VkDeviceSize>(stateBudget(job->scene->context) / 2 / sharedGroupBytes(job), 1);
    return static_cast<uint32_t>(smaller<VkDeviceSize>(smaller(blocks, 2048u), fits));
}

/* Bytes of the kernel whitted_shared (shaders/whitted/shared_work.glsl): those that are zero when pixels begin, and all. */
inline VkDeviceSize sharedZeroBytes(uint32_t blocks) {
    return (MINIRT_SHARED_COUNTER_WORDS + MINIRT_SHARED_QUEUE + VkDeviceSize(blocks) * kBlockPixels * MINIRT_SHARED_SUM_WORDS) *
           4;
}

inline VkDeviceSize sharedBytes(const minirt_job* job, uint32_t blocks) {
    return sharedZeroBytes(blocks) + MINIRT_SHARED_QUEUE * sharedSegmentBytes(job) +
           sharedGroups(job, blocks) * sharedGroupBytes(job);
}

/* Words of saved state a pixel; the layout is in shaders/common/suspend.glsl and the kernel. */
inline uint32_t stateWords(const minirt_job* job) {
    const minirt_scene* s = job->scene;
    const uint32_t volumes = s->desc.volume_capacity;
    const uint32_t ray = MINIRT_TRAVERSAL_WORDS + s->desc.bvh_depth;
    if (job->desc.integrator == MINIRT_INTEGRATOR_PATH || job->desc.integrator == MINIRT_INTEGRATOR_WAVEFRONT)
        return MINIRT_PATH_WORDS(volumes) + ray;
    return MINIRT_WALK_WORDS(volumes) + ray + waitingRoom(job) * MINIRT_SEGMENT_WORDS(volumes);
}

inline minirt_result ensureBuffer(minirt_scene* s, uint32_t binding, VkDeviceSize size, VkBufferUsageFlags usage) {
    if (s->buffers[binding].size >= size) return MINIRT_OK;
    return createBuffer(s->context, size, usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::device, s->buffers[binding]);
}

/* The state of as many blocks as a dispatch may take. */
inline minirt_result allocateState(minirt_job* job) {
    const minirt_context* c = job->scene->context;
    const VkDeviceSize budget = stateBudget(c);
    uint32_t blocks = smaller(job->blockCount, c->limits.maxComputeWorkGroupCount[0]);
    VkDeviceSize bytes = 0;
    if (sharesTrees(job)) {
        while (blocks > 1 && sharedBytes(job, blocks) > budget) blocks = (blocks + 1) / 2;
        bytes = sharedBytes(job, blocks);
    } else {
        const VkDeviceSize blockBytes = VkDeviceSize(stateWords(job)) * kBlockPixels * 4;
        blocks = static_cast<uint32_t>(smaller<VkDeviceSize>(larger<VkDeviceSize>(budget / blockBytes, 1), blocks));
        bytes = blocks * blockBytes;
    }
    job->stateBlocks = blocks;
    return ensureBuffer(job->scene, MINIRT_BINDING_STATE, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

inline minirt_result allocateJobBuffers(minirt_job* job) {
    minirt_scene* s = job->scene;
    minirt_context* c = s->context;
    const VkDeviceSize pixels = VkDeviceSize(job->desc.width) * job->desc.height;
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (pixels * 16 > c->limits.maxStorageBufferRange)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED, "the image is too large for this device");
    if (minirt_result r = ensureBuffer(s, MINIRT_BINDING_FILM, pixels * 16, usage)) return r;
    if (minirt_result r = ensureBuffer(s, MINIRT_BINDING_RAY_COUNTS, pixels * 8, usage)) return r;
    if (minirt_result r = allocateState(job)) return r;
    if (job->desc.integrator != MINIRT_INTEGRATOR_WAVEFRONT) return MINIRT_OK;
    const VkDeviceSize words = MINIRT_QUEUE_COUNT * (MINIRT_QUEUE_HEADER_WORDS + VkDeviceSize(job->stateBlocks) * kBlockPixels);
    return ensureBuffer(s, MINIRT_BINDING_QUEUES, words * 4,
                        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

inline void setFrame(minirt_job* job) {
    const minirt_render_desc& d = job->desc;
    const minirt_region& region = d.region;
    const bool queues = d.integrator == MINIRT_INTEGRATOR_WAVEFRONT;
    const uint32_t room = queues ? job->stateBlocks * kBlockPixels : sharesTrees(job) ? ringPlaces(job) : waitingRoom(job);
    job->frame.size = {d.width, d.height, room, 0};
    job->frame.region = {region.x, region.y, region.x + region.width, region.y + region.height};
    job->frame.up.w = d.clamp;
    job->frame.position.w = larger(d.throughput_cutoff, 0.0f);
    job->frame.blocks = {0, (region.width + 7) / 8, d.seed, stateWords(job)};
    job->frame.sampling = {d.first_sample, d.light_sampling << MINIRT_FRAME_LIGHTS_SHIFT, d.max_depth, 0};
}

inline void recordKernel(minirt_job* job, VkCommandBuffer commands, uint32_t kernel, uint32_t groups) {
    minirt_scene* s = job->scene;
    minirt_context* c = s->context;
    c->vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, s->pipelines[kernel]);
    c->vk.CmdPushConstants(commands, s->pipelineLayout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof job->frame, &job->frame);
    c->vk.CmdDispatch(commands, groups, 1, 1);
}

/* A kernel over the paths that wait in a queue. */
inline void recordQueue(minirt_job* job, VkCommandBuffer commands, uint32_t kernel, uint32_t queue) {
    minirt_scene* s = job->scene;
    minirt_context* c = s->context;
    if (!s->pipelines[kernel]) return;
    c->vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, s->pipelines[kernel]);
    c->vk.CmdPushConstants(commands, s->pipelineLayout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof job->frame, &job->frame);
    c->vk.CmdDispatchIndirect(commands, s->buffers[MINIRT_BINDING_QUEUES].buffer,
                              VkDeviceSize(queue) * MINIRT_QUEUE_HEADER_WORDS * 4);
}

inline void recordEmptyQueues(minirt_job* job, VkCommandBuffer commands, uint32_t first, uint32_t count) {
    minirt_context* c = job->scene->context;
    uint32_t headers[MINIRT_QUEUE_COUNT * MINIRT_QUEUE_HEADER_WORDS];
    for (uint32_t i = 0; i < MINIRT_QUEUE_COUNT * MINIRT_QUEUE_HEADER_WORDS; ++i) headers[i] = i % 4 == 1 || i % 4 == 2 ? 1 : 0;
    constexpr VkDeviceSize kHeaderBytes = VkDeviceSize(MINIRT_QUEUE_HEADER_WORDS) * 4;
    c->vk.CmdUpdateBuffer(commands, job->scene->buffers[MINIRT_BINDING_QUEUES].buffer, first * kHeaderBytes, count * kHeaderBytes,
                          headers);
    memoryBarrier(c, commands);
}

/* All rays that wait, then what they found, then the shadow rays from there. Rounds take turns with the queues of rays. */
inline void recordRound(minirt_job* job, VkCommandBuffer commands, uint32_t round) {
    minirt_context* c = job->scene->context;
    const uint32_t first = round % 2 ? MINIRT_QUEUE_HITS : MINIRT_QUEUE_EVEN_RAYS;
    job->frame.sampling.w = round % 2;
    recordQueue(job, commands, kWaveClosest, round % 2 ? MINIRT_QUEUE_ODD_RAYS : MINIRT_QUEUE_EVEN_RAYS);
    memoryBarrier(c, commands);
    recordQueue(job, commands, kWaveHit, MINIRT_QUEUE_HITS);
    if (job->scene->pipelines[kWaveMiss])
        memoryBarrier(c, commands);  // between them for the validation layer, which sees only whole buffers
    recordQueue(job, commands, kWaveMiss, MINIRT_QUEUE_MISSES);
    memoryBarrier(c, commands);
    recordQueue(job, commands, kWaveShadow, round % 2 ? MINIRT_QUEUE_ODD_SHADOWS : MINIRT_QUEUE_EVEN_SHADOWS);
    memoryBarrier(c, commands);
    recordEmptyQueues(job, commands, first, 4);
}

/* Rounds of one submission: a path needs one a bounce and one at its end; those that pass surfaces or spend a budget need more, and get them in the
   next submission. Even, so that it starts with the same queues. */
inline uint32_t roundsOf(const minirt_job* job) {
    return smaller(job->desc.max_depth + 4u, 32u) & ~1u;
}

inline void recordWavefront(minirt_job* job, VkCommandBuffer commands, uint32_t groups) {
    minirt_context* c = job->scene->context;
    const minirt_frame frame = job->frame;
    if (frame.sampling.w == 0) {
        recordEmptyQueues(job, commands, 0, MINIRT_QUEUE_COUNT);
        recordKernel(job, commands, kWaveGenerate, groups);
        memoryBarrier(c, commands);
    }
    for (uint32_t round = 0; round < roundsOf(job); ++round) recordRound(job, commands, round);
    recordKernel(job, commands, kWaveAccumulate, groups);
    job->frame = frame;
}

/* The kernel whitted_shared over so many blocks, then their pixels to the film. */
inline void recordShared(minirt_job* job, VkCommandBuffer commands, uint32_t blocks) {
    minirt_context* c = job->scene->context;
    const minirt_frame frame = job->frame;
    job->frame.blocks.w = blocks * kBlockPixels;
    if (frame.sampling.w == 0) {
        c->vk.CmdFillBuffer(commands, job->scene->buffers[MINIRT_BINDING_STATE].buffer, 0, sharedZeroBytes(blocks), 0);
        memoryBarrier(c, commands);
    }
    recordKernel(job, commands, 0, sharedGroups(job, blocks));
    memoryBarrier(c, commands);
    job->frame.sampling.w = 2;
    recordKernel(job, commands, 0, blocks);
    job->frame = frame;
}

/* One pass over `groups` blocks: begun, or gone on with where frame.sampling.w says so. */
inline void recordDispatch(minirt_job* job, VkCommandBuffer commands, uint32_t groups) {
    minirt_scene* s = job->scene;
    minirt_context* c = s->context;
    c->vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, s->pipelineLayout, 0, 1, &s->descriptorSet, 0, nullptr);
    if (job->desc.integrator == MINIRT_INTEGRATOR_WAVEFRONT)
        recordWavefront(job, commands, groups);
    else if (sharesTrees(job))
        recordShared(job, commands, groups);
    else
        recordKernel(job, commands, 0, groups);
    memoryBarrier(c, commands);
}

/* Submits one dispatch, waits, gives its duration by the device's clock where it has one. */
inline minirt_result dispatch(minirt_job* job, uint32_t groups, double* ms) {
    minirt_context* c = job->scene->context;
    const bool timed = c->queries != VK_NULL_HANDLE;
    if (minirt_result r = beginCommands(c)) return r;
    if (timed) {
        c->vk.CmdResetQueryPool(c->commands, c->queries, 0, 2);
        c->vk.CmdWriteTimestamp(c->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, c->queries, 0);
    }
    recordDispatch(job, c->commands, groups);
    if (timed) c->vk.CmdWriteTimestamp(c->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, c->queries, 1);
    const double start = nowMs();
    if (minirt_result r = submitAndWait(c)) return r;
    *ms = nowMs() - start;
    uint64_t ticks[2] = {};
    if (timed && c->vk.GetQueryPoolResults(c->device, c->queries, 0, 2, sizeof ticks, ticks, sizeof ticks[0],
                                           VK_QUERY_RESULT_64_BIT) == VK_SUCCESS)
        *ms = static_cast<double>((ticks[1] - ticks[0]) & c->timestampMask) * c->timestampPeriodNs * 1e-6;
    return MINIRT_OK;
}

inline void recordClear(minirt_job* job, VkCommandBuffer commands) {
    minirt_context* c = job->scene->context;
    c->vk.CmdFillBuffer(commands, job->scene->buffers[MINIRT_BINDING_FILM].buffer, 0, VK_WHOLE_SIZE, 0);
    c->vk.CmdFillBuffer(commands, job->scene->buffers[MINIRT_BINDING_RAY_COUNTS].buffer, 0, VK_WHOLE_SIZE, 0);
    memoryBarrier(c, commands);
}

/* Drivers that compile late do so at the first dispatch: an empty one belongs to the pipeline's time, not the picture's. */
inline minirt_result warmUp(minirt_job* job) {
    minirt_scene* s = job->scene;
    if (s->blocksPerMs > 0) return MINIRT_OK;
    const double start = nowMs();
    const minirt_frame frame = job->frame;
    job->frame.region = {};
    double ignored;
    const minirt_result r = dispatch(job, 1, &ignored);
    job->frame = frame;
    s->pipelineMs += nowMs() - start;
    return r;
}

inline minirt_counters* hostCounters(const minirt_scene* s) {
    return static_cast<minirt_counters*>(s->buffers[MINIRT_BINDING_COUNTERS].mapped);
}

/* Moves what the kernels counted into the job's statistics; gives the number of pending pixels. */
inline uint32_t takeCounters(minirt_job* job) {
    minirt_counters* counters = hostCounters(job->scene);
    const uint32_t pending = counters->pending;
    job->stats.nan_pixels += counters->nan_pixels;
    job->stats.segment_overflow += counters->segment_overflow;
    job->stats.traversal_cap += counters->unfinished;
    job->stats.volume_overflow += counters->volume_overflow;
    memset(counters, 0, sizeof *counters);
    return pending;
}

/* Empties film and counters. */
inline minirt_result clearJob(minirt_job* job) {
    minirt_context* c = job->scene->context;
    if (minirt_result r = beginCommands(c)) return r;
    recordClear(job, c->commands);
    if (minirt_result r = submitAndWait(c)) return r;
    memset(hostCounters(job->scene), 0, sizeof(minirt_counters));
    job->recorded = false;
    return MINIRT_OK;
}

inline minirt_result startJob(minirt_job* job, const minirt_render_desc* desc) {
    minirt_scene* s = job->scene;
    minirt_context* c = s->context;
    job->startMs = nowMs();
    if (minirt_result r = resolveDesc(job, desc)) return r;
    if (!hasIntegrator(s, job->desc.integrator))
        return fail(c, MINIRT_ERROR_NO_KERNEL, "the blob holds no kernel for this integrator; bake the scene with it");
    if (job->desc.integrator == MINIRT_INTEGRATOR_WAVEFRONT && !c->hasBallots)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED,
                    "the wavefront needs subgroup ballots, which this device lacks; use the integrator 'path'");
    if (sharesTrees(job) && !c->canShareTrees)
        return fail(c, MINIRT_ERROR_DEVICE_UNSUPPORTED,
                    "'whitted_shared' takes a GPU with subgroup ballots; bake the scene with the integrator 'whitted' too");
    if (minirt_result r = activateIntegrator(s, job->desc.integrator)) return r;
    const minirt_region& region = job->desc.region;
    job->blockCount = ((region.width + 7) / 8) * ((region.height + 7) / 8);
    if (minirt_result r = allocateJobBuffers(job)) return r;
    setFrame(job);
    if (!aimCamera(s, job->camera, job->frame))
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "the camera's position, target, up or vfov do not make a view");
    writeDescriptors(s);
    s->blocksPerMs /= 8;  // this job's pixels may cost more than the last one's did
    if (minirt_result r = clearJob(job)) return r;
    return warmUp(job);
}

/* How many blocks the next dispatch may take to stay within its time. */
inline uint32_t blocksToDispatch(const minirt_job* job) {
    const minirt_scene* s = job->scene;
    const double first = s->context->info.is_cpu ? 32.0 : 4096.0;
    const double wanted = s->blocksPerMs > 0 ? s->blocksPerMs * static_cast<double>(job->desc.max_dispatch_ms) : first;
    const uint32_t limit = smaller(job->stateBlocks, job->blockCount - job->nextBlock);
    return wanted >= limit ? limit : larger(static_cast<uint32_t>(wanted), 1u);
}

inline void learnSpeed(minirt_job* job) {
    minirt_scene* s = job->scene;
    const double measured = job->dispatchBlocks / larger(job->dispatchMs, 1e-3);
    const double before = s->blocksPerMs;
    s->blocksPerMs = before > 0 ? smaller(measured, before * 8) : measured * 0.5;
    s->blocksPerMs = before > 0 && measured > before ? before + (s->blocksPerMs - before) * 0.5 : s->blocksPerMs;
}

inline minirt_result step(minirt_job* job) {
    if (job->recorded)
        if (minirt_result r = clearJob(job)) return r;
    if (!job->resume) {
        job->dispatchBlocks = blocksToDispatch(job);
        job->dispatchMs = 0;
        job->frame.blocks.x = job->nextBlock;
        job->frame.sampling.x = job->desc.first_sample + job->samplesDone;
    }
    job->frame.sampling.w = job->resume ? 1 : 0;
    double ms = 0;
    if (minirt_result r = dispatch(job, job->dispatchBlocks, &ms)) return r;
    job->stats.dispatches++;
    job->stats.resumed_dispatches += job->resume ? 1 : 0;
    job->stats.gpu_ms += ms;
    job->dispatchMs += ms;
    job->resume = takeCounters(job) > 0;
    if (job->resume) return MINIRT_OK;
    learnSpeed(job);
    job->nextBlock += job->dispatchBlocks;
    if (job->nextBlock == job->blockCount) {
        job->nextBlock = 0;
        job->samplesDone++;
    }
    return MINIRT_OK;
}

inline void getProgress(const minirt_job* job, minirt_progress* progress) {
    progress->done = job->samplesDone >= job->desc.samples;
    progress->samples_done = job->samplesDone;
    progress->fraction = (job->samplesDone + static_cast<double>(job->nextBlock) / job->blockCount) / job->desc.samples;
}

/* Host-visible contents of a buffer; copied through `copy` where the device's memory cannot be read. */
inline minirt_result readBuffer(minirt_scene* s, uint32_t binding, Buffer& copy, const void** data) {
    minirt_context* c = s->context;
    const Buffer& source = s->buffers[binding];
    *data = source.mapped;
    if (source.mapped) return MINIRT_OK;
    if (copy.size < source.size)
        if (minirt_result r = createBuffer(c, source.size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::readBack, copy)) return r;
    if (minirt_result r = beginCommands(c)) return r;
    const VkBufferCopy region = {0, 0, source.size};
    c->vk.CmdCopyBuffer(c->commands, source.buffer, copy.buffer, 1, &region);
    memoryBarrier(c, c->commands);
    *data = copy.mapped;
    return submitAndWait(c);
}

inline void sumRays(const minirt_job* job, const uint32_t* counts, minirt_stats* stats) {
    const uint64_t pixels = uint64_t(job->desc.width) * job->desc.height;
    for (uint64_t i = 0; i < pixels; ++i) {
        stats->shadow_rays += counts[2 * i];
        stats->secondary_rays += counts[2 * i + 1];
    }
}

/* >>implementation-lifetime */
inline void unlink(minirt_scene* scene) {
    minirt_scene** link = &scene->context->scenes;
    while (*link && *link != scene) link = &(*link)->next;
    if (*link) *link = scene->next;
}

inline void destroyScene(minirt_scene* s) {
    minirt_context* c = s->context;
    if (!c->lost) c->vk.QueueWaitIdle(c->queue);
    hostDelete(c->allocator, s->job);
    destroyPipelines(s);
    for (Buffer& buffer : s->buffers) destroyBuffer(c, buffer);
    destroyBuffer(c, s->filmReadBack);
    destroyBuffer(c, s->countsReadBack);
    hostRelease(c->allocator, s->media);
    hostRelease(c->allocator, s->kernels);
    hostRelease(c->allocator, s->spirv);
    hostDelete(c->allocator, s);
}

/* A copy of an array of the blob, for the host; NULL when out of memory. */
template <typename T>
T* copyArray(const minirt_allocator& allocator, const T* from, uint64_t count) {
    const size_t bytes = static_cast<size_t>(count) * sizeof(T);
    T* copy = static_cast<T*>(hostAllocate(allocator, bytes ? bytes : sizeof(T)));
    if (copy && bytes) memcpy(copy, from, bytes);
    return copy;
}

inline minirt_result copyKernels(minirt_scene* s, const minirt_blob& blob) {
    const minirt_allocator& allocator = s->context->allocator;
    s->kernels = copyArray(allocator, blob.kernels, blob.kernel_count);
    s->spirv = copyArray(allocator, blob.spirv, blob.spirv_size);
    s->media = copyArray(allocator, blob.media, blob.medium_count);
    if (!s->kernels || !s->spirv || !s->media) return fail(s->context, MINIRT_ERROR_OUT_OF_MEMORY, "out of host memory");
    s->kernelCount = static_cast<uint32_t>(blob.kernel_count);
    s->mediumCount = static_cast<uint32_t>(blob.medium_count);
    return MINIRT_OK;
}

inline minirt_result fillScene(minirt_scene* s, const minirt_blob& blob) {
    const double start = nowMs();
    s->desc = *blob.scene;
    minirt_result r = copyKernels(s, blob);
    if (!r) r = uploadScene(s, blob);
    s->uploadMs = nowMs() - start;
    return r;
}

/* Uploads while another thread checks: nothing runs on the device before both are done. */
inline minirt_result checkAndFill(minirt_scene* s, BlobCheck& check, double startMs) {
    minirt_result results[2];
    atOnce(2, [&](uint32_t task) {
        results[task] = task == 0 ? fillScene(s, check.blob) : checkContents(check);
        if (task == 1) s->loadMs = nowMs() - startMs;
    });
    return results[1] ? results[1] : results[0];
}

inline minirt_result createScene(minirt_context* c, const void* data, size_t size, double startMs, minirt_scene** out) {
    minirt_validation validation;
    BlobCheck check = {{static_cast<const uint8_t*>(data), size, {}, &validation}, {}, {}, nullptr};
    minirt_scene* s = hostNew<minirt_scene>(c->allocator);
    if (!s) return fail(c, MINIRT_ERROR_OUT_OF_MEMORY, "out of host memory");
    s->context = c;
    minirt_result r = openBlob(check, c->allocator);
    if (!r) r = checkAndFill(s, check, startMs);
    hostRelease(c->allocator, check.depth);
    if (r) {
        destroyScene(s);
        return check.reader.result ? fail(c, r, "%s", validation.message) : r;
    }
    s->next = c->scenes;
    c->scenes = s;
    *out = s;
    return MINIRT_OK;
}

/* A whole file in memory, aligned to 16 bytes: mapped where the system can. */
struct FileData {
    void* data = nullptr;
    size_t size = 0;
    bool mapped = false;
};

inline minirt_result readWholeFile(minirt_context* c, FILE* file, const char* path, FileData& out) {
    size_t capacity = 1u << 16;
    out.data = hostAllocate(c->allocator, capacity);
    while (out.data) {
        out.size += fread(static_cast<uint8_t*>(out.data) + out.size, 1, capacity - out.size, file);
        if (out.size < capacity) break;
        void* grown = hostAllocate(c->allocator, capacity * 2);
        if (grown) memcpy(grown, out.data, out.size);
        hostRelease(c->allocator, out.data);
        out.data = grown;
        capacity *= 2;
    }
    if (!out.data) return fail(c, MINIRT_ERROR_OUT_OF_MEMORY, "out of host memory for %s", path);
    return ferror(file) ? fail(c, MINIRT_ERROR_FILE, "%s: cannot be read", path) : MINIRT_OK;
}

inline minirt_result openFile(minirt_context* c, const char* path, FileData& out) {
#if defined(MINIRT_HAS_MMAP)
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    struct stat status;
    if (descriptor >= 0 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
        void* memory = mmap(nullptr, static_cast<size_t>(status.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
        if (memory != MAP_FAILED) {
            out.data = memory;
            out.size = static_cast<size_t>(status.st_size);
            out.mapped = true;
        }
    }
    if (descriptor >= 0) close(descriptor);
    if (out.mapped) return MINIRT_OK;
#endif
    FILE* file = fopen(path, "rb");
    if (!file) return fail(c, MINIRT_ERROR_FILE, "%s: cannot be opened; does the file exist?", path);
    const minirt_result r = readWholeFile(c, file, path, out);
    fclose(file);
    return r;
}

inline void closeFile(minirt_context* c, FileData& file) {
#if defined(MINIRT_HAS_MMAP)
    if (file.mapped) {
        munmap(file.data, file.size);
        return;
    }
#endif
    hostRelease(c->allocator, file.data);
}

inline minirt_result prepareContext(const minirt_context_desc* desc, minirt_context** out) {
    const minirt_context_desc d = desc ? *desc : minirt_context_desc();
    *out = nullptr;
    if (!d.allocator.allocate != !d.allocator.release) return MINIRT_ERROR_INVALID_ARGUMENT;
    minirt_context* c = hostNew<minirt_context>(d.allocator);
    if (!c) return MINIRT_ERROR_OUT_OF_MEMORY;
    c->allocator = d.allocator;
    c->log = d.log;
    c->logUser = d.log_user;
    *out = c;
    return MINIRT_OK;
}

}  // namespace minirt_detail

/* >>implementation-api */
extern "C" {

const char* minirt_result_string(minirt_result result) {
    switch (result) {
        case MINIRT_OK:
            return "success";
        case MINIRT_ERROR_INVALID_ARGUMENT:
            return "invalid argument";
        case MINIRT_ERROR_OUT_OF_MEMORY:
            return "out of host memory";
        case MINIRT_ERROR_NO_VULKAN:
            return "no Vulkan loader (Debian: install libvulkan1 and mesa-vulkan-drivers)";
        case MINIRT_ERROR_NO_DEVICE:
            return "no such Vulkan device (Debian: mesa-vulkan-drivers renders without a GPU)";
        case MINIRT_ERROR_DEVICE_UNSUPPORTED:
            return "the device cannot do this";
        case MINIRT_ERROR_DEVICE_OUT_OF_MEMORY:
            return "out of device memory";
        case MINIRT_ERROR_DEVICE_LOST:
            return "the device was lost";
        case MINIRT_ERROR_VULKAN:
            return "a Vulkan call failed";
        case MINIRT_ERROR_FILE:
            return "the file cannot be read";
        case MINIRT_ERROR_NOT_A_BLOB:
            return "not a minirt blob";
        case MINIRT_ERROR_VERSION:
            return "another version of the format";
        case MINIRT_ERROR_TRUNCATED:
            return "the blob has the wrong length";
        case MINIRT_ERROR_CHECKSUM:
            return "the blob is damaged";
        case MINIRT_ERROR_SECTION_OUT_OF_BOUNDS:
            return "a section lies outside of the blob";
        case MINIRT_ERROR_SECTION_MISSING:
            return "a section of the blob is missing";
        case MINIRT_ERROR_CORRUPT:
            return "the blob's contents are invalid";
        case MINIRT_ERROR_NO_KERNEL:
            return "the blob holds no kernel for this integrator";
        case MINIRT_ERROR_BUSY:
            return "the scene is being rendered already";
        case MINIRT_CANCELLED:
            return "cancelled";
    }
    return "unknown result";
}

uint64_t minirt_checksum(const void* data, size_t size) {
    using minirt_detail::mixLane;
    uint64_t a = 0x243F6A8885A308D3ull, b = 0x13198A2E03707344ull, c = 0xA4093822299F31D0ull, d = 0x082EFA98EC4E6C89ull;
    const uint8_t* bytes = static_cast<const uint8_t*>(data);
    for (size_t at = 0; at + 32 <= size; at += 32) { /* four chains at once; as an array they would stay in memory */
        uint64_t words[4];
        memcpy(words, bytes + at, sizeof words);
        a = mixLane(a, words[0]);
        b = mixLane(b, words[1]);
        c = mixLane(c, words[2]);
        d = mixLane(d, words[3]);
    }
    return mixLane(mixLane(mixLane(mixLane(size, a), b), c), d);
}

uint64_t minirt_header_checksum(const void* data, size_t size) {
    constexpr size_t kHeader = sizeof(minirt_blob_header);
    uint8_t first[kHeader];
    memcpy(first, data, kHeader);
    memset(first + offsetof(minirt_blob_header, checksum), 0, sizeof(uint64_t));
    const uint64_t rest = minirt_checksum(static_cast<const uint8_t*>(data) + kHeader, size - kHeader);
    return minirt_detail::mixLane(minirt_checksum(first, kHeader), rest);
}

minirt_result minirt_validate(const void* data, size_t size, minirt_blob* blob, minirt_validation* validation) {
    return minirt_detail::validate(data, size, blob, validation, minirt_allocator());
}

minirt_result minirt_create(const minirt_context_desc* desc, minirt_context** out) {
    if (!out) return MINIRT_ERROR_INVALID_ARGUMENT;
    if (minirt_result r = minirt_detail::prepareContext(desc, out)) return r;
    const minirt_result r = minirt_detail::openContext(*out, desc ? *desc : minirt_context_desc());
    if (r) {
        minirt_destroy(*out);
        *out = nullptr;
    }
    return r;
}

void minirt_destroy(minirt_context* context) {
    if (!context) return;
    while (context->scenes) minirt_unload(context->scenes);
    minirt_detail::closeContext(context);
    const minirt_allocator allocator = context->allocator;
    minirt_detail::hostDelete(allocator, context);
}

const char* minirt_last_message(const minirt_context* context) {
    return context ? context->message : "";
}

void minirt_get_device_info(const minirt_context* context, minirt_device_info* info) {
    *info = context->info;
}

minirt_result minirt_list_devices(const minirt_context_desc* desc, minirt_device_info* infos, uint32_t* count) {
    using namespace minirt_detail;
    if (!count) return MINIRT_ERROR_INVALID_ARGUMENT;
    const uint32_t room = infos ? *count : 0;
    *count = 0;
    minirt_context* c;
    if (minirt_result r = prepareContext(desc, &c)) return r;
    minirt_result r = openLoader(c, desc ? desc->host : minirt_host_device());
    if (!r) r = createInstance(c, desc ? desc->validation : 0);
    if (!r) r = loadInstanceFunctions(c);
    if (!r) {
        VkPhysicalDevice devices[kMaxDevices];
        *count = rankedDevices(c, devices);
        for (uint32_t i = 0; i < *count && i < room; ++i) infos[i] = describe(c, devices[i]);
    }
    minirt_destroy(c);
    return r;
}

minirt_result minirt_load_memory(minirt_context* context, const void* data, size_t size, minirt_scene** out) {
    using namespace minirt_detail;
    if (!context || !out) return MINIRT_ERROR_INVALID_ARGUMENT;
    *out = nullptr;
    if (context->lost) return MINIRT_ERROR_DEVICE_LOST;
    const double start = nowMs();
    if (reinterpret_cast<uintptr_t>(data) % 16 == 0) return createScene(context, data, size, start, out);
    void* aligned = hostAllocate(context->allocator, size);
    if (!aligned) return fail(context, MINIRT_ERROR_OUT_OF_MEMORY, "out of host memory");
    memcpy(aligned, data, size);
    const minirt_result r = createScene(context, aligned, size, start, out);
    hostRelease(context->allocator, aligned);
    return r;
}

minirt_result minirt_load_file(minirt_context* context, const char* path, minirt_scene** out) {
    using namespace minirt_detail;
    if (!context || !out || !path) return MINIRT_ERROR_INVALID_ARGUMENT;
    *out = nullptr;
    if (context->lost) return MINIRT_ERROR_DEVICE_LOST;
    const double start = nowMs();
    FileData file;
    minirt_result r = openFile(context, path, file);
    if (!r) r = createScene(context, file.data, file.size, start, out);
    closeFile(context, file);
    return r;
}

void minirt_unload(minirt_scene* scene) {
    if (!scene) return;
    minirt_detail::unlink(scene);
    minirt_detail::destroyScene(scene);
}

void minirt_get_scene_desc(const minirt_scene* scene, minirt_scene_desc* desc) {
    *desc = scene->desc;
}

minirt_result minirt_begin(minirt_scene* scene, const minirt_render_desc* desc, minirt_job** out) {
    using namespace minirt_detail;
    if (!scene || !out) return MINIRT_ERROR_INVALID_ARGUMENT;
    *out = nullptr;
    minirt_context* c = scene->context;
    if (c->lost) return MINIRT_ERROR_DEVICE_LOST;
    if (scene->job) return fail(c, MINIRT_ERROR_BUSY, "the scene is being rendered already; end that job first");
    minirt_job* job = hostNew<minirt_job>(c->allocator);
    if (!job) return fail(c, MINIRT_ERROR_OUT_OF_MEMORY, "out of host memory");
    job->scene = scene;
    if (minirt_result r = startJob(job, desc)) {
        hostDelete(c->allocator, job);
        return r;
    }
    scene->job = job;
    *out = job;
    return MINIRT_OK;
}

minirt_result minirt_step(minirt_job* job, minirt_progress* progress) {
    using namespace minirt_detail;
    if (!job) return MINIRT_ERROR_INVALID_ARGUMENT;
    if (job->scene->context->lost) return MINIRT_ERROR_DEVICE_LOST;
    minirt_result r = MINIRT_OK;
    if (job->samplesDone < job->desc.samples) {
        r = step(job);
        job->stats.wall_ms = nowMs() - job->startMs;
    }
    if (progress) getProgress(job, progress);
    return r;
}

minirt_result minirt_read(minirt_job* job, float* rgba) {
    using namespace minirt_detail;
    if (!job || !rgba) return MINIRT_ERROR_INVALID_ARGUMENT;
    if (job->scene->context->lost) return MINIRT_ERROR_DEVICE_LOST;
    const void* data;
    if (minirt_result r = readBuffer(job->scene, MINIRT_BINDING_FILM, job->scene->filmReadBack, &data)) return r;
    const float* film = static_cast<const float*>(data);
    const uint64_t pixels = uint64_t(job->desc.width) * job->desc.height;
    for (uint64_t i = 0; i < pixels; ++i) {
        const float samples = film[4 * i + 3];
        for (uint64_t k = 0; k < 3; ++k) rgba[4 * i + k] = samples > 0 ? film[4 * i + k] / samples : 0.0f;
        rgba[4 * i + 3] = samples > 0 ? 1.0f : 0.0f;
    }
    return MINIRT_OK;
}

minirt_result minirt_get_stats(minirt_job* job, minirt_stats* stats) {
    using namespace minirt_detail;
    if (!job || !stats) return MINIRT_ERROR_INVALID_ARGUMENT;
    if (job->scene->context->lost) return MINIRT_ERROR_DEVICE_LOST;
    const void* data;
    if (minirt_result r = readBuffer(job->scene, MINIRT_BINDING_RAY_COUNTS, job->scene->countsReadBack, &data)) return r;
    takeCounters(job);
    *stats = job->stats;
    stats->width = job->desc.width;
    stats->height = job->desc.height;
    stats->samples = job->recorded ? 1 : job->samplesDone;
    stats->pipeline_ms = job->scene->pipelineMs;
    stats->load_ms = job->scene->loadMs;
    stats->upload_ms = job->scene->uploadMs;
    stats->primary_rays = uint64_t(job->desc.region.width) * job->desc.region.height * stats->samples;
    sumRays(job, static_cast<const uint32_t*>(data), stats);
    return MINIRT_OK;
}

void minirt_end(minirt_job* job) {
    if (!job) return;
    job->scene->job = nullptr;
    minirt_detail::hostDelete(job->scene->context->allocator, job);
}

minirt_result minirt_render(minirt_scene* scene, const minirt_render_desc* desc, float* rgba) {
    if (!scene || !rgba) return MINIRT_ERROR_INVALID_ARGUMENT;
    minirt_job* job;
    if (minirt_result r = minirt_begin(scene, desc, &job)) return r;
    minirt_progress progress = {};
    minirt_result r = MINIRT_OK;
    while (!r && !progress.done) {
        r = minirt_step(job, &progress);
        if (!r && job->desc.progress && job->desc.progress(job->desc.progress_user, &progress) && !progress.done)
            r = MINIRT_CANCELLED;
    }
    if (!r || r == MINIRT_CANCELLED) {
        const minirt_result read = minirt_read(job, rgba);
        const minirt_result stats = job->desc.stats ? minirt_get_stats(job, job->desc.stats) : MINIRT_OK;
        if (read || stats) r = read ? read : stats;
    }
    minirt_end(job);
    return r;
}

minirt_result minirt_record(minirt_job* job, VkCommandBuffer commands, VkImage image, const minirt_camera* camera,
                            uint32_t sample, uint32_t passes) {
    using namespace minirt_detail;
    if (!job || !commands || !image) return MINIRT_ERROR_INVALID_ARGUMENT;
    minirt_context* c = job->scene->context;
    if (c->lost) return MINIRT_ERROR_DEVICE_LOST;
    const minirt_frame before = job->frame;
    if (camera && !aimCamera(job->scene, *camera, job->frame)) {
        job->frame = before;
        return fail(c, MINIRT_ERROR_INVALID_ARGUMENT, "the camera's position, target, up or vfov do not make a view");
    }
    job->frame.sampling.x = sample;
    passes = passes ? passes : 4;
    recordClear(job, commands);
    for (uint32_t first = 0; first < job->blockCount; first += job->stateBlocks) {
        job->frame.blocks.x = first;
        for (uint32_t pass = 0; pass < passes; ++pass) {
            job->frame.sampling.w = pass ? 1 : 0;
            job->frame.size.w = pass + 1 == passes ? 1 : 0;
            recordDispatch(job, commands, smaller(job->stateBlocks, job->blockCount - first));
        }
    }
    VkBufferImageCopy copy = {};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {job->desc.width, job->desc.height, 1};
    c->vk.CmdCopyBufferToImage(commands, job->scene->buffers[MINIRT_BINDING_FILM].buffer, image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    job->frame = before;
    job->nextBlock = 0;
    job->resume = false;
    job->samplesDone = 0;
    job->recorded = true;
    job->stats = minirt_stats();
    return MINIRT_OK;
}

} /* extern "C" */
#endif /* MINIRT_IMPLEMENTATION */
