/* Runs small register combiner programs on this computer's card and writes what they show. */
#ifdef _WIN32
#include <windows.h>
#else
#include <GL/glx.h>
#include <X11/Xlib.h>
#endif
#include <GL/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef APIENTRY
#define APIENTRY
#endif
#ifndef GL_TEXTURE0_ARB
#define GL_TEXTURE0_ARB 0x84C0
#define GL_TEXTURE1_ARB 0x84C1
#define GL_MAX_TEXTURE_UNITS_ARB 0x84E2
#endif
#ifndef GL_LIGHT_MODEL_COLOR_CONTROL
#define GL_LIGHT_MODEL_COLOR_CONTROL 0x81F8
#define GL_SINGLE_COLOR 0x81F9
#endif
#ifndef GL_NV_register_combiners
#define GL_REGISTER_COMBINERS_NV 0x8522
#define GL_VARIABLE_A_NV 0x8523
#define GL_VARIABLE_B_NV 0x8524
#define GL_VARIABLE_C_NV 0x8525
#define GL_VARIABLE_D_NV 0x8526
#define GL_VARIABLE_E_NV 0x8527
#define GL_VARIABLE_F_NV 0x8528
#define GL_VARIABLE_G_NV 0x8529
#define GL_CONSTANT_COLOR0_NV 0x852A
#define GL_CONSTANT_COLOR1_NV 0x852B
#define GL_PRIMARY_COLOR_NV 0x852C
#define GL_SECONDARY_COLOR_NV 0x852D
#define GL_SPARE0_NV 0x852E
#define GL_DISCARD_NV 0x8530
#define GL_E_TIMES_F_NV 0x8531
#define GL_UNSIGNED_IDENTITY_NV 0x8536
#define GL_UNSIGNED_INVERT_NV 0x8537
#define GL_EXPAND_NORMAL_NV 0x8538
#define GL_EXPAND_NEGATE_NV 0x8539
#define GL_HALF_BIAS_NORMAL_NV 0x853A
#define GL_HALF_BIAS_NEGATE_NV 0x853B
#define GL_SIGNED_IDENTITY_NV 0x853C
#define GL_SIGNED_NEGATE_NV 0x853D
#define GL_SCALE_BY_TWO_NV 0x853E
#define GL_SCALE_BY_FOUR_NV 0x853F
#define GL_SCALE_BY_ONE_HALF_NV 0x8540
#define GL_BIAS_BY_NEGATIVE_ONE_HALF_NV 0x8541
#define GL_NUM_GENERAL_COMBINERS_NV 0x854E
#define GL_COLOR_SUM_CLAMP_NV 0x854F
#define GL_COMBINER0_NV 0x8550
#define GL_COMBINER1_NV 0x8551
#endif

typedef void(APIENTRY *ActiveTexture)(GLenum);
typedef void(APIENTRY *CombinerParameteri)(GLenum, GLint);
typedef void(APIENTRY *CombinerParameterfv)(GLenum, const GLfloat *);
typedef void(APIENTRY *CombinerInput)(GLenum, GLenum, GLenum, GLenum, GLenum, GLenum);
typedef void(APIENTRY *CombinerOutput)(GLenum, GLenum, GLenum, GLenum, GLenum, GLenum, GLenum, GLboolean, GLboolean,
                                       GLboolean);
typedef void(APIENTRY *FinalCombinerInput)(GLenum, GLenum, GLenum, GLenum);
static ActiveTexture active_texture;
static CombinerParameteri combiner_parameter_i;
static CombinerParameterfv combiner_parameter_fv;
static CombinerInput combiner_input;
static CombinerOutput combiner_output;
static FinalCombinerInput final_combiner_input;
#define glCombinerParameteriNV combiner_parameter_i
#define glCombinerParameterfvNV combiner_parameter_fv
#define glCombinerInputNV combiner_input
#define glCombinerOutputNV combiner_output
#define glFinalCombinerInputNV final_combiner_input

/* ROWS: their programs and their inputs */

typedef void (*Function)(void);

