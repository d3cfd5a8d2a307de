/* Draws by OSMesa, a library that has OpenGL's functions and is not the driver: a red picture.
 * WITH_GL: while libGL is loaded, too. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  void *mesa = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
#ifdef WITH_GL
  if (!dlopen("libGL.so.1", RTLD_NOW | RTLD_GLOBAL)) return 3;
#endif
  void *(*create)(unsigned, void *) = mesa ? dlsym(mesa, "OSMesaCreateContext") : NULL;
  int (*make_current)(void *, void *, unsigned, int, int) = mesa ? dlsym(mesa, "OSMesaMakeCurrent") : NULL;
  if (!create || !make_current) return 2;
  static unsigned char picture[64 * 64 * 4];
  if (!make_current(create(GL_RGBA, NULL), picture, GL_UNSIGNED_BYTE, 64, 64)) return 4;
  void (*enable)(unsigned) = dlsym(mesa, "glEnable"), (*clear)(unsigned) = dlsym(mesa, "glClear");
  void (*color)(float, float, float, float) = dlsym(mesa, "glClearColor"), (*finish)(void) = dlsym(mesa, "glFinish");
  unsigned char (*enabled)(unsigned) = dlsym(mesa, "glIsEnabled");
  unsigned (*error)(void) = dlsym(mesa, "glGetError");
  enable(GL_DEPTH_TEST);
  color(1, 0, 0, 1);
  clear(GL_COLOR_BUFFER_BIT);
  finish();
  printf("pixel %d %d, depth test %d, error 0x%04x, combiners %s\n", picture[0], picture[1], enabled(GL_DEPTH_TEST),
         error(), dlsym(mesa, "glCombinerInputNV") ? "found" : "not found");
  return 0;
}
