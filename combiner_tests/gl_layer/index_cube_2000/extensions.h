/* The extensions that the program needs, looked up as in programs of 2000. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void (*glXGetProcAddressARB(const GLubyte* name))(void); /* as in every header of the time */

static PFNGLCOMBINERPARAMETERINVPROC p_glCombinerParameteriNV;
static PFNGLCOMBINERINPUTNVPROC p_glCombinerInputNV;
static PFNGLCOMBINEROUTPUTNVPROC p_glCombinerOutputNV;
static PFNGLFINALCOMBINERINPUTNVPROC p_glFinalCombinerInputNV;
#define glCombinerParameteriNV p_glCombinerParameteriNV
#define glCombinerInputNV p_glCombinerInputNV
#define glCombinerOutputNV p_glCombinerOutputNV
#define glFinalCombinerInputNV p_glFinalCombinerInputNV

static GLuint glsl_program;
static PFNGLUSEPROGRAMPROC p_glUseProgram;

static void quit(const char* text) {
  fprintf(stderr, "index_cube_2000: %s\n", text);
  exit(2);
}

static int has_extension(const char* name) {
  return strstr((const char*)glGetString(GL_EXTENSIONS), name) != NULL;
}

static void* address(const char* name) {
  return (void*)glXGetProcAddressARB((const GLubyte*)name);
}

/* With a shader from a file no combiners are needed. */
static void load_extensions(const char* glsl_file) {
  if (!has_extension("GL_ARB_texture_cube_map")) quit("GL_ARB_texture_cube_map is missing");
  if (glsl_file) return;
  if (!has_extension("GL_NV_register_combiners")) quit("GL_NV_register_combiners is missing");
  glCombinerParameteriNV = (PFNGLCOMBINERPARAMETERINVPROC)address("glCombinerParameteriNV");
  glCombinerInputNV = (PFNGLCOMBINERINPUTNVPROC)address("glCombinerInputNV");
  glCombinerOutputNV = (PFNGLCOMBINEROUTPUTNVPROC)address("glCombinerOutputNV");
  glFinalCombinerInputNV = (PFNGLFINALCOMBINERINPUTNVPROC)address("glFinalCombinerInputNV");
  if (!glCombinerParameteriNV || !glCombinerInputNV || !glCombinerOutputNV || !glFinalCombinerInputNV) {
    quit("an entry point of GL_NV_register_combiners is missing");
  }
}

/* A fragment shader that somebody wrote by hand. */
static void load_shader(const char* glsl_file) {
  static char text[8192];
  const GLchar* source = text;
  GLint linked = 0;
  GLuint shader;
  FILE* file = fopen(glsl_file, "r");
  if (!file) quit("the shader's file cannot be read");
  text[fread(text, 1, sizeof text - 1, file)] = 0;
  fclose(file);
  shader = ((PFNGLCREATESHADERPROC)address("glCreateShader"))(GL_FRAGMENT_SHADER);
  ((PFNGLSHADERSOURCEPROC)address("glShaderSource"))(shader, 1, &source, NULL);
  ((PFNGLCOMPILESHADERPROC)address("glCompileShader"))(shader);
  glsl_program = ((PFNGLCREATEPROGRAMPROC)address("glCreateProgram"))();
  ((PFNGLATTACHSHADERPROC)address("glAttachShader"))(glsl_program, shader);
  ((PFNGLLINKPROGRAMPROC)address("glLinkProgram"))(glsl_program);
  ((PFNGLGETPROGRAMIVPROC)address("glGetProgramiv"))(glsl_program, GL_LINK_STATUS, &linked);
  if (!linked) quit("the shader does not link");
  p_glUseProgram = (PFNGLUSEPROGRAMPROC)address("glUseProgram");
}