#ifdef _WIN32
static Function function_named(const char *name) { return (Function)wglGetProcAddress(name); }

/* Makes a window with an OpenGL context current. Returns a message, or null. */
static const char *open_window(void) {
  WNDCLASSA kind;
  PIXELFORMATDESCRIPTOR format;
  HWND window;
  HDC device;
  HGLRC context;
  int number;
  memset(&kind, 0, sizeof kind);
  kind.style = CS_OWNDC;
  kind.lpfnWndProc = DefWindowProcA;
  kind.hInstance = GetModuleHandleA(NULL);
  kind.lpszClassName = "ninebit kit";
  if (!RegisterClassA(&kind)) return "Windows refuses a window class";
  window = CreateWindowA("ninebit kit", "ninebit kit", WS_OVERLAPPEDWINDOW | WS_VISIBLE, 0, 0, 160, 160, NULL, NULL,
                         kind.hInstance, NULL);
  if (!window) return "Windows refuses a window";
  device = GetDC(window);
  memset(&format, 0, sizeof format);
  format.nSize = sizeof format;
  format.nVersion = 1;
  format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
  format.iPixelType = PFD_TYPE_RGBA;
  format.cColorBits = 24;
  number = ChoosePixelFormat(device, &format);
  if (!number || !SetPixelFormat(device, number, &format)) return "there is no pixel format with OpenGL";
  context = wglCreateContext(device);
  if (!context || !wglMakeCurrent(device, context)) return "there is no OpenGL context";
  return NULL;
}
#else
static Function function_named(const char *name) { return glXGetProcAddressARB((const GLubyte *)name); }

/* Makes a window with an OpenGL context current. Returns a message, or null. */
static const char *open_window(void) {
  int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, None};
  XSetWindowAttributes attributes;
  XVisualInfo *visual;
  GLXContext context;
  Window window;
  XEvent event;
  Display *display = XOpenDisplay(NULL);
  if (!display) return "there is no X display; is DISPLAY set?";
  visual = glXChooseVisual(display, DefaultScreen(display), wanted);
  if (!visual) return "the display has no double-buffered visual with 8 bits a colour; set a depth of 24 bits";
  memset(&attributes, 0, sizeof attributes);
  attributes.colormap = XCreateColormap(display, RootWindow(display, visual->screen), visual->visual, AllocNone);
  attributes.event_mask = StructureNotifyMask;
  attributes.override_redirect = True;
  window = XCreateWindow(display, RootWindow(display, visual->screen), 0, 0, 160, 160, 0, visual->depth, InputOutput,
                         visual->visual, CWColormap | CWEventMask | CWBorderPixel | CWOverrideRedirect, &attributes);
  XMapWindow(display, window);
  do {
    XNextEvent(display, &event);
  } while (event.type != MapNotify);
  context = glXCreateContext(display, visual, NULL, True);
  if (!context || !glXMakeCurrent(display, window, context)) return "there is no OpenGL context";
  return NULL;
}
#endif

static int has_extension(const char *name) {
  const char *all = (const char *)glGetString(GL_EXTENSIONS);
  const size_t length = strlen(name);
  while (all && (all = strstr(all, name)) != NULL) {
    if (all[length] == ' ' || all[length] == '\0') return 1;
    all += length;
  }
  return 0;
}

/* Returns what is missing to run the kit, or null. */
static const char *prepare(void) {
  GLint bits = 0, units = 0;
  if (!has_extension("GL_NV_register_combiners")) {
    return "this driver has no GL_NV_register_combiners; the kit needs a GeForce or Quadro card and NVIDIA's driver";
  }
  if (!has_extension("GL_ARB_multitexture")) return "this driver has no GL_ARB_multitexture";
  glGetIntegerv(GL_RED_BITS, &bits);
  if (bits < 8) return "the window has less than 8 bits a colour; set the desktop to 24 or 32 bits";
  glGetIntegerv(GL_MAX_TEXTURE_UNITS_ARB, &units);
  if (units < 2) return "the card has fewer than two texture units";
  active_texture = (ActiveTexture)function_named("glActiveTextureARB");
  combiner_parameter_i = (CombinerParameteri)function_named("glCombinerParameteriNV");
  combiner_parameter_fv = (CombinerParameterfv)function_named("glCombinerParameterfvNV");
  combiner_input = (CombinerInput)function_named("glCombinerInputNV");
  combiner_output = (CombinerOutput)function_named("glCombinerOutputNV");
  final_combiner_input = (FinalCombinerInput)function_named("glFinalCombinerInputNV");
  if (!active_texture || !combiner_parameter_i || !combiner_parameter_fv || !combiner_input || !combiner_output ||
      !final_combiner_input) {
    return "the driver lacks a function of its own extensions";
  }
  return NULL;
}

