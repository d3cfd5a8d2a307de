/* A context of EGL without a screen, for programs of both word lengths. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#define LOOK_UP(type, name) const type name = (type)eglGetProcAddress("gl" #name)

/* Draws into a square of that side. Returns 0 where there is no OpenGL. */
static int make_context(int side) {
  const EGLint wanted[] = {
      EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_ALPHA_SIZE, 8,
      EGL_NONE};
  const EGLint size[] = {EGL_WIDTH, side, EGL_HEIGHT, side, EGL_NONE};
  const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  EGLConfig config;
  EGLint found = 0;
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display, wanted, &config, 1, &found) || !found) {
    return 0;
  }
  const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
  return eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, EGL_NO_CONTEXT, NULL));
}
