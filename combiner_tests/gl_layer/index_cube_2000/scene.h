/* A scene as lines of text, in this order:
 *   camera EYE_X EYE_Y EYE_Z AT_X AT_Y AT_Z VERTICAL_FOV NEAR FAR
 *   light X Y Z NEAR FAR
 *   vertices COUNT, then a line each: X Y Z, its colour in light R G B, its colour in shadow R G B
 *   triangles COUNT, then a line each: three numbers of vertices, from 0
 */
#include <stdio.h>
#include <stdlib.h>

typedef struct {
  float position[3], lit[3], shadowed[3];
} Vertex;

typedef struct {
  double fov, camera_near, camera_far, light_near, light_far;
  double eye[3], look_at[3];
  float light[3];
  int vertex_count, triangle_count;
  Vertex* vertices;
  int (*triangles)[3];
} Scene;

/* Returns 0 where the file is not as described. */
static int read_scene(const char* path, Scene* s) {
  FILE* file = fopen(path, "r");
  int i, c, good;
  if (!file) return 0;
  good = fscanf(file, " camera %lf %lf %lf %lf %lf %lf %lf %lf %lf", &s->eye[0], &s->eye[1], &s->eye[2], &s->look_at[0],
                &s->look_at[1], &s->look_at[2], &s->fov, &s->camera_near, &s->camera_far) == 9 &&
         fscanf(file, " light %f %f %f %lf %lf", &s->light[0], &s->light[1], &s->light[2], &s->light_near,
                &s->light_far) == 5 &&
         fscanf(file, " vertices %d", &s->vertex_count) == 1 && s->vertex_count > 0;
  if (good) s->vertices = calloc((size_t)s->vertex_count, sizeof *s->vertices);
  for (i = 0; good && i < s->vertex_count; ++i) {
    Vertex* v = &s->vertices[i];
    good = fscanf(file, "%f %f %f %f %f %f %f %f %f", &v->position[0], &v->position[1], &v->position[2], &v->lit[0],
                  &v->lit[1], &v->lit[2], &v->shadowed[0], &v->shadowed[1], &v->shadowed[2]) == 9;
  }
  good = good && fscanf(file, " triangles %d", &s->triangle_count) == 1 && s->triangle_count > 0;
  if (good) s->triangles = calloc((size_t)s->triangle_count, sizeof *s->triangles);
  for (i = 0; good && i < s->triangle_count; ++i) {
    for (c = 0; good && c < 3; ++c) {
      good = fscanf(file, "%d", &s->triangles[i][c]) == 1 && s->triangles[i][c] >= 0 &&
             s->triangles[i][c] < s->vertex_count;
    }
  }
  fclose(file);
  return good;
}
