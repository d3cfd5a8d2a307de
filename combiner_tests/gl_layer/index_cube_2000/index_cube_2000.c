/* Index cube shadow mapping as in a program of the year 2000: GLUT, immediate mode, and the register combiners that the
 * article sets up. Written without ninebit. It needs GL_NV_register_combiners and GL_ARB_texture_cube_map; if one is
 * missing, it prints its name and exits with 2.
 *
 *   index_cube_2000 SCENE.txt [--size WxH] [--map-size N] [--step N] [--frames N] [--output PREFIX] [--glsl FILE]
 *
 * With --output it writes these files after the last frame, the first row on top:
 *   PREFIX_color.ppm    the picture
 *   PREFIX_shadow.pgm   the stencil buffer, 255 in shadow
 *   PREFIX_primary.ppm  the polygon's own index at each pixel, drawn by fixed function
 *   PREFIX_texel.ppm    the index that the cube map holds for each pixel, drawn by fixed function
 * --glsl FILE compares with a fragment shader from the file instead, which needs no combiners.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glut.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "extensions.h"
#include "scene.h"

static Scene scene;
static int width = 640, height = 480, map_size = 256, step = 2, frames = 1, frame;
static const char *output, *glsl_file;
static GLuint cube_map;
static int begin;

/* The article's calls. */
static void set_up_combiners(void) {
#include "compare.gl"
}

/* Counts by `step` in red, then green, then blue. Number 0 is the cleared map. */
static void index_color(int number) {
  int base = 255 / step + 1;
  glColor3ub((GLubyte)(number % base * step), (GLubyte)(number / base % base * step),
             (GLubyte)(number / base / base * step));
}

static void draw_indices(void) {
  int i, corner;
  glBegin(GL_TRIANGLES);
  for (i = 0; i < scene.triangle_count; ++i) {
    index_color(i + 1);
    for (corner = 0; corner < 3; ++corner) glVertex3fv(scene.vertices[scene.triangles[i][corner]].position);
  }
  glEnd();
}

static void draw_lit(int in_shadow) {
  int i, corner;
  glBegin(GL_TRIANGLES);
  for (i = 0; i < scene.triangle_count; ++i) {
    for (corner = 0; corner < 3; ++corner) {
      const Vertex* v = &scene.vertices[scene.triangles[i][corner]];
      glColor3fv(in_shadow ? v->shadowed : v->lit);
      glVertex3fv(v->position);
    }
  }
  glEnd();
}

/* The light's six views with the indices as colours. The window must be at least as large as a face. */
static void make_cube_map(void) {
  static const GLdouble looks[6][6] = {{1, 0, 0, 0, -1, 0},  {-1, 0, 0, 0, -1, 0}, {0, 1, 0, 0, 0, 1},
                                       {0, -1, 0, 0, 0, -1}, {0, 0, 1, 0, -1, 0},  {0, 0, -1, 0, -1, 0}};
  const float* l = scene.light;
  int face;
  glShadeModel(GL_FLAT);
  glDisable(GL_STENCIL_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glViewport(0, 0, map_size, map_size);
  glBindTexture(GL_TEXTURE_CUBE_MAP_ARB, cube_map);
  for (face = 0; face < 6; ++face) {
    const GLdouble* d = looks[face];
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluPerspective(90.0, 1.0, scene.light_near, scene.light_far);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    gluLookAt(l[0], l[1], l[2], l[0] + d[0], l[1] + d[1], l[2] + d[2], d[3], d[4], d[5]);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_indices();
    glCopyTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X_ARB + face, 0, 0, 0, 0, 0, map_size, map_size);
  }
}

static void look_from_camera(void) {
  glViewport(0, 0, width, height);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  gluPerspective(scene.fov, (GLdouble)width / height, scene.camera_near, scene.camera_far);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  gluLookAt(scene.eye[0], scene.eye[1], scene.eye[2], scene.look_at[0], scene.look_at[1], scene.look_at[2], 0, 1, 0);
}

/* Texture coordinates are positions relative to the light: the position by texgen, the rest by the texture matrix. */
static void enable_cube_map(int on) {
  static const GLfloat planes[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  static const GLenum coordinates[3] = {GL_S, GL_T, GL_R},
                      gens[3] = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R};
  int i;
  for (i = 0; i < 3; ++i) {
    glTexGeni(coordinates[i], GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    glTexGenfv(coordinates[i], GL_OBJECT_PLANE, planes[i]);
    on ? glEnable(gens[i]) : glDisable(gens[i]);
  }
  glMatrixMode(GL_TEXTURE);
  glLoadIdentity();
  if (on) glTranslatef(-scene.light[0], -scene.light[1], -scene.light[2]);
  glMatrixMode(GL_MODELVIEW);
  on ? glEnable(GL_TEXTURE_CUBE_MAP_ARB) : glDisable(GL_TEXTURE_CUBE_MAP_ARB);
}

static void draw_shadows(void) {
  glClearColor(0.05f, 0.06f, 0.08f, 1);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);

  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_indices(); /* depth alone */

  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, ~0u);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glEnable(GL_ALPHA_TEST);
  glAlphaFunc(GL_GREATER, 0);
  enable_cube_map(1);
  if (glsl_program) {
    p_glUseProgram(glsl_program);
  } else {
    set_up_combiners();
  }
  draw_indices();
  if (glsl_program) {
    p_glUseProgram(0);
  } else {
    glDisable(GL_REGISTER_COMBINERS_NV);
  }
  enable_cube_map(0);
  glDisable(GL_ALPHA_TEST);
}

