/* A program of 32 bits without OpenGL, which looks for the layer's functions and calls one. Its stack is at multiples of
 * 4 bytes, as in programs of the time. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

int main(int argc, char **argv) {
  (void)argv;
  void *(*find)(const char *) = dlsym(RTLD_DEFAULT, "glXGetProcAddress");
  void (*set)(unsigned, int) = find ? find("glCombinerParameteriNV") : dlsym(RTLD_DEFAULT, "glCombinerParameteriNV");
  if (set) set(0x854E, 2); /* without a context: nothing happens */
  Dl_info info;
  const int known = set && dladdr((void *)set, &info);
  const char *const slash = known ? strrchr(info.dli_fname, '/') : NULL;
  printf("%d bits, glCombinerParameteriNV of %s\n", (int)sizeof(void *) * 8, slash ? slash + 1 : "nobody");
  return argc > 1 ? 5 : 0;
}
