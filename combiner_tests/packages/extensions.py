"""Prints the extensions of OpenGL that a program sees: a context of EGL without a screen, by ctypes."""
import ctypes

egl = ctypes.CDLL("libEGL.so.1", mode=ctypes.RTLD_GLOBAL)
ctypes.CDLL("libGL.so.1", mode=ctypes.RTLD_GLOBAL)
pointer, number = ctypes.c_void_p, ctypes.c_int
SURFACELESS, OPENGL = 0x31DD, 0x30A2  # EGL_PLATFORM_SURFACELESS_MESA, EGL_OPENGL_API
egl.eglGetPlatformDisplay.restype = egl.eglCreateContext.restype = pointer
display = pointer(egl.eglGetPlatformDisplay(number(SURFACELESS), None, None))
assert egl.eglInitialize(display, None, None), "no display of EGL"
assert egl.eglBindAPI(number(OPENGL)), "no OpenGL"
context = pointer(egl.eglCreateContext(display, None, None, None))
assert egl.eglMakeCurrent(display, None, None, context), "no context"
# Found where a program that links libGL finds it: in a library that was loaded before, if there is one.
everywhere = ctypes.CDLL(None)
everywhere.glGetString.restype = ctypes.c_char_p
print(everywhere.glGetString(number(0x1F03)).decode())  # GL_EXTENSIONS
