// The forms of glUniform and glProgramUniform: S(form, parameters, arguments) has values, V(form, type, size) an array
// of so many numbers an element, M(form, type, size) matrices.
#pragma once

// clang-format off
#define NINEBIT_UNIFORM_SCALARS(S, t, T) \
  S(1##t, (GLint at, T a), (at, a)) S(2##t, (GLint at, T a, T b), (at, a, b)) \
  S(3##t, (GLint at, T a, T b, T c), (at, a, b, c)) S(4##t, (GLint at, T a, T b, T c, T d), (at, a, b, c, d))
#define NINEBIT_UNIFORM_VECTORS(V, t, T) V(1##t##v, T, 1) V(2##t##v, T, 2) V(3##t##v, T, 3) V(4##t##v, T, 4)
#define NINEBIT_UNIFORM_OBLONG(M, t, T) \
  M(Matrix2x3##t##v, T, 6) M(Matrix3x2##t##v, T, 6) M(Matrix2x4##t##v, T, 8) M(Matrix4x2##t##v, T, 8) \
  M(Matrix3x4##t##v, T, 12) M(Matrix4x3##t##v, T, 12)
#define NINEBIT_UNIFORM_SQUARE(M, t, T) M(Matrix2##t##v, T, 4) M(Matrix3##t##v, T, 9) M(Matrix4##t##v, T, 16)

// Those that ARB_shader_objects has, too, and the later ones.
#define NINEBIT_FIRST_UNIFORMS(S, V, M) \
  NINEBIT_UNIFORM_SCALARS(S, f, GLfloat) NINEBIT_UNIFORM_SCALARS(S, i, GLint) NINEBIT_UNIFORM_VECTORS(V, f, GLfloat) \
  NINEBIT_UNIFORM_VECTORS(V, i, GLint) NINEBIT_UNIFORM_SQUARE(M, f, GLfloat)
#define NINEBIT_LATER_UNIFORMS(S, V, M) \
  NINEBIT_UNIFORM_SCALARS(S, ui, GLuint) NINEBIT_UNIFORM_SCALARS(S, d, GLdouble) NINEBIT_UNIFORM_VECTORS(V, ui, GLuint) \
  NINEBIT_UNIFORM_VECTORS(V, d, GLdouble) NINEBIT_UNIFORM_SQUARE(M, d, GLdouble) \
  NINEBIT_UNIFORM_OBLONG(M, f, GLfloat) NINEBIT_UNIFORM_OBLONG(M, d, GLdouble)
// clang-format on
