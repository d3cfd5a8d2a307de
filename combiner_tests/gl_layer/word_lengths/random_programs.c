/* Random programs for the register combiners, each on 256 fragments: random_programs COUNT. Prints a line a program, with
 * the hash of its picture and the error, which do not depend on the word length. Two textures of random bytes differ
 * from fragment to fragment; the colours are flat, since drivers may interpolate in another way. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "../egl_context.h"

enum { SIDE = 16, COLORS = 4, STAGES = 2 };

static uint64_t state;

/* From 0 to end - 1: the high bits of Knuth's generator. */
static int below(int end) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (int)((state >> 33) % (uint64_t)end);
}

static GLenum one_of(const GLenum* words, int count) {
  return words[below(count)];
}
#define ONE_OF(words) one_of(words, (int)(sizeof(words) / sizeof *(words)))

static const GLenum registers[] = {GL_ZERO,     GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV, GL_FOG,
                                   GL_TEXTURE0, GL_TEXTURE1,           GL_PRIMARY_COLOR_NV,   GL_SECONDARY_COLOR_NV,
                                   GL_SPARE0_NV, GL_SPARE1_NV};
static const GLenum written[] = {GL_DISCARD_NV, GL_TEXTURE0,  GL_TEXTURE1, GL_PRIMARY_COLOR_NV, GL_SECONDARY_COLOR_NV,
                                 GL_SPARE0_NV,  GL_SPARE1_NV};
static const GLenum mappings[] = {GL_UNSIGNED_IDENTITY_NV, GL_UNSIGNED_INVERT_NV,  GL_EXPAND_NORMAL_NV,
                                  GL_EXPAND_NEGATE_NV,     GL_HALF_BIAS_NORMAL_NV, GL_HALF_BIAS_NEGATE_NV,
                                  GL_SIGNED_IDENTITY_NV,   GL_SIGNED_NEGATE_NV};
static const GLenum scales[] = {GL_NONE, GL_SCALE_BY_TWO_NV, GL_SCALE_BY_FOUR_NV, GL_SCALE_BY_ONE_HALF_NV};

/* Not that of the other two outputs, but for GL_DISCARD_NV. */
static GLenum output_beside(GLenum one, GLenum other) {
  for (;;) {
    const GLenum reg = ONE_OF(written);
    if (reg == GL_DISCARD_NV || (reg != one && reg != other)) return reg;
  }
}

static void set_general(GLenum stage, GLenum portion) {
  LOOK_UP(PFNGLCOMBINERINPUTNVPROC, CombinerInputNV);
  LOOK_UP(PFNGLCOMBINEROUTPUTNVPROC, CombinerOutputNV);
  for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_D_NV; ++variable) {
    const GLenum reg = ONE_OF(registers);
    const GLenum own = portion == GL_RGB ? GL_RGB : GL_BLUE;
    /* General combiners cannot read the alpha of the fog register. */
    const GLenum usage = reg == GL_FOG || below(2) ? own : GL_ALPHA;
    CombinerInputNV(stage, portion, variable, reg, ONE_OF(mappings), usage);
  }
  const GLboolean ab_dot = portion == GL_RGB && below(4) == 0, cd_dot = portion == GL_RGB && below(4) == 0;
  const GLenum ab = ONE_OF(written), cd = output_beside(ab, ab);
  const GLenum sum = ab_dot || cd_dot ? GL_DISCARD_NV : output_beside(ab, cd);
  const GLenum scale = ONE_OF(scales);
  const int has_bias = (scale == GL_NONE || scale == GL_SCALE_BY_TWO_NV) && below(2);
  CombinerOutputNV(stage, portion, ab, cd, sum, scale, has_bias ? GL_BIAS_BY_NEGATIVE_ONE_HALF_NV : GL_NONE, ab_dot,
                   cd_dot, (GLboolean)below(2));
}

