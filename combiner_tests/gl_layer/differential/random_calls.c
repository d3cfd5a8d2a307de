/* Random calls of OpenGL without combiners: random_calls SEED. Prints errors, values that can be read back and hashes
 * of pictures. With the layer and without it, the output must be the same. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "../egl_context.h"

enum { SIDE = 24, CALLS = 240, TEXTURES = 4, LISTS = 6 };
#define COUNT(a) (sizeof(a) / sizeof *(a))
#define ANY(a) ((a)[below(COUNT(a))])

static uint64_t state;

static unsigned below(unsigned end) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (unsigned)(state >> 33) % end;
}

static float fraction(void) {
  return (float)below(1025) / 1024;
}
static float position(void) {
  return 2 * fraction() - 1;
}

/* One in sixteen is of another list than the right one; none is of an extension that the layer adds. */
static GLenum mostly(GLenum right) {
  static const GLenum others[] = {1,      GL_TEXTURE_2D, GL_FLOAT, GL_LIGHT0,      0x1235,
                                  0xFFFF, GL_RGBA,       GL_CLAMP, GL_VERTEX_ARRAY};
  return below(16) ? right : ANY(others);
}

/* The list that is being compiled; 0: none. */
static GLuint open_list(void) {
  GLint open = 0;
  glGetIntegerv(GL_LIST_INDEX, &open);
  return (GLuint)open;
}

static const GLenum caps[] = {
    GL_TEXTURE_1D, GL_TEXTURE_2D,   GL_TEXTURE_CUBE_MAP, GL_TEXTURE_3D,    GL_LIGHTING,       GL_LIGHT0,
    GL_FOG,        GL_BLEND,        GL_ALPHA_TEST,       GL_DEPTH_TEST,    GL_CULL_FACE,      GL_COLOR_SUM,
    GL_NORMALIZE,  GL_SCISSOR_TEST, GL_STENCIL_TEST,     GL_TEXTURE_GEN_S, GL_COLOR_MATERIAL, GL_COLOR_LOGIC_OP,
    GL_DITHER};
static const GLenum values_read[] = {GL_CURRENT_COLOR,
                                     GL_CURRENT_NORMAL,
                                     GL_CURRENT_TEXTURE_COORDS,
                                     GL_FOG_MODE,
                                     GL_FOG_COLOR,
                                     GL_TEXTURE_BINDING_2D,
                                     GL_ACTIVE_TEXTURE,
                                     GL_MATRIX_MODE,
                                     GL_MODELVIEW_MATRIX,
                                     GL_LIST_INDEX,
                                     GL_LIST_BASE,
                                     GL_LIST_MODE,
                                     GL_ATTRIB_STACK_DEPTH,
                                     GL_CLIENT_ATTRIB_STACK_DEPTH,
                                     GL_BLEND_SRC,
                                     GL_CURRENT_PROGRAM,
                                     GL_VERTEX_ARRAY_SIZE,
                                     GL_LIGHT_MODEL_COLOR_CONTROL,
                                     GL_UNPACK_ALIGNMENT,
                                     GL_RED_SCALE,
                                     GL_CURRENT_SECONDARY_COLOR,
                                     GL_ALPHA_TEST_FUNC,
                                     GL_MAX_TEXTURE_UNITS,
                                     0x1234};
static const GLenum modes[] = {GL_POINTS, GL_LINES,   GL_TRIANGLES,   GL_TRIANGLE_STRIP,
                               GL_QUADS,  GL_POLYGON, GL_TRIANGLE_FAN};
static float vertices[32][2], colors[32][4];
static GLuint program;

