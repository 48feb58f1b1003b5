/* Every layout of the header, on a body without symmetry: order of the
 * inertia, sign of its products, rotation by columns, quaternion, body frame. */
#include "check.h"

/* v = R w with R stored by columns. */
static void rotate(const double r[9], const double w[3], double v[3]) {
  for (int i = 0; i < 3; i++) v[i] = r[i] * w[0] + r[3 + i] * w[1] + r[6 + i] * w[2];
}

static void quaternion_rotate(const double q[4], const double w[3], double v[3]) {
  const double s = q[0], x = q[1], y = q[2], z = q[3];
  v[0] = (1 - 2 * (y * y + z * z)) * w[0] + 2 * (x * y - s * z) * w[1] + 2 * (x * z + s * y) * w[2];
  v[1] = 2 * (x * y + s * z) * w[0] + (1 - 2 * (x * x + z * z)) * w[1] + 2 * (y * z - s * x) * w[2];
  v[2] = 2 * (x * z - s * y) * w[0] + 2 * (y * z + s * x) * w[1] + (1 - 2 * (x * x + y * y)) * w[2];
}

static void moments_are_those_by_hand(const morula_moments *m) {
  double inertia[6];
  l_inertia(inertia);
  NEAR(m->volume, 4, 1e-12);
  NEAR(m->mass, L_MASS, 1e-12);
  for (int i = 0; i < 3; i++) NEAR(m->centre[i], L_CENTRE[i], 1e-12);
  for (int i = 0; i < 6; i++) NEAR(m->inertia[i], inertia[i], 1e-10);
  CHECK(inertia[3] > 0.1); /* -integral of x y dm, and the L leans to the other side */
  CHECK(m->principal[0] < m->principal[1] && m->principal[1] < m->principal[2]);

  /* I = sum of p_j e_j e_j^T with e_j column j of the rotation. */
  static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (int i = 0; i < 6; i++) {
    double sum = 0;
    for (int j = 0; j < 3; j++)
      sum += m->principal[j] * m->rotation[3 * j + at[i][0]] * m->rotation[3 * j + at[i][1]];
    NEAR(sum, m->inertia[i], 1e-10);
  }
  /* Right-handed; the third axis, about which it is hardest to turn, is z or -z. */
  const double *r = m->rotation;
  NEAR(r[6], r[1] * r[5] - r[2] * r[4], 1e-12);
  NEAR(r[7], r[2] * r[3] - r[0] * r[5], 1e-12);
  NEAR(r[8], r[0] * r[4] - r[1] * r[3], 1e-12);
  NEAR(fabs(r[8]), 1, 1e-12);

  const double w[3] = {0.3, -1.2, 2.5};
  double a[3], b[3];
  rotate(m->rotation, w, a);
  quaternion_rotate(m->quaternion, w, b);
  for (int i = 0; i < 3; i++) NEAR(a[i], b[i], 1e-12);
  CHECK(m->quaternion[0] >= 0);
}

int main(void) {
  morula_shape *shape = l_shape(), *again = NULL;
  morula_solid *solid = NULL;
  morula_clump *clump = NULL, *in_body = NULL;
  morula_moments m = {0};
  m.struct_size = sizeof m;
  OK(morula_shape_moments(shape, 2, &m));
  moments_are_those_by_hand(&m);
  OK(morula_solid_from_shape(shape, NULL, &solid));
  OK(morula_solid_moments(solid, 2, &m));
  moments_are_those_by_hand(&m);

  /* Points x, y, z, one after the other; negative inside. */
  const double points[9] = {12.5, 20.5, 30.5, 10.5, 21.75, 30.5, 12.5, 21.75, 30.5};
  double distances[3];
  OK(morula_solid_distance(solid, 3, points, distances));
  NEAR(distances[0], -0.5, 1e-12);
  NEAR(distances[1], -0.25, 1e-12);
  NEAR(distances[2], 0.75, 1e-12);

  /* The grid holds the body, in the caller's frame. */
  size_t dims[3];
  double spacing[3], origin[3];
  OK(morula_solid_grid(solid, dims, spacing, origin));
  for (int i = 0; i < 3; i++) {
    CHECK(origin[i] < 10 * (i + 1));
    CHECK(origin[i] + (double)dims[i] * spacing[i] > 10 * (i + 1) + (i == 0 ? 3 : i == 1 ? 2 : 1));
  }

  /* The same body as voxels with x fastest, and with 1-based triangles. */
  const uint8_t mask[6] = {1, 1, 1, 1, 0, 0};
  const size_t cells[3] = {3, 2, 1};
  const double lower[3] = {10, 20, 30};
  OK(morula_shape_from_mask(mask, cells, NULL, lower, NULL, &again));
  OK(morula_shape_moments(again, 2, &m));
  moments_are_those_by_hand(&m);
  morula_shape_free(again);
  again = NULL;
  double vertices[36];
  uint32_t triangles[60];
  morula_import_options import;
  OK(morula_import_options_init(&import, sizeof import));
  import.index_base = 1;
  l_mesh(vertices, triangles, 1);
  OK(morula_shape_from_mesh(vertices, 12, triangles, 20, &import, &again));
  OK(morula_shape_moments(again, 2, &m));
  moments_are_those_by_hand(&m);

  /* Spheres x, y, z, r; the body frame is R^T (p - centre). */
  morula_clump_options options;
  OK(morula_clump_options_init(&options, sizeof options));
  options.spheres = 12;
  OK(morula_clump_from_solid(solid, &options, &clump));
  options.frame = MORULA_FRAME_BODY;
  OK(morula_clump_from_solid(solid, &options, &in_body));
  size_t n = 0, k = 0;
  double input[12][4], body[12][4];
  OK(morula_clump_sphere_count(clump, &n));
  OK(morula_clump_sphere_count(in_body, &k));
  CHECK(n > 0 && n == k && n <= 12);
  OK(morula_clump_copy_spheres(clump, 12, input[0]));
  OK(morula_clump_copy_spheres(in_body, 12, body[0]));
  OK(morula_clump_moments(in_body, 2, &m));
  moments_are_those_by_hand(&m);
  for (size_t i = 0; i < n && i < 12; i++) {
    double p[3];
    rotate(m.rotation, body[i], p);
    for (int a = 0; a < 3; a++) NEAR(p[a] + m.centre[a], input[i][a], 1e-12);
    CHECK(input[i][3] > 0 && input[i][3] < 1 && input[i][3] == body[i][3]);
    CHECK(input[i][0] > 10 && input[i][0] < 13 && input[i][1] > 20 && input[i][1] < 22);
    CHECK(input[i][2] > 30 && input[i][2] < 31);
  }
  morula_clump_free(clump);
  morula_clump_free(in_body);
  morula_solid_free(solid);
  morula_shape_free(shape);
  morula_shape_free(again);
  return checks_done();
}
