// Commands with the name of a GLSL program. One of the layer's own programs is none to the program that runs, which
// never got its name: the driver answers as it does for a name that it has not given out.
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

#define NINEBIT_PROGRAM_CALL(result, name, parameters, arguments)     \
  GLAPI result GLAPIENTRY gl##name parameters {                       \
    const auto call = find_driver().name;                             \
    return call != nullptr ? call arguments : static_cast<result>(0); \
  }

NINEBIT_PROGRAM_CALL(void, AttachShader, (GLuint program, GLuint shader), (visible_program(program), shader))
NINEBIT_PROGRAM_CALL(void, BindAttribLocation, (GLuint program, GLuint index, const GLchar* name),
                     (visible_program(program), index, name))
NINEBIT_PROGRAM_CALL(void, DeleteObjectARB, (GLhandleARB object), (visible_program(object)))
NINEBIT_PROGRAM_CALL(void, DeleteProgram, (GLuint program), (visible_program(program)))
NINEBIT_PROGRAM_CALL(void, DetachShader, (GLuint program, GLuint shader), (visible_program(program), shader))
NINEBIT_PROGRAM_CALL(void, GetActiveAttrib,
                     (GLuint program, GLuint index, GLsizei size, GLsizei* length, GLint* number, GLenum* type,
                      GLchar* name),
                     (visible_program(program), index, size, length, number, type, name))
NINEBIT_PROGRAM_CALL(void, GetActiveUniform,
                     (GLuint program, GLuint index, GLsizei size, GLsizei* length, GLint* number, GLenum* type,
                      GLchar* name),
                     (visible_program(program), index, size, length, number, type, name))
NINEBIT_PROGRAM_CALL(void, GetAttachedShaders, (GLuint program, GLsizei most, GLsizei* count, GLuint* shaders),
                     (visible_program(program), most, count, shaders))
NINEBIT_PROGRAM_CALL(GLint, GetAttribLocation, (GLuint program, const GLchar* name), (visible_program(program), name))
NINEBIT_PROGRAM_CALL(void, GetInfoLogARB, (GLhandleARB object, GLsizei size, GLsizei* length, GLcharARB* log),
                     (visible_program(object), size, length, log))
NINEBIT_PROGRAM_CALL(void, GetObjectParameterivARB, (GLhandleARB object, GLenum pname, GLint* params),
                     (visible_program(object), pname, params))
NINEBIT_PROGRAM_CALL(void, GetProgramInfoLog, (GLuint program, GLsizei size, GLsizei* length, GLchar* log),
                     (visible_program(program), size, length, log))
NINEBIT_PROGRAM_CALL(void, GetProgramiv, (GLuint program, GLenum pname, GLint* params),
                     (visible_program(program), pname, params))
NINEBIT_PROGRAM_CALL(void, GetUniformfv, (GLuint program, GLint location, GLfloat* params),
                     (visible_program(program), location, params))
NINEBIT_PROGRAM_CALL(void, GetUniformiv, (GLuint program, GLint location, GLint* params),
                     (visible_program(program), location, params))
NINEBIT_PROGRAM_CALL(GLint, GetUniformLocation, (GLuint program, const GLchar* name), (visible_program(program), name))
NINEBIT_PROGRAM_CALL(GLboolean, IsProgram, (GLuint program), (visible_program(program)))
NINEBIT_PROGRAM_CALL(void, LinkProgram, (GLuint program), (visible_program(program)))
NINEBIT_PROGRAM_CALL(void, ValidateProgram, (GLuint program), (visible_program(program)))