static void set_state(void) {
  static const GLenum factors[] = {GL_ZERO, GL_ONE, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_DST_COLOR, GL_SRC_COLOR};
  static const GLenum functions[] = {GL_ALWAYS, GL_LESS, GL_GEQUAL, GL_NOTEQUAL, GL_NEVER};
  static const GLenum environments[] = {GL_MODULATE, GL_REPLACE, GL_ADD, GL_DECAL, GL_BLEND, GL_COMBINE};
  static const GLenum fogs[] = {GL_LINEAR, GL_EXP, GL_EXP2};
  static const GLbitfield groups[] = {GL_ALL_ATTRIB_BITS, GL_ENABLE_BIT, GL_TEXTURE_BIT,
                                      GL_CURRENT_BIT,     GL_FOG_BIT,    GL_PIXEL_MODE_BIT};
  const float four[4] = {fraction(), fraction(), fraction(), fraction()};
  switch (below(22)) {
    case 0:
    case 1:
    case 2:
      glEnable(mostly(ANY(caps)));
      break;
    case 3:
    case 4:
    case 5:
      glDisable(mostly(ANY(caps)));
      break;
    case 6:
      glBlendFunc(mostly(ANY(factors)), ANY(factors));
      break;
    case 7:
      glAlphaFunc(mostly(ANY(functions)), fraction());
      break;
    case 8:
      glDepthFunc(mostly(ANY(functions)));
      break;
    case 9:
      glTexEnvi(mostly(GL_TEXTURE_ENV), GL_TEXTURE_ENV_MODE, (GLint)mostly(ANY(environments)));
      break;
    case 10:
      glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, four);
      break;
    case 11:
      glFogi(mostly(GL_FOG_MODE), (GLint)mostly(ANY(fogs)));
      break;
    case 12:
      glFogfv(GL_FOG_COLOR, four);
      break;
    case 13:
      glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, (GLint)mostly(GL_SEPARATE_SPECULAR_COLOR));
      break;
    case 14:
      glActiveTexture(mostly(GL_TEXTURE0 + below(4)));
      break;
    case 15:
      glPushAttrib(ANY(groups));
      break;
    case 16:
      glPopAttrib();
      break;
    case 17:
      glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
      break;
    case 18:
      glPopClientAttrib();
      break;
    case 19:
      glMatrixMode(mostly(below(2) ? GL_MODELVIEW : GL_TEXTURE));
      break;
    case 20:
      glRotatef(360 * fraction(), 0, 0, 1);
      break;
    default:
      glUseProgram(below(3) ? 0 : mostly(program));
      break;
  }
}

static void set_textures(void) {
  static const GLenum targets[] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP};
  static const GLint formats[] = {GL_RGBA,       GL_RGB,   GL_LUMINANCE,       GL_ALPHA,
                                  GL_INTENSITY8, GL_RGBA8, GL_LUMINANCE_ALPHA, 0x1236};
  static const GLint filters[] = {GL_NEAREST, GL_LINEAR, GL_NEAREST_MIPMAP_NEAREST};
  static GLubyte texels[4 * 8 * 8 * 8];
  for (size_t i = 0; i < sizeof texels; i += 1 + below(9)) texels[i] = (GLubyte)below(256);
  const GLenum target = ANY(targets);
  const GLsizei side = 1 << below(4);
  const GLuint names[2] = {1 + below(TEXTURES), below(99)};
  switch (below(9)) {
    case 0:
    case 1:
      glBindTexture(mostly(target), below(TEXTURES + 1));
      break;
    case 2:
    case 3:
      glTexImage2D(mostly(GL_TEXTURE_2D), 0, ANY(formats), side, side, 0, mostly(GL_RGBA), GL_UNSIGNED_BYTE, texels);
      break;
    case 4:
      glTexImage1D(GL_TEXTURE_1D, 0, ANY(formats), side, 0, GL_RGBA, mostly(GL_UNSIGNED_BYTE), texels);
      break;
    case 5:
      glTexImage3D(GL_TEXTURE_3D, 0, ANY(formats), side, side, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
      break;
    case 6:
      glTexParameteri(target, mostly(below(2) ? GL_TEXTURE_MIN_FILTER : GL_TEXTURE_MAG_FILTER),
                      (GLint)mostly((GLenum)ANY(filters)));
      break;
    case 7:
      glTexSubImage2D(GL_TEXTURE_2D, 0, (GLint)below(4), 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, texels);
      break;
    default:
      glDeleteTextures(2, names);
      break;
  }
}

static void draw(void) {
  const GLenum mode = mostly(ANY(modes));
  const GLsizei count = (GLsizei)below(16);
  static GLubyte indices[16], bitmap[8 * 4] = {0xF0, 0, 0, 0, 0x0F, 0, 0, 0, 0xAA, 0, 0, 0, 0x55, 0, 0, 0, 0xFF};
  /* Mesa 22.3 crashes at the end of a list in which only later vertices of a primitive have an attribute. In a list, one
   * that is set outside of glBegin and glEnd comes back after a called list that has set it in a primitive. */
  const unsigned any = below(8), unit = below(4), attributes = mode > GL_POLYGON && open_list() ? 0 : any;
  for (int i = 0; i < 16; ++i) indices[i] = (GLubyte)below(32);
  switch (below(10)) {
    case 0:
    case 1:
    case 2:
      glBegin(mode);
      for (unsigned i = below(12); i > 0; --i) {
        if (attributes & 1) glColor4f(fraction(), fraction(), fraction(), fraction());
        if (attributes & 2) glMultiTexCoord2f(GL_TEXTURE0 + unit, position(), position());
        if (attributes & 4) glSecondaryColor3f(fraction(), fraction(), fraction());
        if (!below(40)) glEnable(GL_BLEND); /* an error */
        glVertex2f(position(), position());
      }
      glEnd();
      break;
    case 3:
      glDrawArrays(mode, (GLint)below(16), count);
      break;
    case 4:
      glDrawElements(mode, count, mostly(GL_UNSIGNED_BYTE), indices);
      break;
    case 5:
      glRectf(position(), position(), position(), position());
      break;
    case 6:
      glRasterPos2f(position(), position());
      glBitmap(8, 8, 0, 0, 2, 2, bitmap);
      break;
    case 7:
      glDrawPixels(2, 2, GL_RGBA, mostly(GL_UNSIGNED_BYTE), colors);
      break;
    case 8:
      glDrawRangeElements(mode, 0, 31, count, GL_UNSIGNED_BYTE, indices);
      break;
    default:
      (below(3) ? glEnableClientState : glDisableClientState)(mostly(below(2) ? GL_VERTEX_ARRAY : GL_COLOR_ARRAY));
      break;
  }
}

