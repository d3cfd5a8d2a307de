/* A context of EGL without a screen. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#define LOOK_UP(type, name) const type name = (type)eglGetProcAddress("gl" #name)

/* Draws into a square of that side: EGL_OPENGL_API and its EGL_OPENGL_BIT, or another; `attributes` may be NULL.
 * Returns 0 where there is no such context. */
static int make_context_of(EGLenum api, EGLint renderable, const EGLint* attributes, int side) {
  const EGLint wanted[][2] = {{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT},
                              {EGL_RENDERABLE_TYPE, renderable},
                              {EGL_RED_SIZE, 8},
                              {EGL_ALPHA_SIZE, 8},
                              {EGL_DEPTH_SIZE, 24},
                              {EGL_STENCIL_SIZE, 8},
                              {EGL_NONE, 0}};
  const EGLint size[] = {EGL_WIDTH, side, EGL_HEIGHT, side, EGL_NONE};
  const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  EGLConfig config;
  EGLint found = 0;
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(api) ||
      !eglChooseConfig(display, wanted[0], &config, 1, &found) || !found) {
    return 0;
  }
  const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
  return eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, EGL_NO_CONTEXT, attributes));
}

static inline int make_context(int side) {
  return make_context_of(EGL_OPENGL_API, EGL_OPENGL_BIT, NULL, side);
}
