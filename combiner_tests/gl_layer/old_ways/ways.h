/* The ways to draw vertices. A way leaves the state to glPopAttrib; pixels that it draws have an alpha above 0. */
/* A grid of 8 x 8 points with smooth colours. */
enum { GRID = 8, POINTS = GRID * GRID, QUADS = (GRID - 1) * (GRID - 1) };
static GLfloat positions[POINTS][3];
static GLubyte colors[POINTS][4];
static GLushort corners[QUADS * 4];
static GLfloat interleaved[POINTS][10]; /* GL_C4F_N3F_V3F */

static void make_grid(void) {
  int x, y, n = 0;
  for (y = 0; y < GRID; ++y) {
    for (x = 0; x < GRID; ++x) {
      int i = y * GRID + x;
      GLfloat color[4] = {x / 7.0f, y / 7.0f, (x * y % 5) / 4.0f, 0.5f + 0.05f * ((x + y) % 8)};
      GLfloat p[3] = {-0.9f + 1.8f * x / (GRID - 1), -0.9f + 1.8f * y / (GRID - 1), 0.02f * (x - y)};
      int c;
      for (c = 0; c < 3; ++c) positions[i][c] = interleaved[i][7 + c] = p[c];
      for (c = 0; c < 4; ++c) {
        colors[i][c] = (GLubyte)(color[c] * 255.0f + 0.5f);
        interleaved[i][c] = color[c];
      }
      interleaved[i][6] = 1;
      if (x + 1 < GRID && y + 1 < GRID) {
        corners[n++] = (GLushort)i;
        corners[n++] = (GLushort)(i + 1);
        corners[n++] = (GLushort)(i + GRID + 1);
        corners[n++] = (GLushort)(i + GRID);
      }
    }
  }
}

static void point(int i) {
  glColor4ubv(colors[i]);
  glTexCoord2f(positions[i][0] * 0.5f + 0.5f, positions[i][1] * 0.5f + 0.5f);
  glVertex3fv(positions[i]);
}

static void draw_primitives(GLenum mode, int count) {
  int i;
  glBegin(mode);
  for (i = 0; i < count; ++i) point(corners[i]);
  glEnd();
}

static void immediate(void) {
  draw_primitives(GL_QUADS, QUADS * 4);
}
static void flat(void) {
  glShadeModel(GL_FLAT);
  immediate();
}
static void triangles(void) {
  draw_primitives(GL_TRIANGLES, QUADS * 4 / 3 * 3);
}
static void wire(void) {
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  immediate();
}
static void dots(void) {
  glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
  glPointSize(5);
  immediate();
}
static void thick_lines(void) {
  glLineWidth(3);
  draw_primitives(GL_LINE_STRIP, QUADS * 4);
}
static void stippled(void) {
  glEnable(GL_LINE_STIPPLE);
  glLineStipple(2, 0x5A5A);
  draw_primitives(GL_LINES, QUADS * 4);
}
static void points(void) {
  glPointSize(7);
  draw_primitives(GL_POINTS, QUADS * 4);
}

static void strips(void) {
  int x, y;
  for (y = 0; y + 1 < GRID; ++y) {
    glBegin(y % 2 ? GL_QUAD_STRIP : GL_TRIANGLE_STRIP);
    for (x = 0; x < GRID; ++x) {
      point(y * GRID + x);
      point((y + 1) * GRID + x);
    }
    glEnd();
  }
}

static void polygons(void) {
  glBegin(GL_POLYGON);
  point(0), point(GRID - 1), point(POINTS - 1), point(POINTS - GRID);
  glEnd();
  glBegin(GL_TRIANGLE_FAN);
  point(27), point(0), point(7), point(63);
  glEnd();
}

static void rectangles(void) {
  glColor4ub(10, 200, 99, 255);
  glRectf(-0.8f, -0.8f, 0.1f, 0.3f);
  glColor4ub(255, 1, 128, 77);
  glRecti(0, 0, 1, 1);
}

static void use_arrays(const void* p, const void* c) {
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, 0, p);
  glColorPointer(4, GL_UNSIGNED_BYTE, 0, c);
}

static void array_elements(void) {
  int i;
  use_arrays(positions, colors);
  glBegin(GL_QUADS);
  for (i = 0; i < QUADS * 4; ++i) glArrayElement(corners[i]);
  glEnd();
}

static void draw_arrays(void) {
  use_arrays(positions, colors);
  glDrawArrays(GL_TRIANGLE_STRIP, 3, POINTS - 3);
}
static void elements(void) {
  use_arrays(positions, colors);
  glDrawElements(GL_QUADS, QUADS * 4, GL_UNSIGNED_SHORT, corners);
}

static void range_elements(void) {
  use_arrays(positions, colors);
  p_glDrawRangeElementsEXT(GL_QUADS, 0, POINTS - 1, QUADS * 4, GL_UNSIGNED_SHORT, corners);
}

static void multi_arrays(void) {
  static const GLint first[3] = {0, 16, 40};
  static const GLsizei count[3] = {12, 20, 24};
  use_arrays(positions, colors);
  p_glMultiDrawArraysEXT(GL_TRIANGLES, first, count, 3);
}