static void set_final(void) {
  LOOK_UP(PFNGLFINALCOMBINERINPUTNVPROC, FinalCombinerInputNV);
  for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_G_NV; ++variable) {
    GLenum reg = ONE_OF(registers);
    GLenum usage = below(2) ? GL_ALPHA : variable == GL_VARIABLE_G_NV ? GL_BLUE : GL_RGB;
    if (variable <= GL_VARIABLE_D_NV && below(4) == 0) {
      reg = variable == GL_VARIABLE_A_NV || below(2) ? GL_E_TIMES_F_NV : GL_SPARE0_PLUS_SECONDARY_COLOR_NV;
      usage = GL_RGB;
    }
    FinalCombinerInputNV(variable, reg, below(2) ? GL_UNSIGNED_IDENTITY_NV : GL_UNSIGNED_INVERT_NV, usage);
  }
}

static void random_bytes(GLubyte* bytes, int count) {
  for (int i = 0; i < count; ++i) bytes[i] = (GLubyte)below(256);
}

static void random_color(GLfloat* color) {
  for (int i = 0; i < COLORS; ++i) color[i] = (GLfloat)below(256) / 255;
}

static void set_program(void) {
  LOOK_UP(PFNGLCOMBINERPARAMETERINVPROC, CombinerParameteriNV);
  LOOK_UP(PFNGLCOMBINERPARAMETERFVNVPROC, CombinerParameterfvNV);
  GLfloat color[COLORS];
  const int stages = 1 + below(STAGES);
  CombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, stages);
  CombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, below(2));
  for (GLenum name = GL_CONSTANT_COLOR0_NV; name <= GL_CONSTANT_COLOR1_NV; ++name) {
    random_color(color);
    CombinerParameterfvNV(name, color);
  }
  for (int stage = 0; stage < stages; ++stage) {
    set_general(GL_COMBINER0_NV + (GLenum)stage, GL_RGB);
    set_general(GL_COMBINER0_NV + (GLenum)stage, GL_ALPHA);
  }
  set_final();
}

static void set_inputs(void) {
  LOOK_UP(PFNGLSECONDARYCOLOR3FVPROC, SecondaryColor3fv);
  GLubyte texels[4 * SIDE * SIDE];
  GLfloat color[COLORS];
  for (GLenum unit = GL_TEXTURE0; unit <= GL_TEXTURE1; ++unit) {
    glActiveTexture(unit);
    random_bytes(texels, sizeof texels);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  }
  random_color(color);
  glColor4fv(color);
  random_color(color);
  SecondaryColor3fv(color);
  random_color(color);
  glFogfv(GL_FOG_COLOR, color);
}

static void make_textures(void) {
  GLuint names[2];
  glGenTextures(2, names);
  for (int unit = 0; unit < 2; ++unit) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, names[unit]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glEnable(GL_TEXTURE_2D);
  }
}

static void draw(void) {
  glBegin(GL_QUADS);
  for (int corner = 0; corner < 4; ++corner) {
    const GLfloat x = corner == 1 || corner == 2, y = corner >= 2;
    glMultiTexCoord2f(GL_TEXTURE0, x, y);
    glMultiTexCoord2f(GL_TEXTURE1, x, y);
    glVertex2f(2 * x - 1, 2 * y - 1);
  }
  glEnd();
}

int main(int argc, char** argv) {
  GLubyte pixels[4 * SIDE * SIDE];
  const int count = argc > 1 ? atoi(argv[1]) : 1;
  if (!make_context(SIDE)) return 77;
  make_textures();
  glEnable(GL_REGISTER_COMBINERS_NV);
  for (int i = 0; i < count; ++i) {
    uint32_t hash = 2166136261u; /* FNV-1a */
    state = (uint64_t)i;
    set_program();
    set_inputs();
    draw();
    glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (size_t k = 0; k < sizeof pixels; ++k) hash = (hash ^ pixels[k]) * 16777619u;
    printf("%d: %08x, error 0x%04x\n", i, (unsigned)hash, glGetError());
  }
  return 0;
}
