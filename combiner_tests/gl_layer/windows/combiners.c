/* A Windows program with OpenGL: it draws 256 fragments with each of a few register combiner set-ups and prints what it
 * reads back: in immediate mode, from a display list that holds the set-up as well, from arrays, and the same display
 * list in a pbuffer, with a context that shares it. Written without ninebit or Wine.
 *
 *   combiners.exe INPUTS.bin > RESULTS.txt
 *
 * INPUTS.bin holds four planes of 256 colours of four bytes: the primary colour, the secondary colour, the texels of
 * two textures of 16 x 16. Each fragment is a cell of 2 x 2 pixels. Exit status 2: the extension is missing.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/wglext.h>
#include <stdio.h>
#include <string.h>
#include <windows.h>

enum { SIDE = 16, CELL = 2, PIXELS = SIDE * CELL };

static unsigned char inputs[4][SIDE * SIDE][4];

#define FUNCTIONS(F)                                                                   \
  F(glCombinerParameterfvNV, PFNGLCOMBINERPARAMETERFVNVPROC)                           \
  F(glCombinerParameterfNV, PFNGLCOMBINERPARAMETERFNVPROC)                             \
  F(glCombinerParameterivNV, PFNGLCOMBINERPARAMETERIVNVPROC)                           \
  F(glCombinerParameteriNV, PFNGLCOMBINERPARAMETERINVPROC)                             \
  F(glCombinerInputNV, PFNGLCOMBINERINPUTNVPROC)                                       \
  F(glCombinerOutputNV, PFNGLCOMBINEROUTPUTNVPROC)                                     \
  F(glFinalCombinerInputNV, PFNGLFINALCOMBINERINPUTNVPROC)                             \
  F(glGetCombinerInputParameterfvNV, PFNGLGETCOMBINERINPUTPARAMETERFVNVPROC)           \
  F(glGetCombinerInputParameterivNV, PFNGLGETCOMBINERINPUTPARAMETERIVNVPROC)           \
  F(glGetCombinerOutputParameterfvNV, PFNGLGETCOMBINEROUTPUTPARAMETERFVNVPROC)         \
  F(glGetCombinerOutputParameterivNV, PFNGLGETCOMBINEROUTPUTPARAMETERIVNVPROC)         \
  F(glGetFinalCombinerInputParameterfvNV, PFNGLGETFINALCOMBINERINPUTPARAMETERFVNVPROC) \
  F(glGetFinalCombinerInputParameterivNV, PFNGLGETFINALCOMBINERINPUTPARAMETERIVNVPROC) \
  F(glActiveTextureARB, PFNGLACTIVETEXTUREARBPROC)                                     \
  F(glClientActiveTextureARB, PFNGLCLIENTACTIVETEXTUREARBPROC)                         \
  F(glMultiTexCoord2fARB, PFNGLMULTITEXCOORD2FARBPROC)                                 \
  F(glSecondaryColor3ubEXT, PFNGLSECONDARYCOLOR3UBEXTPROC)                             \
  F(glSecondaryColorPointerEXT, PFNGLSECONDARYCOLORPOINTEREXTPROC)                     \
  F(wglCreatePbufferARB, PFNWGLCREATEPBUFFERARBPROC)                                   \
  F(wglGetPbufferDCARB, PFNWGLGETPBUFFERDCARBPROC)

#define DECLARE(name, type) static type name;
FUNCTIONS(DECLARE)

#include "programs.c"

static HDC device, pbuffer_device;
static HGLRC context, pbuffer_context;

static void open_window(void) {
  WNDCLASSA type;
  PIXELFORMATDESCRIPTOR format;
  HWND window;
  memset(&type, 0, sizeof type);
  type.style = CS_OWNDC;
  type.lpfnWndProc = DefWindowProcA;
  type.hInstance = GetModuleHandleA(NULL);
  type.lpszClassName = "combiners";
  RegisterClassA(&type);
  window = CreateWindowA("combiners", "combiners", WS_POPUP | WS_VISIBLE, 0, 0, PIXELS, PIXELS, NULL, NULL,
                         type.hInstance, NULL);
  device = GetDC(window);
  memset(&format, 0, sizeof format);
  format.nSize = sizeof format;
  format.nVersion = 1;
  format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
  format.cColorBits = 32;
  format.cAlphaBits = 8;
  format.cDepthBits = 24;
  SetPixelFormat(device, ChoosePixelFormat(device, &format), &format);
  context = wglCreateContext(device);
  wglMakeCurrent(device, context);
}

static int load_functions(void) {
  int found = 0, all = 0;
#define LOAD(name, type) found += (name = (type)(void*)wglGetProcAddress(#name)) != NULL, ++all;
  FUNCTIONS(LOAD)
  printf("functions: %d of %d\n", found, all);
  return found == all;
}

/* Calls that are errors by the specification, then the state, which they must not change. */
static void print_errors(void) {
  GLint value = -1;
  GLfloat number = -1;
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_ONE, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  printf("input GL_ONE: 0x%04x\n", glGetError());
  glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  printf("RGB in the alpha portion: 0x%04x\n", glGetError());
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 99);
  printf("99 combiners: 0x%04x\n", glGetError());
  glGetCombinerInputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &value);
  printf("input of A: 0x%04x\n", value);
  glGetFinalCombinerInputParameterfvNV(GL_VARIABLE_G_NV, GL_COMBINER_COMPONENT_USAGE_NV, &number);
  printf("usage of G: 0x%04x\n", (int)number);
  glGetIntegerv(GL_MAX_GENERAL_COMBINERS_NV, &value);
  printf("combiners: %d\n", value);
  glGetIntegerv(GL_NUM_GENERAL_COMBINERS_NV, &value);
  printf("combiners in use: %d\n", value);
  printf("error: 0x%04x\n", glGetError());
}

