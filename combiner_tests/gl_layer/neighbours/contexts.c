/* Contexts that have no combiners, and processes that fork: contexts core|gles|fork. Prints what it draws. */
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../egl_context.h"

static void print_pixel(const char* who) {
  unsigned char pixel[4];
  glReadPixels(4, 4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  printf("%s: pixel %d %d %d, error 0x%04x\n", who, pixel[0], pixel[1], pixel[2], glGetError());
  fflush(stdout);
}

static int draw_by_combiners(const char* who) {
  const float green[] = {0, 1, 0, 1};
  if (!make_context(8)) return 77;
  LOOK_UP(PFNGLCOMBINERPARAMETERFVNVPROC, CombinerParameterfvNV);
  LOOK_UP(PFNGLFINALCOMBINERINPUTNVPROC, FinalCombinerInputNV);
  if (strstr((const char*)glGetString(GL_EXTENSIONS), "GL_NV_register_combiners")) {
    CombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, green);
    for (GLenum v = GL_VARIABLE_A_NV; v <= GL_VARIABLE_C_NV; ++v) FinalCombinerInputNV(v, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    FinalCombinerInputNV(GL_VARIABLE_D_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glEnable(GL_REGISTER_COMBINERS_NV);
  }
  glRectf(-1, -1, 1, 1);
  print_pixel(who);
  return 0;
}

/* Values that a context without combiners must not know. */
static void print_answers(void) {
  int combiners = 0, number = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &number);
  for (int i = 0; i < number; ++i) {
    combiners += strstr((const char*)glGetStringi(GL_EXTENSIONS, (GLuint)i), "register_combiners") != NULL;
  }
  printf("%d with combiners, error 0x%04x\n", combiners, glGetError());
  glEnable(GL_REGISTER_COMBINERS_NV);
  printf("enabled: error 0x%04x\n", glGetError());
  glGetIntegerv(GL_NUM_GENERAL_COMBINERS_NV, &number);
  printf("asked: error 0x%04x\n", glGetError());
  glClearColor(0, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  print_pixel("cleared");
}

int main(int argc, char** argv) {
  const EGLint core[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLint es[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
  const char* kind = argc > 1 ? argv[1] : "";
  if (!strcmp(kind, "fork")) {
    const pid_t child = fork(); /* nothing of OpenGL has been called, but the layer is loaded */
    if (child == 0) return draw_by_combiners("child");
    int status = 0;
    waitpid(child, &status, 0);
    return status ? 1 : draw_by_combiners("parent");
  }
  const int is_core = !strcmp(kind, "core");
  if (!(is_core ? make_context_of(EGL_OPENGL_API, EGL_OPENGL_BIT, core, 8)
                : make_context_of(EGL_OPENGL_ES_API, EGL_OPENGL_ES3_BIT, es, 8))) {
    return 77;
  }
  print_answers();
  return 0;
}
