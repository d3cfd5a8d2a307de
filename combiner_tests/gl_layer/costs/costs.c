/* The processor's time of many small draws, each after one change: costs fixed | glsl | combiners | stages. It prints
 * nanoseconds a draw, the best of some rounds. Nothing is drawn: all triangles are outside of the window. */
#define GL_GLEXT_PROTOTYPES
#include <GL/freeglut.h>
#include <GL/glext.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { TEXTURES = 8, LEVELS = 7, DRAWS = 5000, ROUNDS = 6 };
static GLuint textures[TEXTURES], programs[2];
static int has_combiners;

static PFNGLCOMBINERPARAMETERFVNVPROC set_parameter;
static PFNGLCOMBINERPARAMETERINVPROC set_number;
static PFNGLCOMBINERINPUTNVPROC set_input;

static double nanoseconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static void nothing(int i) { (void)i; }
static void texture(int i) { glBindTexture(GL_TEXTURE_2D, textures[i % TEXTURES]); }
static void blending(int i) { (i % 2 ? glEnable : glDisable)(GL_BLEND); }
static void fog_color(int i) {
  const GLfloat color[] = {(GLfloat)i / DRAWS, 0, 0, 1};
  glFogfv(GL_FOG_COLOR, color);
}
static void fog(int i) { (i % 2 ? glEnable : glDisable)(GL_FOG); }
static void constant(int i) {
  const GLfloat color[] = {(GLfloat)i / DRAWS, 0, 0, 1};
  if (has_combiners) set_parameter(GL_CONSTANT_COLOR0_NV, color);
  else if (programs[0]) glUniform4fv(glGetUniformLocation(programs[0], "constant"), 1, color);
}
static void program(int i) {
  if (has_combiners) {
    set_input(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, i % 2 ? GL_PRIMARY_COLOR_NV : GL_TEXTURE0_ARB,
              GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  } else if (programs[0]) {
    glUseProgram(programs[i % 2]);
  }
}

static const struct {
  const char *name;
  void (*change)(int);
} changes[] = {{"nothing", nothing},     {"blending", blending}, {"texture", texture}, {"constant", constant},
               {"fog colour", fog_color}, {"fog", fog},           {"program", program}};

static void make_textures(void) {
  static const GLubyte white[4 * 64 * 64];
  glGenTextures(TEXTURES, textures);
  for (int i = 0; i < TEXTURES; ++i) {
    glBindTexture(GL_TEXTURE_2D, textures[i]);
    for (int level = 0; level < LEVELS; ++level) {
      glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, 64 >> level, 64 >> level, 0, GL_RGBA, GL_UNSIGNED_BYTE, white);
    }
  }
  for (int unit = 3; unit >= 0; --unit) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, textures[unit]);
    glEnable(GL_TEXTURE_2D);
  }
}

static void make_programs(void) {
  for (int i = 0; i < 2; ++i) {
    char text[600];
    snprintf(text, sizeof text,
             "uniform sampler2D t0, t1, t2, t3; uniform vec4 constant;\nvoid main() {\n"
             "  gl_FragColor = texture2D(t0, gl_TexCoord[0].st) * texture2D(t1, gl_TexCoord[1].st) +\n"
             "                 texture2D(t2, gl_TexCoord[2].st) * texture2D(t3, gl_TexCoord[3].st) %c constant;\n}\n",
             i ? '*' : '+');
    const GLchar *const source = text;
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    programs[i] = glCreateProgram();
    glAttachShader(programs[i], shader);
    glLinkProgram(programs[i]);
    glUseProgram(programs[i]);
    for (int unit = 0; unit < 4; ++unit) {
      const char name[] = {'t', (char)('0' + unit), '\0'};
      glUniform1i(glGetUniformLocation(programs[i], name), unit);
    }
  }
  glUseProgram(programs[0]);
}

/* Eight general combiners that read four textures and a constant; with texture shaders, if asked for. */
static void set_combiners(int with_stages) {
  has_combiners = 1;
  set_parameter = (PFNGLCOMBINERPARAMETERFVNVPROC)glutGetProcAddress("glCombinerParameterfvNV");
  set_number = (PFNGLCOMBINERPARAMETERINVPROC)glutGetProcAddress("glCombinerParameteriNV");
  set_input = (PFNGLCOMBINERINPUTNVPROC)glutGetProcAddress("glCombinerInputNV");
  set_number(GL_NUM_GENERAL_COMBINERS_NV, 8);
  for (GLenum stage = 0; stage < 8; ++stage) {
    for (int portion = 0; portion < 2; ++portion) {
      const GLenum of = portion ? GL_ALPHA : GL_RGB, name = GL_COMBINER0_NV + stage;
      set_input(name, of, GL_VARIABLE_A_NV, stage ? GL_SPARE0_NV : GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, of);
      set_input(name, of, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB + stage % 4, GL_UNSIGNED_IDENTITY_NV, of);
      set_input(name, of, GL_VARIABLE_C_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV, of);
      set_input(name, of, GL_VARIABLE_D_NV, GL_CONSTANT_COLOR1_NV, GL_UNSIGNED_IDENTITY_NV, of);
    }
  }
  for (GLenum unit = 0; with_stages && unit < 4; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  }
  glActiveTexture(GL_TEXTURE0);
  if (with_stages) glEnable(GL_TEXTURE_SHADER_NV);
  glEnable(GL_REGISTER_COMBINERS_NV);
}

static double measure(void (*change)(int)) {
  double best = 1e12;
  for (int round = 0; round < ROUNDS; ++round) {
    for (int i = 0; i < 20; ++i) change(i), glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    const double begin = nanoseconds();
    for (int i = 0; i < DRAWS; ++i) change(i), glDrawArrays(GL_TRIANGLES, 0, 3);
    const double taken = (nanoseconds() - begin) / DRAWS;
    if (taken < best) best = taken;
    glFinish();
  }
  glDisable(GL_FOG);
  glDisable(GL_BLEND);
  return best;
}

int main(int argc, char **argv) {
  const char *mode = argc > 1 ? argv[1] : "";
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE);
  glutCreateWindow("costs");
  static const GLfloat outside[] = {2, 2, 2, 3, 3, 2};
  glVertexPointer(2, GL_FLOAT, 0, outside);
  glEnableClientState(GL_VERTEX_ARRAY);
  make_textures();
  if (!strcmp(mode, "glsl")) make_programs();
  if (!strcmp(mode, "combiners") || !strcmp(mode, "stages")) set_combiners(!strcmp(mode, "stages"));
  for (size_t i = 0; i < sizeof changes / sizeof *changes; ++i) {
    printf("%s: %.0f\n", changes[i].name, measure(changes[i].change));
  }
  const GLenum error = glGetError();
  if (error) printf("error 0x%04x\n", error);
  return error ? 1 : 0;
}
