#ifndef MORULA_H
#define MORULA_H
#include <stddef.h>
#include <stdint.h>
#define MORULA_STATUS_OK 0
#define MORULA_STATUS_NULL_POINTER 1
#define MORULA_STATUS_INVALID_ARGUMENT 2
#define MORULA_STATUS_NOT_FINITE 3
#define MORULA_STATUS_INDEX_OUT_OF_RANGE 4
#define MORULA_STATUS_EMPTY 5
#define MORULA_STATUS_ZERO_VOLUME 6
#define MORULA_STATUS_OPEN_SURFACE 7
#define MORULA_STATUS_SEVERAL_BODIES 8
#define MORULA_STATUS_FORMAT 9
#define MORULA_STATUS_UNSUPPORTED 10
#define MORULA_STATUS_IO 11
#define MORULA_STATUS_MEMORY_LIMIT 12
#define MORULA_STATUS_OUT_OF_MEMORY 13
#define MORULA_STATUS_BUFFER_TOO_SMALL 14
#define MORULA_STATUS_CANCELLED 15
#define MORULA_STATUS_STRUCT_SIZE 16
#define MORULA_STATUS_TOO_LARGE 17
#define MORULA_STATUS_NOT_WANTED 18
#define MORULA_STATUS_NO_SPHERES 19
#define MORULA_STATUS_INTERNAL 20
#define MORULA_STATUS_NO_MASSES 21
#define MORULA_LOG_INFO 0
#define MORULA_LOG_WARNING 1
#define MORULA_STRUCT_IMPORT_OPTIONS 1
#define MORULA_STRUCT_FILE_OPTIONS 2
#define MORULA_STRUCT_SOLID_OPTIONS 3
#define MORULA_STRUCT_CLUMP_OPTIONS 4
#define MORULA_STRUCT_REPORT 5
#define MORULA_STRUCT_MOMENTS 6
#define MORULA_STRUCT_OVERLAP 7
#define MORULA_STRUCT_SURFACE 8
#define MORULA_STRUCT_COUNTERS 9
#define MORULA_STRUCT_MASS_OPTIONS 10
#define MORULA_STRUCT_MASSES 11
#define MORULA_STRUCT_CONTACT_OPTIONS 12
#define MORULA_STRUCT_TIMESTEP 13
#define MORULA_STRUCT_EXPORT_OPTIONS 14
#define MORULA_STRUCT_BREAK_OPTIONS 15
#define MORULA_STRUCT_HELD 16
#define MORULA_STRUCT_FRAGMENT 17
#define MORULA_STRUCT_BREAK_TOTALS 18
#define MORULA_STRUCT_CACHE_COUNTS 19
#define MORULA_STRUCT_COST_OPTIONS 20
#define MORULA_STRUCT_COST_POINT 21
#define MORULA_STRUCT_COST_BOUNDS 22
#define MORULA_STRUCT_SWEEP_OPTIONS 23
#define MORULA_STRUCT_SWEPT 24
#define MORULA_BODIES_REFUSE 0
#define MORULA_BODIES_LARGEST 1
#define MORULA_BODIES_ALL 2
#define MORULA_FORMAT_AUTO 0
#define MORULA_FORMAT_STL 1
#define MORULA_FORMAT_OBJ 2
#define MORULA_FORMAT_PLY 3
#define MORULA_FORMAT_OFF 4
#define MORULA_FORMAT_NPY 5
#define MORULA_FORMAT_TIFF 6
#define MORULA_FORMAT_RAW 7
#define MORULA_MEANING_AUTO 0
#define MORULA_MEANING_OTSU 1
#define MORULA_MEANING_ABOVE 2
#define MORULA_MEANING_LABEL 3
#define MORULA_RAW_U8 0
#define MORULA_RAW_U16 1
#define MORULA_RAW_F32 2
#define MORULA_CARVE_TOUCHED 0
#define MORULA_CARVE_CENTRES 1
#define MORULA_RESOLUTION_CELLS_LONGEST 0
#define MORULA_RESOLUTION_CELLS_SHORTEST 1
#define MORULA_RESOLUTION_CELLS_DIAMETER 2
#define MORULA_RESOLUTION_CELL_SIZE 3
#define MORULA_METHOD_MSS 0
#define MORULA_METHOD_BEST 1
#define MORULA_METHOD_SURFACE_FIT 2
#define MORULA_METHOD_INSCRIBED 3
#define MORULA_METHOD_COVER 4
#define MORULA_METHOD_PACKED 5
#define MORULA_METHOD_EUCLIDEAN 10
#define MORULA_METHOD_FERELLEC_MCDOWELL 11
#define MORULA_METHOD_FAVIER 12
#define MORULA_METHOD_UNIFORM_GRID 13
#define MORULA_EFFORT_DRAFT 0
#define MORULA_EFFORT_NORMAL 1
#define MORULA_EFFORT_THOROUGH 2
#define MORULA_LEVELS_FREE 0
#define MORULA_LEVELS_CHAINED 1
#define MORULA_LEVELS_NESTED 2
#define MORULA_GOAL_KNEE 0
#define MORULA_GOAL_SPHERES 1
#define MORULA_GOAL_MISMATCH 2
#define MORULA_GOAL_SECONDS 3
#define MORULA_GOAL_STEP_COST 4
#define MORULA_GOAL_TIME_COST 5
#define MORULA_SYMMETRY_NONE 0
#define MORULA_SYMMETRY_AUTO 1
#define MORULA_SYMMETRY_PLANES 2
#define MORULA_ENDS_SURFACE 0
#define MORULA_ENDS_CURVE 1
#define MORULA_CANDIDATES_THINNED 0
#define MORULA_CANDIDATES_ANALYTIC 1
#define MORULA_FRAME_INPUT 0
#define MORULA_FRAME_BODY 1
#define MORULA_FRAME_WORLD 2
#define MORULA_CUT_PLANES 0
#define MORULA_CUT_WITHIN 1
#define MORULA_CUT_POINTS 2
#define MORULA_CUT_SEEDED 3
#define MORULA_CUT_IMPACT 4
#define MORULA_WANT_NOTHING 0
#define MORULA_WANT_OVERLAP 1
#define MORULA_WANT_SURFACE 2
#define MORULA_WANT_MOMENTS 4
#define MORULA_STOPPED_SPHERES 0
#define MORULA_STOPPED_MISMATCH 1
#define MORULA_STOPPED_RADIUS 2
#define MORULA_STOPPED_DEADLINE 3
#define MORULA_STOPPED_CANCELLED 4
#define MORULA_STOPPED_EXHAUSTED 5
#define MORULA_STOPPED_COVERAGE 6
#define MORULA_TARGET_SOLID 0
#define MORULA_TARGET_UNION 1
#define MORULA_OBJECTIVE_EVEN 0
#define MORULA_OBJECTIVE_MAX_MIN 1
#define MORULA_OBJECTIVE_MAX_LAST 2
#define MORULA_INFEASIBLE_REFUSE 0
#define MORULA_INFEASIBLE_LEAST_ERROR 1
#define MORULA_MASSES_EXACT 0
#define MORULA_MASSES_RELAXED 1
#define MORULA_MASSES_MASS_ONLY 2
#define MORULA_MASSES_NONE 3
#define MORULA_EXPORT_MERCURY 0
#define MORULA_EXPORT_LAMMPS 1
#define MORULA_EXPORT_LAMMPS_RIGID 2
#define MORULA_EXPORT_LIGGGHTS 3
#define MORULA_EXPORT_YADE 4
#define MORULA_EXPORT_DEME 5
#define MORULA_EXPORT_MFIX 6
#define MORULA_EXPORT_KRATOS 7
#define MORULA_EXPORT_PFC 8
#define MORULA_EXPORT_EDEM 9
#define MORULA_EXPORT_CSV 10
#define MORULA_EXPORT_JSON 11
#define MORULA_EXPORT_VTP 12
#define MORULA_EXPORT_PLY 13
#define MORULA_EXPORT_STL 14
#define MORULA_PRECISION_F64 0
#define MORULA_PRECISION_F32 1
typedef struct morula_body morula_body;
typedef struct morula_cache morula_cache;
typedef struct morula_clump morula_clump;
typedef struct morula_cost morula_cost;
typedef struct morula_files morula_files;
typedef struct morula_fragments morula_fragments;
typedef struct morula_parent morula_parent;
typedef struct morula_shape morula_shape;
typedef struct morula_solid morula_solid;
typedef struct morula_sweep morula_sweep;
typedef void (*morula_log)(int32_t level, const char *text, void *user);
typedef int32_t (*morula_progress)(double fraction, void *user);
typedef struct morula_import_options {
  size_t struct_size;
  double weld_tolerance;
  double length_unit;
  uint64_t memory_limit;
  int32_t bodies;
  int32_t index_base;
  int32_t threads;
  int32_t reserved;
  morula_progress progress;
  void *user;
} morula_import_options;
typedef struct morula_report {
  size_t struct_size;
  uint64_t input_vertices;
  uint64_t input_faces;
  uint64_t vertices;
  uint64_t faces;
  uint64_t solid_cells;
  uint64_t components;
  uint64_t bodies;
  uint64_t bodies_dropped;
  uint64_t faces_turned;
  uint64_t boundary_edges;
  uint64_t nonmanifold_edges;
  uint64_t degenerate_faces;
  uint64_t duplicate_faces;
  uint64_t welded_vertices;
  int32_t watertight;
  int32_t oriented;
  int32_t inverted;
  int32_t touches_border;
  double volume;
  double area;
  double box_min[3];
  double box_max[3];
  double length_unit;
  double threshold;
} morula_report;
typedef struct morula_moments {
  size_t struct_size;
  double volume;
  double mass;
  double centre[3];
  double inertia[6];
  double principal[3];
  double rotation[9];
  double quaternion[4];
  double relative_error;
} morula_moments;
typedef struct morula_counters {
  size_t struct_size;
  double seconds_read;
  double seconds_check;
  double seconds_solid;
  double seconds_generate;
  double seconds_measure;
  double seconds_moments;
  uint64_t cells;
  uint64_t peak_bytes;
  uint64_t transforms;
  uint64_t exact_distances;
  uint64_t maxima;
  uint64_t spheres_tried;
  uint64_t columns;
} morula_counters;
typedef struct morula_file_options {
  size_t struct_size;
  int32_t format;
  int32_t meaning;
  double threshold;
  uint32_t label;
  int32_t npy_xyz;
  double spacing[3];
  double origin[3];
  uint64_t raw_dims[3];
  uint64_t raw_skip;
  int32_t raw_type;
  int32_t reserved;
} morula_file_options;
typedef struct morula_solid_options {
  size_t struct_size;
  int32_t resolution;
  uint32_t cells;
  double cell_size;
  uint64_t memory_limit;
  uint32_t padding;
  int32_t threads;
  morula_progress progress;
  void *user;
} morula_solid_options;
typedef struct morula_clump_options {
  size_t struct_size;
  uint64_t spheres;
  double mismatch;
  double min_radius;
  double min_distance;
  double radius_offset;
  double deadline_seconds;
  uint64_t seed;
  int32_t method;
  int32_t confine;
  int32_t threads;
  int32_t frame;
  uint32_t wants;
  uint32_t quality_columns;
  const double *plane_tolerances;
  size_t plane_tolerance_count;
  morula_progress progress;
  void *user;
  int32_t effort;
  int32_t reserved;
  double coverage;
  int32_t ends;
  int32_t candidates;
  uint32_t thinning_cells;
  uint32_t cells_inside;
  double tolerance;
  double overlap;
  double overshoot_weight;
  double max_protrusion;
  double max_radius;
  double smoothness;
  int32_t connected;
  int32_t equal_volume;
  int32_t symmetry;
  uint32_t symmetry_plane_count;
  const double *half_spaces;
  size_t half_space_count;
  const double *symmetry_planes;
} morula_clump_options;
typedef struct morula_overlap {
  size_t struct_size;
  double mismatch;
  double error_bound;
  double eta;
  double iou;
  double coverage;
  double overshoot;
  double target_volume;
  double union_volume;
  double volume_error;
  double centroid_error;
  double moment_errors[3];
} morula_overlap;
typedef struct morula_surface {
  size_t struct_size;
  double protrusion;
  double rms_distance;
  double hausdorff;
  double distance_bound;
  double roughness;
  uint64_t samples;
  uint32_t never_exposed;
  uint32_t reserved;
} morula_surface;
typedef struct morula_contact_options {
  size_t struct_size;
  double stiffness;
  double young;
  double poisson;
  double speed;
  uint32_t contacts;
  uint32_t reserved;
} morula_contact_options;
typedef struct morula_cost_options {
  size_t struct_size;
  const uint64_t *counts;
  size_t count;
  uint64_t most;
  double seconds;
  double density;
  const struct morula_contact_options *contact;
  double step[3];
  double lists[2];
  double rebuild;
  int32_t levels;
  int32_t surface;
  int32_t masses;
  uint32_t quality_columns;
} morula_cost_options;
typedef struct morula_cost_bounds {
  size_t struct_size;
  uint64_t spheres;
  double mismatch;
  double coverage;
  double surface;
  double seconds;
  double step_cost;
  double time_cost;
  int32_t goal;
  int32_t reserved;
} morula_cost_bounds;
typedef struct morula_cost_point {
  size_t struct_size;
  uint64_t asked;
  uint64_t spheres;
  double mismatch;
  double coverage;
  double overshoot;
  double surface;
  double hausdorff;
  double protrusion;
  double roughness;
  double union_inertia;
  double inertia;
  double seconds;
  double seconds_so_far;
  double time_step;
  double rayleigh;
  double step_factor;
  double least_radius;
  double step_cost;
  double time_cost;
  int32_t masses;
  int32_t stopped;
} morula_cost_point;
typedef struct morula_sweep_options {
  size_t struct_size;
  const double *resolutions;
  size_t resolution_count;
  const int32_t *methods;
  const int32_t *efforts;
  size_t method_count;
  const double *deadlines;
  size_t deadline_count;
} morula_sweep_options;
typedef struct morula_swept {
  size_t struct_size;
  double resolution;
  uint64_t cells[3];
  double solid_seconds;
  double deadline;
  uint64_t lines;
  int32_t method;
  int32_t effort;
  int32_t status;
  int32_t cut;
} morula_swept;
typedef struct morula_mass_options {
  size_t struct_size;
  double density;
  double m_min;
  double m_max;
  int32_t target;
  int32_t objective;
  int32_t infeasible;
  int32_t threads;
  morula_progress progress;
  void *user;
} morula_mass_options;
typedef struct morula_timestep {
  size_t struct_size;
  double clump;
  double effective_mass;
  double stiffness;
  double rayleigh;
  double overlap;
  uint32_t sphere;
  uint32_t reserved;
} morula_timestep;
typedef struct morula_masses {
  size_t struct_size;
  double mass;
  double m_min;
  double largest_m_min;
  double mass_residual;
  double centre_residual;
  double inertia_residual;
  double spread;
  double union_inertia_error;
  int32_t status;
  uint32_t binding;
} morula_masses;
typedef struct morula_export_options {
  size_t struct_size;
  double length;
  double mass;
  int32_t placed;
  uint32_t facets;
  const char *name;
  int32_t precision;
  int32_t reserved;
} morula_export_options;
typedef struct morula_held {
  size_t struct_size;
  double mass;
  double centre[3];
  double inertia[6];
  double scale;
  double position[3];
  double quaternion[4];
  double velocity[3];
  double angular_velocity[3];
} morula_held;
typedef struct morula_cache_counts {
  size_t struct_size;
  uint64_t hits;
  uint64_t misses;
  uint64_t evicted;
  uint64_t parents;
  uint64_t bytes;
} morula_cache_counts;
typedef struct morula_break_options {
  size_t struct_size;
  const double *half_spaces;
  size_t half_space_count;
  const double *points;
  const double *weights;
  size_t point_count;
  const double *walls;
  size_t wall_count;
  uint64_t cells;
  double point[3];
  double direction[3];
  uint64_t seed;
  double least_volume;
  uint64_t spheres;
  double min_radius;
  double gap;
  double m_min;
  double deadline_seconds;
  int32_t kind;
  int32_t within_union;
  int32_t precision;
  int32_t quality;
  int32_t masses;
  int32_t objective;
  int32_t infeasible;
  int32_t threads;
  morula_progress progress;
  void *user;
} morula_break_options;
typedef struct morula_fragment {
  size_t struct_size;
  double mass;
  double centre[3];
  double inertia[6];
  double principal[3];
  double rotation[9];
  double position[3];
  double quaternion[4];
  double velocity[3];
  double angular_velocity[3];
  double volume;
  double coverage;
  double volume_share;
  double step_factor;
  double inertia_residual;
  uint64_t sphere_count;
  uint64_t map_count;
  uint64_t half_space_count;
  uint64_t cell;
  int32_t stopped;
  int32_t masses;
} morula_fragment;
typedef struct morula_break_totals {
  size_t struct_size;
  double energy;
  double inertia_error;
  double shift[3];
} morula_break_totals;
#ifdef __cplusplus
extern "C" {
#endif // __cplusplus
uint32_t morula_version(void);
const char *morula_version_string(void);
const char *morula_status_name(int32_t status);
const char *morula_last_error_message(void);
size_t morula_sizeof(int32_t which);
int32_t morula_set_log(morula_log sink, void *user);
int32_t morula_import_options_init(struct morula_import_options *options,
                                   size_t size);
int32_t morula_shape_from_mesh(const double *vertices,
                               size_t vertex_count,
                               const uint32_t *triangles,
                               size_t triangle_count,
                               const struct morula_import_options *options,
                               struct morula_shape **shape);
void morula_shape_free(struct morula_shape *shape);
int32_t morula_shape_report(const struct morula_shape *shape, struct morula_report *report);
int32_t morula_shape_note_count(const struct morula_shape *shape, size_t *count);
int32_t morula_shape_copy_note(const struct morula_shape *shape,
                               size_t index,
                               size_t capacity,
                               char *text,
                               size_t *length);
int32_t morula_shape_moments(const struct morula_shape *shape,
                             double density,
                             struct morula_moments *moments);
int32_t morula_shape_counters(const struct morula_shape *shape,
                              struct morula_counters *counters);
int32_t morula_file_options_init(struct morula_file_options *options,
                                 size_t size);
int32_t morula_shape_from_file(const char *path,
                               const struct morula_import_options *import,
                               const struct morula_file_options *file,
                               struct morula_shape **shape);
int32_t morula_shape_from_bytes(const uint8_t *bytes,
                                size_t count,
                                const char *name,
                                const struct morula_import_options *import,
                                const struct morula_file_options *file,
                                struct morula_shape **shape);
int32_t morula_labels_from_file(const char *path,
                                const struct morula_import_options *import,
                                const struct morula_file_options *file,
                                size_t capacity,
                                uint32_t *ids,
                                uint64_t *cells,
                                uint64_t *boxes,
                                int32_t *touches_border,
                                size_t *count);
int32_t morula_labels_from_bytes(const uint8_t *bytes,
                                 size_t byte_count,
                                 const char *name,
                                 const struct morula_import_options *import,
                                 const struct morula_file_options *file,
                                 size_t capacity,
                                 uint32_t *ids,
                                 uint64_t *cells,
                                 uint64_t *boxes,
                                 int32_t *touches_border,
                                 size_t *count);
int32_t morula_shape_from_mask(const uint8_t *mask,
                               const size_t *dims,
                               const double *spacing,
                               const double *origin,
                               const struct morula_import_options *options,
                               struct morula_shape **shape);
int32_t morula_shape_from_grey_u8(const uint8_t *values,
                                  const size_t *dims,
                                  const double *spacing,
                                  const double *origin,
                                  const double *threshold,
                                  const struct morula_import_options *options,
                                  struct morula_shape **shape);
int32_t morula_shape_from_grey_u16(const uint16_t *values,
                                   const size_t *dims,
                                   const double *spacing,
                                   const double *origin,
                                   const double *threshold,
                                   const struct morula_import_options *options,
                                   struct morula_shape **shape);
int32_t morula_shape_from_grey_f32(const float *values,
                                   const size_t *dims,
                                   const double *spacing,
                                   const double *origin,
                                   const double *threshold,
                                   const struct morula_import_options *options,
                                   struct morula_shape **shape);
int32_t morula_shape_from_label(const uint32_t *labels,
                                const size_t *dims,
                                const double *spacing,
                                const double *origin,
                                uint32_t label,
                                const struct morula_import_options *options,
                                struct morula_shape **shape);
int32_t morula_labels_count(const uint32_t *labels, const size_t *dims, size_t *count);
int32_t morula_labels_copy(const uint32_t *labels,
                           const size_t *dims,
                           size_t capacity,
                           uint32_t *ids,
                           uint64_t *cells,
                           uint64_t *boxes,
                           int32_t *touches_border);
int32_t morula_shape_from_silhouettes(size_t count,
                                      const uint8_t *masks,
                                      const size_t *widths,
                                      const size_t *heights,
                                      const double *cameras,
                                      size_t cells,
                                      int32_t carve,
                                      const struct morula_import_options *options,
                                      struct morula_shape **shape);
const char *morula_primitive_name(size_t index);
int32_t morula_primitive_parameter_count(const char *name, size_t *count);
int32_t morula_primitive_copy_parameter(const char *name,
                                        size_t index,
                                        size_t capacity,
                                        char *key,
                                        size_t *length,
                                        double *value);
int32_t morula_shape_from_primitive(const char *name,
                                    const char *const *keys,
                                    const double *values,
                                    size_t count,
                                    uint32_t segments,
                                    uint64_t seed,
                                    const struct morula_import_options *options,
                                    struct morula_shape **shape);
int32_t morula_solid_options_init(struct morula_solid_options *options,
                                  size_t size);
int32_t morula_solid_from_shape(const struct morula_shape *shape,
                                const struct morula_solid_options *options,
                                struct morula_solid **solid);
void morula_solid_free(struct morula_solid *solid);
int32_t morula_solid_grid(const struct morula_solid *solid,
                          size_t *dims,
                          double *spacing,
                          double *origin);
int32_t morula_solid_distance(const struct morula_solid *solid,
                              size_t count,
                              const double *points,
                              double *distances);
int32_t morula_solid_note_count(const struct morula_solid *solid, size_t *count);
int32_t morula_solid_copy_note(const struct morula_solid *solid,
                               size_t index,
                               size_t capacity,
                               char *text,
                               size_t *length);
int32_t morula_solid_moments(const struct morula_solid *solid,
                             double density,
                             struct morula_moments *moments);
int32_t morula_solid_counters(const struct morula_solid *solid,
                              struct morula_counters *counters);
int32_t morula_clump_options_init(struct morula_clump_options *options,
                                  size_t size);
int32_t morula_clump_from_shape(const struct morula_shape *shape,
                                const struct morula_solid_options *solid_options,
                                const struct morula_clump_options *options,
                                struct morula_clump **clump);
int32_t morula_clump_from_solid(const struct morula_solid *solid,
                                const struct morula_clump_options *options,
                                struct morula_clump **clump);
void morula_clump_free(struct morula_clump *clump);
int32_t morula_clump_sphere_count(const struct morula_clump *clump, size_t *count);
int32_t morula_clump_copy_spheres(const struct morula_clump *clump,
                                  size_t capacity,
                                  double *xyzr);
int32_t morula_clump_stopped(const struct morula_clump *clump, int32_t *stopped);
const char *morula_stopped_name(int32_t stopped);
int32_t morula_clump_copy_note(const struct morula_clump *clump,
                               size_t capacity,
                               char *text,
                               size_t *length);
int32_t morula_clump_moments(const struct morula_clump *clump,
                             double density,
                             struct morula_moments *moments);
int32_t morula_clump_overlap(const struct morula_clump *clump, struct morula_overlap *overlap);
int32_t morula_clump_surface(const struct morula_clump *clump, struct morula_surface *surface);
int32_t morula_clump_copy_exposed_areas(const struct morula_clump *clump,
                                        size_t capacity,
                                        double *areas);
int32_t morula_clump_copy_plane_contacts(const struct morula_clump *clump,
                                         size_t capacity,
                                         uint32_t *counts);
int32_t morula_clump_counters(const struct morula_clump *clump,
                              struct morula_counters *counters);
int32_t morula_clumps_from_solid(const struct morula_solid *solid,
                                 const struct morula_clump_options *options,
                                 const uint64_t *spheres,
                                 size_t count,
                                 struct morula_clump **clumps);
int32_t morula_clumps_from_shapes(const struct morula_shape *const *shapes,
                                  size_t count,
                                  const struct morula_solid_options *solid_options,
                                  const struct morula_clump_options *options,
                                  struct morula_clump **clumps,
                                  int32_t *statuses);
int32_t morula_clumps_from_labels(const uint32_t *labels,
                                  const size_t *dims,
                                  const double *spacing,
                                  const double *origin,
                                  const uint32_t *wanted,
                                  size_t count,
                                  const struct morula_import_options *import_options,
                                  const struct morula_solid_options *solid_options,
                                  const struct morula_clump_options *options,
                                  struct morula_clump **clumps,
                                  int32_t *statuses);
int32_t morula_cost_options_init(struct morula_cost_options *options,
                                 size_t size);
int32_t morula_cost_bounds_init(struct morula_cost_bounds *bounds,
                                size_t size);
int32_t morula_cost_curve(const struct morula_solid *solid,
                          const struct morula_clump_options *options,
                          const struct morula_cost_options *cost,
                          struct morula_cost **curve);
int32_t morula_cost_count(const struct morula_cost *curve, size_t *count);
int32_t morula_cost_cut(const struct morula_cost *curve, int32_t *cut);
int32_t morula_cost_copy(const struct morula_cost *curve,
                         size_t capacity,
                         struct morula_cost_point *points);
int32_t morula_cost_clump(const struct morula_cost *curve,
                          size_t index,
                          struct morula_clump **clump);
int32_t morula_cost_choose(const struct morula_cost *curve,
                           const struct morula_cost_bounds *bounds,
                           size_t *index,
                           size_t capacity,
                           char *text,
                           size_t *length);
void morula_cost_free(struct morula_cost *curve);
int32_t morula_sweep_options_init(struct morula_sweep_options *options,
                                  size_t size);
int32_t morula_sweep_from_shape(const struct morula_shape *shape,
                                const struct morula_solid_options *solid_options,
                                const struct morula_clump_options *options,
                                const struct morula_cost_options *cost,
                                const struct morula_sweep_options *what,
                                struct morula_sweep **sweep);
int32_t morula_sweep_count(const struct morula_sweep *sweep, size_t *count);
int32_t morula_sweep_copy(const struct morula_sweep *sweep,
                          size_t capacity,
                          struct morula_swept *lists);
int32_t morula_sweep_curve(const struct morula_sweep *sweep,
                           size_t index,
                           struct morula_cost **curve);
void morula_sweep_free(struct morula_sweep *sweep);
int32_t morula_mass_options_init(struct morula_mass_options *options,
                                 size_t size);
int32_t morula_body_from_clump(const struct morula_clump *clump,
                               const struct morula_mass_options *options,
                               struct morula_body **body);
int32_t morula_body_from_spheres(const double *xyzr,
                                 size_t count,
                                 const struct morula_solid *solid,
                                 const struct morula_mass_options *options,
                                 struct morula_body **body);
int32_t morula_body_transform(const struct morula_body *body,
                              double scale,
                              const double *position,
                              const double *quaternion,
                              double density,
                              struct morula_body **placed);
int32_t morula_clump_transform(const struct morula_clump *clump,
                               const struct morula_mass_options *masses,
                               double scale,
                               const double *position,
                               const double *quaternion,
                               struct morula_body **placed);
int32_t morula_random_orientations(uint64_t seed,
                                   size_t count,
                                   double *quaternions);
void morula_body_free(struct morula_body *body);
int32_t morula_contact_options_init(struct morula_contact_options *options,
                                    size_t size);
int32_t morula_body_timestep(const struct morula_body *body,
                             const struct morula_contact_options *options,
                             struct morula_timestep *timestep);
int32_t morula_clump_timestep(const struct morula_clump *clump,
                              const struct morula_mass_options *masses,
                              const struct morula_contact_options *options,
                              struct morula_timestep *timestep);
int32_t morula_body_sphere_count(const struct morula_body *body, size_t *count);
int32_t morula_body_copy_spheres(const struct morula_body *body,
                                 int32_t frame,
                                 size_t capacity,
                                 double *xyzr);
int32_t morula_body_copy_spheres_f32(const struct morula_body *body,
                                     int32_t frame,
                                     size_t capacity,
                                     float *xyzr);
int32_t morula_body_copy_masses(const struct morula_body *body,
                                size_t capacity,
                                double *masses);
int32_t morula_body_copy_binding(const struct morula_body *body,
                                 size_t capacity,
                                 uint32_t *spheres);
int32_t morula_body_moments(const struct morula_body *body, struct morula_moments *moments);
int32_t morula_body_masses(const struct morula_body *body, struct morula_masses *masses);
const char *morula_masses_status_name(int32_t status);
int32_t morula_export_options_init(struct morula_export_options *options,
                                   size_t size);
int32_t morula_body_write(const struct morula_body *body,
                          int32_t format,
                          const struct morula_export_options *options,
                          const char *path);
int32_t morula_clump_write(const struct morula_clump *clump,
                           const struct morula_mass_options *masses,
                           int32_t format,
                           const struct morula_export_options *options,
                           const char *path);
int32_t morula_body_export(const struct morula_body *body,
                           int32_t format,
                           const struct morula_export_options *options,
                           struct morula_files **files);
int32_t morula_files_count(const struct morula_files *files, size_t *count);
int32_t morula_files_copy_name(const struct morula_files *files,
                               size_t index,
                               size_t capacity,
                               char *text,
                               size_t *length);
int32_t morula_files_size(const struct morula_files *files, size_t index, size_t *size);
int32_t morula_files_copy_bytes(const struct morula_files *files,
                                size_t index,
                                size_t capacity,
                                uint8_t *bytes);
void morula_files_free(struct morula_files *files);
int32_t morula_parent_from_solid(const struct morula_solid *solid,
                                 const double *xyzr,
                                 size_t count,
                                 int32_t threads,
                                 struct morula_parent **parent);
int32_t morula_parent_from_clump(const struct morula_solid *solid,
                                 const struct morula_clump *clump,
                                 int32_t threads,
                                 struct morula_parent **parent);
int32_t morula_parent_bytes(const struct morula_parent *parent, uint64_t *bytes);
void morula_parent_free(struct morula_parent *parent);
int32_t morula_held_init(struct morula_held *held,
                         size_t size);
int32_t morula_parent_held(const struct morula_parent *parent,
                           double density,
                           double scale,
                           const double *position,
                           const double *quaternion,
                           const double *velocity,
                           const double *angular_velocity,
                           struct morula_held *held);
int32_t morula_cache_new(uint64_t limit,
                         struct morula_cache **cache);
int32_t morula_cache_parent(const struct morula_cache *cache,
                            const struct morula_shape *shape,
                            const struct morula_solid_options *options,
                            const double *xyzr,
                            size_t count,
                            struct morula_parent **parent);
int32_t morula_cache_counters(const struct morula_cache *cache,
                              struct morula_cache_counts *counters);
int32_t morula_cache_clear(const struct morula_cache *cache);
void morula_cache_free(struct morula_cache *cache);
int32_t morula_fragments_held(const struct morula_fragments *fragments,
                              size_t index,
                              const double *position,
                              const double *quaternion,
                              const double *velocity,
                              const double *angular_velocity,
                              struct morula_held *held);
int32_t morula_break_options_init(struct morula_break_options *options,
                                  size_t size);
int32_t morula_parent_break(const struct morula_parent *parent,
                            const struct morula_fragments *from,
                            size_t index,
                            const struct morula_held *held,
                            const struct morula_break_options *options,
                            struct morula_fragments **fragments);
int32_t morula_parents_break(const struct morula_parent *const *parents,
                             const struct morula_fragments *const *from,
                             const size_t *indices,
                             const struct morula_held *held,
                             const struct morula_break_options *options,
                             size_t count,
                             struct morula_fragments **fragments,
                             int32_t *statuses);
void morula_fragments_free(struct morula_fragments *fragments);
int32_t morula_fragments_from_labels(const uint32_t *labels,
                                     const size_t *dims,
                                     const double *spacing,
                                     const double *origin,
                                     const struct morula_solid_options *solid_options,
                                     const double *xyzr,
                                     size_t count,
                                     const struct morula_held *held,
                                     const struct morula_break_options *options,
                                     struct morula_fragments **fragments);
int32_t morula_reclump_shape(const struct morula_solid *solid,
                             const double *xyzr,
                             size_t count,
                             const struct morula_held *held,
                             const struct morula_break_options *options,
                             struct morula_fragments **fragments);
int32_t morula_fragments_count(const struct morula_fragments *fragments, size_t *count);
int32_t morula_fragments_dust_count(const struct morula_fragments *fragments, size_t *count);
int32_t morula_fragments_get(const struct morula_fragments *fragments,
                             size_t index,
                             struct morula_fragment *fragment);
int32_t morula_fragments_dust(const struct morula_fragments *fragments,
                              size_t index,
                              struct morula_fragment *dust);
int32_t morula_fragments_totals(const struct morula_fragments *fragments,
                                struct morula_break_totals *totals);
int32_t morula_fragments_copy_spheres(const struct morula_fragments *fragments,
                                      size_t index,
                                      int32_t frame,
                                      size_t capacity,
                                      double *xyzr);
int32_t morula_fragments_copy_masses(const struct morula_fragments *fragments,
                                     size_t index,
                                     size_t capacity,
                                     double *masses);
int32_t morula_fragments_copy_map(const struct morula_fragments *fragments,
                                  size_t index,
                                  uint32_t *starts,
                                  size_t capacity,
                                  uint32_t *parents,
                                  double *shares);
int32_t morula_fragments_copy_half_spaces(const struct morula_fragments *fragments,
                                          size_t index,
                                          size_t capacity,
                                          double *half_spaces);
int32_t morula_fragments_shape(const struct morula_fragments *fragments,
                               size_t index,
                               struct morula_shape **shape);
int32_t morula_fragments_grow(const struct morula_fragments *fragments,
                              size_t index,
                              double part,
                              const double *others,
                              size_t other_count,
                              double gap,
                              int32_t frame,
                              size_t capacity,
                              double *xyzr);
int32_t morula_fragments_note_count(const struct morula_fragments *fragments, size_t *count);
int32_t morula_fragments_copy_note(const struct morula_fragments *fragments,
                                   size_t index,
                                   size_t capacity,
                                   char *text,
                                   size_t *length);
int32_t morula_shape_serialize(const struct morula_shape *shape,
                               size_t capacity,
                               uint8_t *bytes,
                               size_t *size);
int32_t morula_shape_deserialize(const uint8_t *bytes,
                                 size_t size,
                                 struct morula_shape **shape);
int32_t morula_clump_serialize(const struct morula_clump *clump,
                               size_t capacity,
                               uint8_t *bytes,
                               size_t *size);
int32_t morula_clump_deserialize(const uint8_t *bytes,
                                 size_t size,
                                 struct morula_clump **clump);
int32_t morula_fragments_serialize(const struct morula_fragments *fragments,
                                   size_t index,
                                   size_t capacity,
                                   uint8_t *bytes,
                                   size_t *size);
int32_t morula_fragments_deserialize(const struct morula_parent *parent,
                                     const uint8_t *bytes,
                                     size_t size,
                                     const struct morula_held *held,
                                     struct morula_fragments **fragments);
#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus
#endif  /* MORULA_H */
