/* A Windows program with OpenGL: it draws 256 fragments with each of a few register combiner set-ups and prints what it
 * reads back. It knows nothing of ninebit, and of Wine neither.
 *
 *   combiners.exe INPUTS.bin > RESULTS.txt
 *
 * INPUTS.bin holds four planes of 256 colours of four bytes: the primary colour, the secondary colour, the texels of two
 * textures of 16 x 16. Each fragment is a cell of 2 x 2 pixels. Exit status 2: the extension is missing.
 */
#include <windows.h>

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 16, CELL = 2, PIXELS = SIDE * CELL };

static unsigned char inputs[4][SIDE * SIDE][4];

#define FUNCTIONS(F) \
  F(glCombinerParameterfvNV, PFNGLCOMBINERPARAMETERFVNVPROC) \
  F(glCombinerParameterfNV, PFNGLCOMBINERPARAMETERFNVPROC) \
  F(glCombinerParameterivNV, PFNGLCOMBINERPARAMETERIVNVPROC) \
  F(glCombinerParameteriNV, PFNGLCOMBINERPARAMETERINVPROC) \
  F(glCombinerInputNV, PFNGLCOMBINERINPUTNVPROC) \
  F(glCombinerOutputNV, PFNGLCOMBINEROUTPUTNVPROC) \
  F(glFinalCombinerInputNV, PFNGLFINALCOMBINERINPUTNVPROC) \
  F(glGetCombinerInputParameterfvNV, PFNGLGETCOMBINERINPUTPARAMETERFVNVPROC) \
  F(glGetCombinerInputParameterivNV, PFNGLGETCOMBINERINPUTPARAMETERIVNVPROC) \
  F(glGetCombinerOutputParameterfvNV, PFNGLGETCOMBINEROUTPUTPARAMETERFVNVPROC) \
  F(glGetCombinerOutputParameterivNV, PFNGLGETCOMBINEROUTPUTPARAMETERIVNVPROC) \
  F(glGetFinalCombinerInputParameterfvNV, PFNGLGETFINALCOMBINERINPUTPARAMETERFVNVPROC) \
  F(glGetFinalCombinerInputParameterivNV, PFNGLGETFINALCOMBINERINPUTPARAMETERIVNVPROC) \
  F(glActiveTextureARB, PFNGLACTIVETEXTUREARBPROC) \
  F(glMultiTexCoord2fARB, PFNGLMULTITEXCOORD2FARBPROC) \
  F(glSecondaryColor3ubEXT, PFNGLSECONDARYCOLOR3UBEXTPROC)

#define DECLARE(name, type) static type name;
FUNCTIONS(DECLARE)

#include "programs.c"

static void open_window(void) {
  WNDCLASSA type;
  PIXELFORMATDESCRIPTOR format;
  HWND window;
  HDC device;
  memset(&type, 0, sizeof type);
  type.style = CS_OWNDC;
  type.lpfnWndProc = DefWindowProcA;
  type.hInstance = GetModuleHandleA(NULL);
  type.lpszClassName = "combiners";
  RegisterClassA(&type);
  window = CreateWindowA("combiners", "combiners", WS_POPUP | WS_VISIBLE, 0, 0, PIXELS, PIXELS, NULL, NULL, type.hInstance, NULL);
  device = GetDC(window);
  memset(&format, 0, sizeof format);
  format.nSize = sizeof format;
  format.nVersion = 1;
  format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
  format.cColorBits = 32;
  format.cAlphaBits = 8;
  format.cDepthBits = 24;
  SetPixelFormat(device, ChoosePixelFormat(device, &format), &format);
  wglMakeCurrent(device, wglCreateContext(device));
}

static int load_functions(void) {
  int found = 0, all = 0;
#define LOAD(name, type) found += (name = (type)(void *)wglGetProcAddress(#name)) != NULL, ++all;
  FUNCTIONS(LOAD)
  printf("functions: %d of %d\n", found, all);
  return found == all;
}