static void multi_elements(void) {
  static const GLsizei count[2] = {40, 60};
  const GLvoid* starts[2];
  starts[0] = corners;
  starts[1] = corners + 100;
  use_arrays(positions, colors);
  p_glMultiDrawElementsEXT(GL_QUADS, count, GL_UNSIGNED_SHORT, starts, 2);
}

static void interleaved_arrays(void) {
  glInterleavedArrays(GL_C4F_N3F_V3F, 0, interleaved);
  glDrawElements(GL_QUADS, QUADS * 4, GL_UNSIGNED_SHORT, corners);
}

static void buffers(void) {
  p_glBindBufferARB(GL_ARRAY_BUFFER_ARB, 1);
  p_glBufferDataARB(GL_ARRAY_BUFFER_ARB, sizeof positions, positions, GL_STATIC_DRAW_ARB);
  glEnableClientState(GL_VERTEX_ARRAY);
  glVertexPointer(3, GL_FLOAT, 0, NULL);
  p_glBindBufferARB(GL_ARRAY_BUFFER_ARB, 2);
  p_glBufferDataARB(GL_ARRAY_BUFFER_ARB, sizeof colors, colors, GL_STATIC_DRAW_ARB);
  glEnableClientState(GL_COLOR_ARRAY);
  glColorPointer(4, GL_UNSIGNED_BYTE, 0, NULL);
  p_glBindBufferARB(GL_ARRAY_BUFFER_ARB, 0);
  glDrawElements(GL_QUADS, QUADS * 4, GL_UNSIGNED_SHORT, corners);
}

static void lists(void) {
  GLuint first = glGenLists(3);
  static const GLubyte both[2] = {0, 1};
  glNewList(first, GL_COMPILE);
  draw_primitives(GL_QUADS, 100);
  glEndList();
  glNewList(first + 1, GL_COMPILE);
  glPushMatrix();
  glScalef(0.5f, 0.5f, 1);
  draw_primitives(GL_TRIANGLES, 90);
  glPopMatrix();
  glEndList();
  glNewList(first + 2, GL_COMPILE_AND_EXECUTE);
  glListBase(first);
  glCallLists(2, GL_UNSIGNED_BYTE, both);
  glEndList();
  glDeleteLists(first, 3);
}

static void evaluators(void) {
  static const GLfloat surface[2][2][3] = {{{-0.9f, -0.9f, 0}, {0.9f, -0.7f, 0.2f}},
                                           {{-0.7f, 0.9f, 0}, {0.8f, 0.8f, -0.2f}}};
  static const GLfloat color[2][2][4] = {{{1, 0, 0, 1}, {0, 1, 0, 1}}, {{0, 0, 1, 1}, {1, 1, 0, 0.5f}}};
  glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, &surface[0][0][0]);
  glMap2f(GL_MAP2_COLOR_4, 0, 1, 4, 2, 0, 1, 8, 2, &color[0][0][0]);
  glEnable(GL_MAP2_VERTEX_3);
  glEnable(GL_MAP2_COLOR_4);
  glMapGrid2f(6, 0, 1, 5, 0, 1);
  glEvalMesh2(GL_FILL, 0, 6, 0, 5);
}

static void light(void) {
  static const GLfloat position[4] = {1, 1, -2, 0}, diffuse[4] = {0.9f, 0.8f, 0.6f, 1};
  glMatrixMode(GL_MODELVIEW);
  glPushMatrix();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glLightfv(GL_LIGHT0, GL_POSITION, position);
  glLightfv(GL_LIGHT0, GL_DIFFUSE, diffuse);
  glRotatef(30, 1, 1, 0);
}

static void teapot(void) {
  light();
  glutSolidTeapot(0.6);
  glPopMatrix();
}
static void quadric(void) {
  GLUquadric* q = gluNewQuadric();
  light();
  gluSphere(q, 0.8, 20, 12);
  glPopMatrix();
  gluDeleteQuadric(q);
}

static void two_sided(void) {
  static const GLfloat back[4] = {0.1f, 0.3f, 0.9f, 0.6f};
  static const GLdouble plane[4] = {0, 0, -1, 0.1};
  light();
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
  glMaterialfv(GL_BACK, GL_DIFFUSE, back);
  glClipPlane(GL_CLIP_PLANE0, plane);
  glEnable(GL_CLIP_PLANE0);
  glutSolidTorus(0.25, 0.5, 16, 24);
  glPopMatrix();
}

static void bitmaps(void) {
  const char* text = "NV10";
  glColor4ub(200, 100, 50, 255);
  glRasterPos2f(-0.9f, 0);
  while (*text) glutBitmapCharacter(GLUT_BITMAP_TIMES_ROMAN_24, *text++);
}

static void draw_pixels(void) {
  static GLubyte pixels[64][64][4];
  int x, y;
  for (y = 0; y < 64; ++y) {
    for (x = 0; x < 64; ++x)
      pixels[y][x][0] = (GLubyte)(4 * x), pixels[y][x][1] = (GLubyte)(4 * y), pixels[y][x][3] = 255;
  }
  glRasterPos2f(-0.5f, -0.5f);
  glDrawPixels(64, 64, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}
