/* Copies a context's state by glXCopyContext, while it is current and afterwards: copies [combiners]. Prints the errors
 * of the X server, and what the other context has of the state then. */
#include <GL/glx.h>
#include <stdio.h>

static int print_error(Display* display, XErrorEvent* error) {
  (void)display;
  printf("X error %d\n", error->error_code);
  return 0;
}

int main(int argc, char** argv) {
  (void)argv;
  int wanted[] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_DOUBLEBUFFER, None};
  Display* const display = XOpenDisplay(NULL);
  XVisualInfo* const visual = display ? glXChooseVisual(display, DefaultScreen(display), wanted) : NULL;
  if (!visual) return 77;
  const Window root = RootWindow(display, visual->screen);
  XSetWindowAttributes attributes = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone)};
  const Window window = XCreateWindow(display, root, 0, 0, 8, 8, 0, visual->depth, InputOutput, visual->visual,
                                      CWColormap | CWBorderPixel, &attributes);
  const GLXContext from = glXCreateContext(display, visual, NULL, True);
  const GLXContext to = glXCreateContext(display, visual, NULL, True);
  if (!from || !to || !glXMakeCurrent(display, window, from)) return 77;
  XSetErrorHandler(print_error);
  glEnable(GL_FOG);
  if (argc > 1) glEnable(0x8522); /* GL_REGISTER_COMBINERS_NV */
  for (int i = 0; i < 2; ++i) {
    glXCopyContext(display, from, to, GL_ALL_ATTRIB_BITS);
    XSync(display, False);
    glXMakeCurrent(display, None, NULL);
  }
  glXMakeCurrent(display, window, to);
  printf("fog %d, error 0x%04x\n", glIsEnabled(GL_FOG), glGetError());
  return 0;
}