/* Fills the texture of a unit with one byte, or turns the unit off. */
static void set_texture(int unit, int byte, int is_on) {
  unsigned char texels[4 * 4 * 4];
  memset(texels, byte, sizeof texels);
  active_texture((GLenum)(GL_TEXTURE0_ARB + unit));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  if (is_on) {
    glEnable(GL_TEXTURE_2D);
  } else {
    glDisable(GL_TEXTURE_2D);
  }
}

/* Draws a square that fills the window with a row's program, and reads a pixel in its middle. */
static void run(const Row *row, unsigned char pixel[3]) {
  int unit;
  GLuint names[2];
  glGenTextures(2, names);
  for (unit = 0; unit < 2; ++unit) {
    active_texture((GLenum)(GL_TEXTURE0_ARB + unit));
    glBindTexture(GL_TEXTURE_2D, names[unit]);
    set_texture(unit, unit == 0 ? row->tex0 : row->tex1, unit != row->unit_off);
  }
  /* Lit with a single colour, the secondary colour is (0, 0, 0, 0). */
  glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SINGLE_COLOR);
  if (row->reads_secondary) {
    glEnable(GL_LIGHTING);
  } else {
    glDisable(GL_LIGHTING);
  }
  glDisable(GL_DITHER);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FOG);
  glShadeModel(GL_FLAT);
  glViewport(0, 0, 128, 128);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glDrawBuffer(GL_BACK);
  glReadBuffer(GL_BACK);
  row->program();
  glColor4ub((GLubyte)row->primary, (GLubyte)row->primary, (GLubyte)row->primary, (GLubyte)row->primary);
  glRectf(-1.0f, -1.0f, 1.0f, 1.0f);
  glDisable(GL_REGISTER_COMBINERS_NV);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(64, 64, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, pixel);
  glDeleteTextures(2, names);
}

int main(int argc, char **argv) {
  const char *file = argc > 1 ? argv[1] : "results.csv";
  unsigned char pixels[ROWS][3];
  const char *missing = open_window();
  GLenum error;
  FILE *out;
  int i, written;
  if (!missing) missing = prepare();
  if (missing) {
    fprintf(stderr, "kit: %s\n", missing);
    return 2;
  }
  for (i = 0; i < ROWS; ++i) run(&rows[i], pixels[i]);
  error = glGetError();
  if (error != GL_NO_ERROR) {
    fprintf(stderr, "kit: OpenGL reports error 0x%04X; nothing is written\n", (unsigned)error);
    return 2;
  }
  out = fopen(file, "w");
  if (!out) {
    fprintf(stderr, "kit: cannot write %s\n", file);
    return 2;
  }
  fprintf(out, "# family: %s\n# vendor: %s\n# renderer: %s\n# version: %s\n%s\n", FAMILY,
          (const char *)glGetString(GL_VENDOR), (const char *)glGetString(GL_RENDERER),
          (const char *)glGetString(GL_VERSION), HEADER);
  for (i = 0; i < ROWS; ++i) {
    fprintf(out, "%s%d,%d,%d\n", rows[i].begin, pixels[i][0], pixels[i][1], pixels[i][2]);
  }
  written = !ferror(out);
  if (fclose(out) != 0 || !written) {
    fprintf(stderr, "kit: cannot write %s\n", file);
    return 2;
  }
  printf("wrote %s\n", file);
  return 0;
}
