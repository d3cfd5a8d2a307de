/* Draws in all the ways of OpenGL 1.x, each twice: by fixed function, and with register combiners that subtract every
 * component from one. The second picture must be the negative of the first, with its alpha kept. The driver
 * interpolates the same values for both, and 255 - x is exact; but a smooth colour close to the middle of two bytes may
 * become one or the other. Combiners in their default state must draw what fixed function draws with fog and a separate
 * highlight, within 2, as they round in between. A freeglut program, written without ninebit.
 *
 *   old_ways [WAY]     all ways, or one by its name
 *
 * Prints a line a way: its name, the pixels that are drawn, those that are off by no more than that, those that are
 * wrong, and GL's error. Exit status 2: GL_NV_register_combiners is missing.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glut.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 128 };

#define FUNCTIONS(F)                                       \
  F(glCombinerParameteriNV, PFNGLCOMBINERPARAMETERINVPROC) \
  F(glCombinerInputNV, PFNGLCOMBINERINPUTNVPROC)           \
  F(glCombinerOutputNV, PFNGLCOMBINEROUTPUTNVPROC)         \
  F(glFinalCombinerInputNV, PFNGLFINALCOMBINERINPUTNVPROC) \
  F(glBindBufferARB, PFNGLBINDBUFFERARBPROC)               \
  F(glBufferDataARB, PFNGLBUFFERDATAARBPROC)               \
  F(glDrawRangeElementsEXT, PFNGLDRAWRANGEELEMENTSEXTPROC) \
  F(glMultiDrawArraysEXT, PFNGLMULTIDRAWARRAYSEXTPROC)     \
  F(glMultiDrawElementsEXT, PFNGLMULTIDRAWELEMENTSEXTPROC)

void (*glXGetProcAddressARB(const GLubyte* name))(void);

#define DECLARE(name, type) static type p_##name;
FUNCTIONS(DECLARE)
#define glCombinerParameteriNV p_glCombinerParameteriNV
#define glCombinerInputNV p_glCombinerInputNV
#define glCombinerOutputNV p_glCombinerOutputNV
#define glFinalCombinerInputNV p_glFinalCombinerInputNV

#include "texture_ways.h"

/* The combiners subtract the primary colour or texture 0 from one, or keep their default state. */
typedef enum { PRIMARY, TEXTURE, SAME } Kind;

typedef struct {
  const char* name;
  Kind kind;
  void (*draw)(void);
} Way;

static const Way ways[] = {{"immediate", PRIMARY, immediate},
                           {"flat", PRIMARY, flat},
                           {"triangles", PRIMARY, triangles},
                           {"wire", PRIMARY, wire},
                           {"dots", PRIMARY, dots},
                           {"thick lines", PRIMARY, thick_lines},
                           {"stippled lines", PRIMARY, stippled},
                           {"points", PRIMARY, points},
                           {"strips", PRIMARY, strips},
                           {"polygons", PRIMARY, polygons},
                           {"rectangles", PRIMARY, rectangles},
                           {"array elements", PRIMARY, array_elements},
                           {"arrays", PRIMARY, draw_arrays},
                           {"elements", PRIMARY, elements},
                           {"range elements", PRIMARY, range_elements},
                           {"multi arrays", PRIMARY, multi_arrays},
                           {"multi elements", PRIMARY, multi_elements},
                           {"interleaved", PRIMARY, interleaved_arrays},
                           {"buffers", PRIMARY, buffers},
                           {"lists", PRIMARY, lists},
                           {"evaluators", PRIMARY, evaluators},
                           {"teapot", PRIMARY, teapot},
                           {"quadric", PRIMARY, quadric},
                           {"two-sided", PRIMARY, two_sided},
                           {"bitmaps", PRIMARY, bitmaps},
                           {"pixels", PRIMARY, draw_pixels},
                           {"texture 1D", TEXTURE, texture_1d},
                           {"texture 2D", TEXTURE, texture_2d},
                           {"texture rectangle", TEXTURE, texture_rectangle},
                           {"sphere map", TEXTURE, sphere_map},
                           {"copied texture", TEXTURE, copied},
                           {"highlight", SAME, highlight},
                           {"fog", SAME, fog},
                           {NULL, SAME, NULL}};

static void load(void) {
  if (!strstr((const char*)glGetString(GL_EXTENSIONS), "GL_NV_register_combiners")) {
    printf("GL_NV_register_combiners is missing\n");
    exit(2);
  }
#define LOAD(name, type) p_##name = (type)glXGetProcAddressARB((const GLubyte*)#name);
  FUNCTIONS(LOAD)
}

/* out = 1 - source, alpha as it is. */
static void set_up_negative(GLenum source) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, source, GL_UNSIGNED_INVERT_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, source, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
  glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
}

typedef GLubyte Picture[SIZE][SIZE][4];

/* Alpha 0 marks what is not drawn. The state of a way ends with it. */
static void take(const Way* way, int combiners, Picture picture) {
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (combiners) {
    if (way->kind != SAME) set_up_negative(way->kind == TEXTURE ? GL_TEXTURE0_ARB : GL_PRIMARY_COLOR_NV);
    glEnable(GL_REGISTER_COMBINERS_NV);
  }
  way->draw();
  glPopClientAttrib();
  glPopAttrib();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, picture);
}

static void compare(const Way* way) {
  static Picture plain, combined;
  int x, y, i, drawn = 0, close = 0, wrong = 0;
  const int tolerance = way->kind == SAME ? 2 : 1;
  take(way, 0, plain);
  take(way, 1, combined);
  for (y = 0; y < SIZE; ++y) {
    for (x = 0; x < SIZE; ++x) {
      const GLubyte *a = plain[y][x], *b = combined[y][x];
      int most = abs(a[3] - b[3]);
      for (i = 0; i < 3; ++i) {
        int off = abs((a[3] && way->kind != SAME ? 255 - a[i] : a[i]) - b[i]);
        if (off > most) most = off;
      }
      drawn += a[3] != 0;
      close += most > 0 && most <= tolerance;
      wrong += most > tolerance;
    }
  }
  printf("%s: drawn %d, close %d, wrong %d, error 0x%04x\n", way->name, drawn, close, wrong, glGetError());
}

int main(int argc, char** argv) {
  const Way* way;
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_RGBA | GLUT_ALPHA | GLUT_DOUBLE | GLUT_DEPTH);
  glutInitWindowSize(SIZE, SIZE);
  glutCreateWindow("old ways");
  load();
  glViewport(0, 0, SIZE, SIZE);
  glDisable(GL_DITHER);
  glClearColor(0, 0, 0, 0);
  make_grid();
  make_texels();
  for (way = ways; way->name; ++way) {
    if (argc < 2 || !strcmp(argv[1], way->name)) compare(way);
  }
  return 0;
}