/* Calls that the specification refuses, and what the state says afterwards. */
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

static void make_textures(void) {
  static const GLfloat fog[4] = {0.2f, 0.4f, 0.6f, 1.0f};
  int unit;
  for (unit = 0; unit < 2; ++unit) {
    glActiveTextureARB(GL_TEXTURE0_ARB + unit);
    glBindTexture(GL_TEXTURE_2D, 1 + unit);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, inputs[2 + unit]);
    glEnable(GL_TEXTURE_2D);
  }
  glActiveTextureARB(GL_TEXTURE0_ARB);
  glFogfv(GL_FOG_COLOR, fog);
}

static void draw_cells(void) {
  int i, corner;
  glBegin(GL_QUADS);
  for (i = 0; i < SIDE * SIDE; ++i) {
    glColor4ubv(inputs[0][i]);
    glSecondaryColor3ubEXT(inputs[1][i][0], inputs[1][i][1], inputs[1][i][2]);
    for (corner = 0; corner < 4; ++corner) {
      float x = (float)(i % SIDE + (corner == 1 || corner == 2)) / SIDE, y = (float)(i / SIDE + (corner >= 2)) / SIDE;
      glMultiTexCoord2fARB(GL_TEXTURE0_ARB, x, y);
      glMultiTexCoord2fARB(GL_TEXTURE1_ARB, x, y);
      glVertex2f(2 * x - 1, 2 * y - 1);
    }
  }
  glEnd();
}

/* Set-ups start from the state of a new context: glPopAttrib brings it back. */
static void draw(const char *name, void (*set_up)(void)) {
  static unsigned char pixels[PIXELS][PIXELS][4];
  int i, x, y, uneven = 0;
  glClearColor(0.3f, 0.6f, 0.9f, 0.3f);
  glClear(GL_COLOR_BUFFER_BIT);
  glPushAttrib(GL_TEXTURE_BIT | GL_ENABLE_BIT);
  set_up();
  glEnable(GL_REGISTER_COMBINERS_NV);
  draw_cells();
  glPopAttrib();
  glReadPixels(0, 0, PIXELS, PIXELS, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  for (y = 0; y < PIXELS; ++y) {
    for (x = 0; x < PIXELS; ++x) uneven += memcmp(pixels[y][x], pixels[y / CELL * CELL][x / CELL * CELL], 4) != 0;
  }
  printf("program %s: error 0x%04x, %d pixels unlike their cell\n", name, glGetError(), uneven);
  for (i = 0; i < SIDE * SIDE; ++i) {
    const unsigned char *p = pixels[i / SIDE * CELL][i % SIDE * CELL];
    printf("%d %d %d %d\n", p[0], p[1], p[2], p[3]);
  }
}

int main(int argc, char **argv) {
  FILE *file = argc > 1 ? fopen(argv[1], "rb") : NULL;
  const char *extensions;
  int bits = 0;
  if (!file || fread(inputs, 1, sizeof inputs, file) != sizeof inputs) {
    printf("the inputs cannot be read\n");
    return 1;
  }
  open_window();
  extensions = (const char *)glGetString(GL_EXTENSIONS);
  if (!extensions) {
    printf("there is no OpenGL\n");
    return 1;
  }
  glGetIntegerv(GL_ALPHA_BITS, &bits);
  printf("renderer: %s, %d bits of alpha\n", (const char *)glGetString(GL_RENDERER), bits);
  if (!strstr(extensions, "GL_NV_register_combiners")) {
    printf("address of glCombinerInputNV: %s\n", wglGetProcAddress("glCombinerInputNV") ? "found" : "none");
    printf("GL_NV_register_combiners is missing\n");
    return 2;
  }
  if (!load_functions()) return 1;
  glDisable(GL_DITHER);
  make_textures();
  print_errors();
  draw("compare", set_up_compare);
  draw("specular", set_up_specular);
  draw("mux", set_up_mux);
  draw("final", set_up_final);
  return 0;
}
