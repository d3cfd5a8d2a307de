/* Draws with a vertex program and with a texture of indices: extensions. Prints the pixels and the errors, which do not
 * depend on the word length. */
#include <stdio.h>
#include <string.h>

#include "../egl_context.h"

static void print_pixel(const char* what) {
  GLubyte p[4];
  glReadPixels(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
  printf("%s: %d %d %d %d, error 0x%04x\n", what, p[0], p[1], p[2], p[3], glGetError());
}

static void draw_with_programs(void) {
  static const char program[] =
      "!!VP1.0 DP4 o[HPOS].x,c[0],v[OPOS]; DP4 o[HPOS].y,c[1],v[OPOS]; DP4 o[HPOS].z,c[2],v[OPOS];"
      "DP4 o[HPOS].w,c[3],v[OPOS]; MUL o[COL0],c[4],v[3]; END";
  static const char state_program[] = "!!VSP1.0 ADD c[4],c[4],v[0]; END";
  static const GLshort positions[] = {-1, -1, 1, -1, 1, 1, -1, 1};
  static const GLubyte colors[4][4] = {{255, 255, 0, 255}, {255, 255, 0, 255}, {255, 255, 0, 255}, {255, 255, 0, 255}};
  static const GLfloat added[4] = {0.2F, 0.2F, 0.2F, 0};
  LOOK_UP(PFNGLLOADPROGRAMNVPROC, LoadProgramNV);
  LOOK_UP(PFNGLBINDPROGRAMNVPROC, BindProgramNV);
  LOOK_UP(PFNGLTRACKMATRIXNVPROC, TrackMatrixNV);
  LOOK_UP(PFNGLPROGRAMPARAMETER4DNVPROC, ProgramParameter4dNV);
  LOOK_UP(PFNGLEXECUTEPROGRAMNVPROC, ExecuteProgramNV);
  LOOK_UP(PFNGLVERTEXATTRIBPOINTERNVPROC, VertexAttribPointerNV);
  LOOK_UP(PFNGLVERTEXATTRIB4DNVPROC, VertexAttrib4dNV);
  LoadProgramNV(GL_VERTEX_PROGRAM_NV, 1, (GLsizei)strlen(program), (const GLubyte*)program);
  LoadProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 2, (GLsizei)strlen(state_program), (const GLubyte*)state_program);
  BindProgramNV(GL_VERTEX_PROGRAM_NV, 1);
  TrackMatrixNV(GL_VERTEX_PROGRAM_NV, 0, GL_MODELVIEW_PROJECTION_NV, GL_IDENTITY_NV);
  ProgramParameter4dNV(GL_VERTEX_PROGRAM_NV, 4, 0.2, 0.4, 0.6, 1);
  glEnable(GL_VERTEX_PROGRAM_NV);
  VertexAttrib4dNV(3, 1, 1, 1, 1);
  glRecti(-1, -1, 1, 1);
  print_pixel("a vertex program");
  ExecuteProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 2, added);
  VertexAttribPointerNV(0, 2, GL_SHORT, 0, positions);
  VertexAttribPointerNV(3, 4, GL_UNSIGNED_BYTE, 0, colors);
  glEnableClientState(GL_VERTEX_ATTRIB_ARRAY0_NV);
  glEnableClientState(GL_VERTEX_ATTRIB_ARRAY3_NV);
  glDrawArrays(GL_QUADS, 0, 4);
  print_pixel("attribute arrays, after a state program");
  glDisable(GL_VERTEX_PROGRAM_NV);
}

static void draw_with_indices(void) {
  static const GLubyte indices[4 * 4] = {1, 1, 0, 0, 2, 2}; /* rows of two, each padded to four bytes */
  static const GLubyte palette[4][4] = {{1, 2, 3, 4}, {10, 20, 30, 40}, {50, 60, 70, 80}, {0, 0, 0, 0}};
  static const GLubyte other[4] = {90, 80, 70, 60};
  LOOK_UP(PFNGLCOLORTABLEEXTPROC, ColorTableEXT);
  LOOK_UP(PFNGLCOLORSUBTABLEEXTPROC, ColorSubTableEXT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 2, 2, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, indices);
  ColorTableEXT(GL_TEXTURE_2D, GL_RGBA8, 4, GL_RGBA, GL_UNSIGNED_BYTE, palette);
  glEnable(GL_TEXTURE_2D);
  glRecti(-1, -1, 1, 1);
  print_pixel("a texture of indices");
  ColorSubTableEXT(GL_TEXTURE_2D, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, other);
  glRecti(-1, -1, 1, 1);
  print_pixel("another colour in its palette");
}

int main(void) {
  if (!make_context(4)) return 77;
  draw_with_programs();
  draw_with_indices();
  return 0;
}