/* A context of its own that shares textures and display lists with the window's. */
static int open_pbuffer(void) {
  HPBUFFERARB pbuffer = wglCreatePbufferARB(device, GetPixelFormat(device), PIXELS, PIXELS, NULL);
  if (!pbuffer) return 0;
  pbuffer_device = wglGetPbufferDCARB(pbuffer);
  pbuffer_context = wglCreateContext(pbuffer_device);
  return pbuffer_context && wglShareLists(context, pbuffer_context);
}

static void use_textures(void) {
  static const GLfloat fog[4] = {0.2f, 0.4f, 0.6f, 1.0f};
  int unit;
  for (unit = 0; unit < 2; ++unit) {
    glActiveTextureARB(GL_TEXTURE0_ARB + unit);
    glBindTexture(GL_TEXTURE_2D, 1 + unit);
    glEnable(GL_TEXTURE_2D);
  }
  glActiveTextureARB(GL_TEXTURE0_ARB);
  glFogfv(GL_FOG_COLOR, fog);
  glDisable(GL_DITHER);
}

static void make_textures(void) {
  int unit;
  for (unit = 0; unit < 2; ++unit) {
    glBindTexture(GL_TEXTURE_2D, 1 + unit);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, inputs[2 + unit]);
  }
}

/* The corners of the cells: four each. */
static GLfloat corners[SIDE * SIDE * 4][2];
static GLubyte primary[SIDE * SIDE * 4][4], secondary[SIDE * SIDE * 4][4];

static void make_cells(void) {
  int i, corner;
  for (i = 0; i < SIDE * SIDE; ++i) {
    for (corner = 0; corner < 4; ++corner) {
      corners[4 * i + corner][0] = (float)(i % SIDE + (corner == 1 || corner == 2)) / SIDE;
      corners[4 * i + corner][1] = (float)(i / SIDE + (corner >= 2)) / SIDE;
      memcpy(primary[4 * i + corner], inputs[0][i], 4);
      memcpy(secondary[4 * i + corner], inputs[1][i], 4);
    }
  }
}

/* Texture coordinates are from 0 to 1; so are the vertices, by the modelview matrix. */
static void draw_cells(void) {
  int i;
  glBegin(GL_QUADS);
  for (i = 0; i < SIDE * SIDE * 4; ++i) {
    glColor4ubv(primary[i]);
    glSecondaryColor3ubEXT(secondary[i][0], secondary[i][1], secondary[i][2]);
    glMultiTexCoord2fARB(GL_TEXTURE0_ARB, corners[i][0], corners[i][1]);
    glMultiTexCoord2fARB(GL_TEXTURE1_ARB, corners[i][0], corners[i][1]);
    glVertex2fv(corners[i]);
  }
  glEnd();
}