/* Mesa 22.3 keeps the vertices of a list until a command of state. If a later primitive of them has more attributes, it
 * cuts the list inside of that one, and believes to be between its glBegin and glEnd when it executes the first part. */
static void end_vertices_of_list(void) {
  if (open_list()) glLineWidth(1);
}

/* A list calls those of lower numbers alone: lists that call themselves take for ever. */
static void use_lists(void) {
  const GLuint open = open_list();
  const unsigned end = open > 0 && open <= LISTS ? open : LISTS + 1;
  const GLuint list = 1 + below(LISTS), called = below(end), many[4] = {below(end), below(end), 0, LISTS + 9};
  switch (below(9)) {
    case 0:
    case 1:
      if (open == 0 || !below(8))
        glNewList(below(20) ? list : 0, mostly(below(2) ? GL_COMPILE : GL_COMPILE_AND_EXECUTE));
      break;
    case 2:
    case 3:
      if (open) glEndList();
      break; /* Mesa 22.3 crashes at one without a list */
    case 4:
    case 5:
      glCallList(called);
      break;
    case 6:
      glCallLists(4, mostly(GL_UNSIGNED_INT), many);
      break;
    case 7:
      printf("list %d\n", glIsList(list));
      break;
    default:
      if (open == 0) glDeleteLists(list, (GLsizei)below(3));
      break;
  }
}

static void read_back(void) {
  float values[16] = {0};
  GLint integers[16] = {0};
  const GLenum name = ANY(values_read);
  glGetFloatv(name, values);
  glGetIntegerv(name, integers);
  printf("0x%04x:", name);
  for (int i = 0; i < 16; ++i) printf(" %.6g %d", values[i], integers[i]);
  printf(" %d\n", glIsEnabled(mostly(ANY(caps))));
}

static void print_picture(void) {
  static GLubyte pixels[SIDE * SIDE * 4];
  uint64_t hash = 14695981039346656037ULL;
  glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  for (size_t i = 0; i < sizeof pixels; ++i) hash = (hash ^ pixels[i]) * 1099511628211ULL;
  printf("picture %016llx\n", (unsigned long long)hash);
}

static GLuint make_program(void) {
  const char* text = "void main() { gl_FragColor = vec4(gl_Color.bgr, 0.5); }";
  const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER), made = glCreateProgram();
  glShaderSource(shader, 1, &text, NULL);
  glCompileShader(shader);
  glAttachShader(made, shader);
  glLinkProgram(made);
  return made;
}

int main(int argc, char** argv) {
  state = 0x9E3779B97F4A7C15ULL * (1 + strtoull(argc > 1 ? argv[1] : "0", NULL, 10));
  if (!make_context(SIDE)) {
    puts("no driver");
    return 77;
  }
  for (int i = 0; i < 32; ++i) {
    for (int k = 0; k < 2; ++k) vertices[i][k] = position();
    for (int k = 0; k < 4; ++k) colors[i][k] = fraction();
  }
  glVertexPointer(2, GL_FLOAT, 0, vertices);
  glColorPointer(4, GL_FLOAT, 0, colors);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  program = make_program();
  for (int i = 0; i < CALLS; ++i) {
    const unsigned kind = below(10);
    if (kind < 3)
      set_state();
    else if (kind < 5)
      set_textures();
    else if (kind < 7) {
      draw();
      end_vertices_of_list();
    }
    else if (kind < 9)
      use_lists();
    else
      read_back();
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) printf("%d: error 0x%04x\n", i, error);
    if (i % 24 == 23) print_picture();
  }
  if (open_list()) glEndList();
  print_picture();
  eglTerminate(eglGetCurrentDisplay());
  return 0;
}