static void draw_light(void) {
  glShadeModel(GL_SMOOTH);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  glStencilFunc(GL_EQUAL, 0, ~0u);
  draw_lit(0);
  glStencilFunc(GL_NOTEQUAL, 0, ~0u);
  draw_lit(1);
  glDisable(GL_STENCIL_TEST);
}

/* Writes the picture in the window to a file, the first row on top. */
static void write_picture(const char* name, GLenum format, int channels, int scale) {
  char path[1024];
  size_t row = (size_t)width * channels, i, size = row * height;
  GLubyte* pixels = malloc(size);
  FILE* file;
  int y;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, format, GL_UNSIGNED_BYTE, pixels);
  for (i = 0; scale != 1 && i < size; ++i) pixels[i] = (GLubyte)(pixels[i] * scale);
  snprintf(path, sizeof path, "%s_%s", output, name);
  file = fopen(path, "wb");
  if (!file) quit("an output file cannot be written");
  fprintf(file, "P%d\n%d %d\n255\n", channels == 3 ? 6 : 5, width, height);
  for (y = height - 1; y >= 0; --y) fwrite(pixels + row * y, 1, row, file);
  if (fclose(file) != 0) quit("an output file cannot be written");
  free(pixels);
}

/* The two inputs of the comparison at each pixel, without any combiner. */
static void write_inputs(void) {
  glShadeModel(GL_FLAT);
  glDepthFunc(GL_EQUAL);
  draw_indices();
  write_picture("primary.ppm", GL_RGB, 3, 1);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  enable_cube_map(1);
  draw_indices();
  enable_cube_map(0);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
  write_picture("texel.ppm", GL_RGB, 3, 1);
}

static void display(void) {
  GLenum error;
  if (frame == frames) return;
  if (frame == 1) begin = glutGet(GLUT_ELAPSED_TIME); /* the first frame makes programs and warms up */
  make_cube_map();
  look_from_camera();
  draw_shadows();
  draw_light();
  if (++frame < frames) {
    glutSwapBuffers();
    return;
  }
  glFinish();
  if (frames > 1) printf("%.3f ms a frame\n", (double)(glutGet(GLUT_ELAPSED_TIME) - begin) / (frames - 1));
  error = glGetError();
  if (error != GL_NO_ERROR) printf("GL error 0x%04x\n", error);
  if (output) {
    write_picture("color.ppm", GL_RGB, 3, 1);
    write_picture("shadow.pgm", GL_STENCIL_INDEX, 1, 255);
    write_inputs();
  }
  exit(error == GL_NO_ERROR ? 0 : 3);
}

static void make_textures(void) {
  int face;
  glGenTextures(1, &cube_map);
  glBindTexture(GL_TEXTURE_CUBE_MAP_ARB, cube_map);
  for (face = 0; face < 6; ++face) {
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X_ARB + face, 0, GL_RGB8, map_size, map_size, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 NULL);
  }
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARB, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARB, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARB, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARB, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

int main(int argc, char** argv) {
  int i;
  glutInit(&argc, argv);
  if (argc < 2) quit("expected a scene file");
  for (i = 2; i + 1 < argc; i += 2) {
    if (!strcmp(argv[i], "--size")) sscanf(argv[i + 1], "%dx%d", &width, &height);
    if (!strcmp(argv[i], "--map-size")) map_size = atoi(argv[i + 1]);
    if (!strcmp(argv[i], "--step")) step = atoi(argv[i + 1]);
    if (!strcmp(argv[i], "--frames")) frames = atoi(argv[i + 1]);
    if (!strcmp(argv[i], "--output")) output = argv[i + 1];
    if (!strcmp(argv[i], "--glsl")) glsl_file = argv[i + 1];
  }
  if (step < 1 || step > 16 || map_size > width || map_size > height) quit("an argument is out of range");
  if (!read_scene(argv[1], &scene)) quit("the scene cannot be read");
  glutInitDisplayMode(GLUT_RGB | GLUT_DOUBLE | GLUT_DEPTH | GLUT_STENCIL);
  glutInitWindowSize(width, height);
  glutCreateWindow("Index Cube Shadow Mapping");
  load_extensions(glsl_file);
  glDisable(GL_DITHER);
  make_textures();
  if (glsl_file) load_shader(glsl_file);
  glutDisplayFunc(display);
  glutIdleFunc(glutPostRedisplay);
  glutMainLoop();
  return 0;
}
