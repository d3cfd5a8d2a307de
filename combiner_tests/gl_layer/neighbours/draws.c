/* Draws a green window by combiners, its functions found as the argument says, and prints the pixel in the middle. A
 * second argument is an extension's name: it says whether it is listed; a third one is a function to look up. */
#define _GNU_SOURCE
#define GL_GLEXT_PROTOTYPES
#include <GL/freeglut.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

static void* library;

static void* find(const char* name) {
  dlerror();
  void* found = dlsym(library, name);
  const char* fault = dlerror();
  if (!found || fault) printf("%s: %p, dlerror: %s\n", name, found, fault ? fault : "none");
  return found;
}

int main(int argc, char** argv) {
  const char *way = argc > 1 ? argv[1] : "", *extension = argc > 2 ? argv[2] : NULL;
  library = !strcmp(way, "next") ? RTLD_NEXT : !strcmp(way, "default") ? RTLD_DEFAULT : dlopen("libGL.so.1", RTLD_NOW);
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE);
  glutInitWindowSize(64, 64);
  glutCreateWindow("draws");
  void (*enable)(unsigned) = find("glEnable"), (*begin)(unsigned) = find("glBegin");
  void (*flush)(void) = find("glFlush"), (*end)(void) = find("glEnd");
  void (*parameter)(unsigned, const float*) = find("glCombinerParameterfvNV");
  void (*input)(unsigned, unsigned, unsigned, unsigned) = find("glFinalCombinerInputNV");
  if (dlsym(library, "glNobodyHasThisFunction") || !dlerror()) puts("a function that nobody has is found");
  const char* listed = (const char*)glGetString(GL_EXTENSIONS);
  if (argc > 3) glutGetProcAddress(argv[3]);
  if (extension) printf("%s is%s listed\n", extension, strstr(listed, extension) ? "" : " not");
  const float green[] = {0, 1, 0, 1}, red[] = {1, 0, 0, 1};
  glColor4fv(red);
  if (strstr(listed, "GL_NV_register_combiners")) {
    parameter(GL_CONSTANT_COLOR0_NV, green);
    for (unsigned v = GL_VARIABLE_A_NV; v <= GL_VARIABLE_C_NV; ++v) {
      input(v, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    }
    input(GL_VARIABLE_D_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    input(GL_VARIABLE_G_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    enable(GL_REGISTER_COMBINERS_NV);
  }
  begin(GL_QUADS);
  for (int i = 0; i < 4; ++i) glVertex2f(i == 1 || i == 2 ? 1 : -1, i > 1 ? 1 : -1);
  end();
  flush();
  unsigned char pixel[4];
  glReadPixels(32, 32, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  printf("pixel %d %d %d, error 0x%04x\n", pixel[0], pixel[1], pixel[2], glGetError());
  return 0;
}
