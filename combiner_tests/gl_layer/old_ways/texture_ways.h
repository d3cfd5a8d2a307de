/* The ways to draw with textures and fog. GL_REPLACE: the picture is texture 0 alone. */
#include "ways.h"

static GLubyte texels[32][32][4];

static void make_texels(void) {
  int i;
  srand(2000);
  for (i = 0; i < 32 * 32 * 4; ++i) (&texels[0][0][0])[i] = (GLubyte)(i % 4 == 3 ? 64 + rand() % 192 : rand());
}

static void use_texture(GLenum target) {
  glBindTexture(target, 10 + target % 97);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  if (target == GL_TEXTURE_1D)
    glTexImage1D(target, 0, GL_RGBA8, 256, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  else
    glTexImage2D(target, 0, GL_RGBA8, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glEnable(target);
}

static void texture_1d(void) {
  use_texture(GL_TEXTURE_1D);
  immediate();
}
static void texture_2d(void) {
  use_texture(GL_TEXTURE_2D);
  immediate();
}

static void texture_rectangle(void) {
  use_texture(GL_TEXTURE_RECTANGLE_ARB);
  glMatrixMode(GL_TEXTURE);
  glPushMatrix();
  glScalef(32, 32, 1);
  immediate();
  glPopMatrix();
}

static void sphere_map(void) {
  use_texture(GL_TEXTURE_2D);
  glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
  glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
  glEnable(GL_TEXTURE_GEN_S);
  glEnable(GL_TEXTURE_GEN_T);
  teapot();
}

static void copied(void) {
  use_texture(GL_TEXTURE_2D);
  glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 0, 0, 32, 32, 0);
  use_texture(GL_TEXTURE_2D);
  glPushMatrix();
  glRotatef(40, 0, 0, 1);
  strips();
  glPopMatrix();
}

/* Fog and a highlight of its own, as fixed function mixes them: so do combiners in their default state. */
static void highlight(void) {
  static const GLfloat shine[4] = {0.6f, 0.5f, 0.4f, 1};
  glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, shine);
  glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 20);
  teapot();
}

static void fog(void) {
  static const GLfloat color[4] = {0.7f, 0.2f, 0.4f, 1};
  glEnable(GL_FOG);
  glFogi(GL_FOG_MODE, GL_LINEAR);
  glFogf(GL_FOG_START, -0.4f);
  glFogf(GL_FOG_END, 0.6f);
  glFogfv(GL_FOG_COLOR, color);
  highlight();
}