static void draw_arrays(void) {
  static GLushort numbers[SIDE * SIDE * 4];
  int i;
  for (i = 0; i < SIDE * SIDE * 4; ++i) numbers[i] = (GLushort)i;
  glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
  glVertexPointer(2, GL_FLOAT, 0, corners);
  glColorPointer(4, GL_UNSIGNED_BYTE, 0, primary);
  glSecondaryColorPointerEXT(3, GL_UNSIGNED_BYTE, 4, secondary);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glEnableClientState(GL_SECONDARY_COLOR_ARRAY_EXT);
  for (i = 0; i < 2; ++i) {
    glClientActiveTextureARB(GL_TEXTURE0_ARB + i);
    glTexCoordPointer(2, GL_FLOAT, 0, corners);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
  }
  glDrawElements(GL_QUADS, SIDE * SIDE * 4, GL_UNSIGNED_SHORT, numbers);
  glPopClientAttrib();
}

/* Set-ups start from the state of a new context: glPopAttrib brings it back. */
static void draw_with(void (*set_up)(void), void (*draw_them)(void)) {
  glPushAttrib(GL_TEXTURE_BIT | GL_ENABLE_BIT);
  set_up();
  glEnable(GL_REGISTER_COMBINERS_NV);
  draw_them();
  glPopAttrib();
}

static void clear(void) {
  glClearColor(0.3f, 0.6f, 0.9f, 0.3f);
  glClear(GL_COLOR_BUFFER_BIT);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glTranslatef(-1, -1, 0);
  glScalef(2, 2, 1);
}

static void print_picture(const char* name, const char* way) {
  static unsigned char pixels[PIXELS][PIXELS][4];
  int i, x, y, uneven = 0;
  glReadPixels(0, 0, PIXELS, PIXELS, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  for (y = 0; y < PIXELS; ++y) {
    for (x = 0; x < PIXELS; ++x) uneven += memcmp(pixels[y][x], pixels[y / CELL * CELL][x / CELL * CELL], 4) != 0;
  }
  printf("program %s, %s: error 0x%04x, %d pixels unlike their cell\n", name, way, glGetError(), uneven);
  for (i = 0; i < SIDE * SIDE; ++i) {
    const unsigned char* p = pixels[i / SIDE * CELL][i % SIDE * CELL];
    printf("%d %d %d %d\n", p[0], p[1], p[2], p[3]);
  }
}

static void draw(const char* name, void (*set_up)(void)) {
  GLuint list = glGenLists(1);
  clear();
  draw_with(set_up, draw_cells);
  print_picture(name, "immediate");

  glNewList(list, GL_COMPILE);
  draw_with(set_up, draw_cells);
  glEndList();
  clear();
  glCallList(list);
  print_picture(name, "list");

  clear();
  draw_with(set_up, draw_arrays);
  print_picture(name, "arrays");

  wglMakeCurrent(pbuffer_device, pbuffer_context);
  use_textures();
  clear();
  glCallList(list);
  print_picture(name, "pbuffer");
  wglMakeCurrent(device, context);
}

int main(int argc, char** argv) {
  FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
  const char* extensions;
  int bits = 0;
  if (!file || fread(inputs, 1, sizeof inputs, file) != sizeof inputs) {
    printf("the inputs cannot be read\n");
    return 1;
  }
  open_window();
  extensions = (const char*)glGetString(GL_EXTENSIONS);
  if (!extensions) {
    printf("there is no OpenGL\n");
    return 1;
  }
  glGetIntegerv(GL_ALPHA_BITS, &bits);
  printf("renderer: %s, %d bits of alpha\n", (const char*)glGetString(GL_RENDERER), bits);
  if (!strstr(extensions, "GL_NV_register_combiners")) {
    printf("address of glCombinerInputNV: %s\n", wglGetProcAddress("glCombinerInputNV") ? "found" : "none");
    printf("GL_NV_register_combiners is missing\n");
    return 2;
  }
  if (!load_functions()) return 1;
  if (!open_pbuffer()) {
    printf("there is no pbuffer\n");
    return 1;
  }
  make_textures();
  make_cells();
  use_textures();
  print_errors();
  draw("compare", set_up_compare);
  draw("specular", set_up_specular);
  draw("mux", set_up_mux);
  draw("final", set_up_final);
  return 0;
}
