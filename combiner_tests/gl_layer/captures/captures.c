/* Draws by combiners that read what varies from pixel to pixel: the secondary colour and the fog factor. captures MODE:
 * linear, exp2 or none, the mode of fog; tie, linear fog with the factor 0.7 alone; many, 1,400 draw calls of four pixels;
 * plain, without combiners; windows, two windows. The file captures.rgb gets the picture, 96 x 64, from below. */
#define GL_GLEXT_PROTOTYPES
#include <GL/freeglut.h>
#include <GL/glext.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 64 };

static const char *mode;

static int is(const char *name) { return !strcmp(mode, name); }

static void quad(void) {
  static const float corners[4][2] = {{-1, -1}, {0.9F, -0.8F}, {1, 1}, {-0.7F, 0.9F}};
  static const float colors[4][4] = {{1, 0, 0, 0.2F}, {0, 1, 0, 0.7F}, {0.1F, 0.3F, 1, 1}, {0.9F, 1, 0.6F, 0.5F}};
  static const float secondary[4][3] = {{0, 0, 0.6F}, {0.5F, 0.1F, 0}, {0, 0.7F, 0.2F}, {0.4F, 0.4F, 0.4F}};
  static const float depth[4] = {0.1F, 1.3F, 2.2F, 0.8F};
  glBegin(GL_TRIANGLE_FAN);
  for (int i = 0; i < 4; ++i) {
    glColor4fv(colors[i]);
    glSecondaryColor3fv(secondary[i]);
    glFogCoordf(is("tie") ? 0.3F : depth[i]);
    glVertex2fv(corners[i]);
  }
  glEnd();
}

static int window(void) {
  glutCreateWindow("captures");
  void (*input)(GLenum, GLenum, GLenum, GLenum) = (void (*)(GLenum, GLenum, GLenum, GLenum))glutGetProcAddress("glFinalCombinerInputNV");
  if (!input || !strstr((const char *)glGetString(GL_EXTENSIONS), "GL_NV_register_combiners")) return 2;
  /* fog.a * primary + (1 - fog.a) * fog + secondary, and the fog factor as alpha */
  input(GL_VARIABLE_A_NV, GL_FOG, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
  input(GL_VARIABLE_B_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  input(GL_VARIABLE_C_NV, GL_FOG, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  input(GL_VARIABLE_D_NV, GL_SECONDARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  input(GL_VARIABLE_G_NV, GL_FOG, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
  if (!is("plain")) glEnable(GL_REGISTER_COMBINERS_NV);
  glEnable(GL_COLOR_SUM);
  glFogi(GL_FOG_COORD_SRC, GL_FOG_COORD);
  glFogi(GL_FOG_MODE, is("exp2") ? GL_EXP2 : GL_LINEAR);
  glFogf(GL_FOG_START, 0);
  glFogf(GL_FOG_END, is("tie") ? 1 : 2.3F);
  glFogf(GL_FOG_DENSITY, 0.6F);
  glFogfv(GL_FOG_COLOR, (const float[]){0.3F, 0.5F, 0.7F, 1});
  (is("none") ? glDisable : glEnable)(GL_FOG);
  (is("many") ? glEnable : glDisable)(GL_SCISSOR_TEST);
  glScissor(0, 0, 2, 2);
  for (int frame = 0; frame < 2; ++frame) {
    glClear(GL_COLOR_BUFFER_BIT);
    for (int calls = is("many") ? 1400 : 1; calls > 0; --calls) quad();
    static unsigned char pixels[WIDTH * HEIGHT * 3];
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, pixels);
    FILE *file = fopen("captures.rgb", "wb");
    if (!file || fwrite(pixels, sizeof pixels, 1, file) != 1 || fclose(file)) return 3;
    glutSwapBuffers();
  }
  return glGetError() ? 1 : 0;
}

int main(int argc, char **argv) {
  mode = argc > 1 ? argv[1] : "";
  glutInit(&argc, argv);
  glutInitDisplayMode(GLUT_RGBA | GLUT_ALPHA | GLUT_DOUBLE);
  glutInitWindowSize(WIDTH, HEIGHT);
  const int fault = window();
  return fault || !is("windows") ? fault : window();
}
