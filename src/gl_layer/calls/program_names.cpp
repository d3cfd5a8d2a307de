// Commands with the name of a GLSL program. One of the layer's own programs is none to the program that runs, which
// never got its name: the driver answers as it does for a name that it has not given out.
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/symbols.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

#define NINEBIT_PROGRAM_CALL(result, name, parameters, arguments)                 \
  GLAPI result GLAPIENTRY gl##name parameters {                                   \
    static const auto next = next_function_as<decltype(&::gl##name)>("gl" #name); \
    return next != nullptr ? next arguments : static_cast<result>(0);             \
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

// Those of later versions.
NINEBIT_PROGRAM_CALL(void, ActiveShaderProgram, (GLuint pipeline, GLuint program), (pipeline, visible_program(program)))
NINEBIT_PROGRAM_CALL(void, BindFragDataLocation, (GLuint program, GLuint color, const GLchar* name),
                     (visible_program(program), color, name))
NINEBIT_PROGRAM_CALL(void, BindFragDataLocationIndexed,
                     (GLuint program, GLuint color_number, GLuint index, const GLchar* name),
                     (visible_program(program), color_number, index, name))
NINEBIT_PROGRAM_CALL(void, GetActiveAtomicCounterBufferiv,
                     (GLuint program, GLuint buffer_index, GLenum pname, GLint* params),
                     (visible_program(program), buffer_index, pname, params))
NINEBIT_PROGRAM_CALL(void, GetActiveSubroutineName,
                     (GLuint program, GLenum shadertype, GLuint index, GLsizei buf_size, GLsizei* length, GLchar* name),
                     (visible_program(program), shadertype, index, buf_size, length, name))
NINEBIT_PROGRAM_CALL(void, GetActiveSubroutineUniformName,
                     (GLuint program, GLenum shadertype, GLuint index, GLsizei buf_size, GLsizei* length, GLchar* name),
                     (visible_program(program), shadertype, index, buf_size, length, name))
NINEBIT_PROGRAM_CALL(void, GetActiveSubroutineUniformiv,
                     (GLuint program, GLenum shadertype, GLuint index, GLenum pname, GLint* values),
                     (visible_program(program), shadertype, index, pname, values))
NINEBIT_PROGRAM_CALL(void, GetActiveUniformBlockName,
                     (GLuint program, GLuint uniform_block_index, GLsizei buf_size, GLsizei* length,
                      GLchar* uniform_block_name),
                     (visible_program(program), uniform_block_index, buf_size, length, uniform_block_name))
NINEBIT_PROGRAM_CALL(void, GetActiveUniformBlockiv,
                     (GLuint program, GLuint uniform_block_index, GLenum pname, GLint* params),
                     (visible_program(program), uniform_block_index, pname, params))
NINEBIT_PROGRAM_CALL(void, GetActiveUniformName,
                     (GLuint program, GLuint uniform_index, GLsizei buf_size, GLsizei* length, GLchar* uniform_name),
                     (visible_program(program), uniform_index, buf_size, length, uniform_name))
NINEBIT_PROGRAM_CALL(void, GetActiveUniformsiv,
                     (GLuint program, GLsizei uniform_count, const GLuint* uniform_indices, GLenum pname,
                      GLint* params),
                     (visible_program(program), uniform_count, uniform_indices, pname, params))
NINEBIT_PROGRAM_CALL(GLint, GetFragDataIndex, (GLuint program, const GLchar* name), (visible_program(program), name))
NINEBIT_PROGRAM_CALL(GLint, GetFragDataLocation, (GLuint program, const GLchar* name), (visible_program(program), name))
NINEBIT_PROGRAM_CALL(void, GetProgramBinary,
                     (GLuint program, GLsizei buf_size, GLsizei* length, GLenum* binary_format, void* binary),
                     (visible_program(program), buf_size, length, binary_format, binary))
NINEBIT_PROGRAM_CALL(void, GetProgramInterfaceiv,
                     (GLuint program, GLenum program_interface, GLenum pname, GLint* params),
                     (visible_program(program), program_interface, pname, params))
NINEBIT_PROGRAM_CALL(GLuint, GetProgramResourceIndex, (GLuint program, GLenum program_interface, const GLchar* name),
                     (visible_program(program), program_interface, name))
NINEBIT_PROGRAM_CALL(GLint, GetProgramResourceLocation, (GLuint program, GLenum program_interface, const GLchar* name),
                     (visible_program(program), program_interface, name))
NINEBIT_PROGRAM_CALL(GLint, GetProgramResourceLocationIndex,
                     (GLuint program, GLenum program_interface, const GLchar* name),
                     (visible_program(program), program_interface, name))
NINEBIT_PROGRAM_CALL(void, GetProgramResourceName,
                     (GLuint program, GLenum program_interface, GLuint index, GLsizei buf_size, GLsizei* length,
                      GLchar* name),
                     (visible_program(program), program_interface, index, buf_size, length, name))
NINEBIT_PROGRAM_CALL(void, GetProgramResourceiv,
                     (GLuint program, GLenum program_interface, GLuint index, GLsizei prop_count, const GLenum* props,
                      GLsizei count, GLsizei* length, GLint* params),
                     (visible_program(program), program_interface, index, prop_count, props, count, length, params))
NINEBIT_PROGRAM_CALL(void, GetProgramStageiv, (GLuint program, GLenum shadertype, GLenum pname, GLint* values),
                     (visible_program(program), shadertype, pname, values))
NINEBIT_PROGRAM_CALL(GLuint, GetSubroutineIndex, (GLuint program, GLenum shadertype, const GLchar* name),
                     (visible_program(program), shadertype, name))
NINEBIT_PROGRAM_CALL(GLint, GetSubroutineUniformLocation, (GLuint program, GLenum shadertype, const GLchar* name),
                     (visible_program(program), shadertype, name))
NINEBIT_PROGRAM_CALL(void, GetTransformFeedbackVarying,
                     (GLuint program, GLuint index, GLsizei buf_size, GLsizei* length, GLsizei* size, GLenum* type,
                      GLchar* name),
                     (visible_program(program), index, buf_size, length, size, type, name))
NINEBIT_PROGRAM_CALL(GLuint, GetUniformBlockIndex, (GLuint program, const GLchar* uniform_block_name),
                     (visible_program(program), uniform_block_name))
NINEBIT_PROGRAM_CALL(void, GetUniformIndices,
                     (GLuint program, GLsizei uniform_count, const GLchar* const* uniform_names,
                      GLuint* uniform_indices),
                     (visible_program(program), uniform_count, uniform_names, uniform_indices))
NINEBIT_PROGRAM_CALL(void, GetUniformdv, (GLuint program, GLint location, GLdouble* params),
                     (visible_program(program), location, params))
NINEBIT_PROGRAM_CALL(void, GetUniformuiv, (GLuint program, GLint location, GLuint* params),
                     (visible_program(program), location, params))
NINEBIT_PROGRAM_CALL(void, GetnUniformdv, (GLuint program, GLint location, GLsizei buf_size, GLdouble* params),
                     (visible_program(program), location, buf_size, params))
NINEBIT_PROGRAM_CALL(void, GetnUniformfv, (GLuint program, GLint location, GLsizei buf_size, GLfloat* params),
                     (visible_program(program), location, buf_size, params))
NINEBIT_PROGRAM_CALL(void, GetnUniformiv, (GLuint program, GLint location, GLsizei buf_size, GLint* params),
                     (visible_program(program), location, buf_size, params))
NINEBIT_PROGRAM_CALL(void, GetnUniformuiv, (GLuint program, GLint location, GLsizei buf_size, GLuint* params),
                     (visible_program(program), location, buf_size, params))
NINEBIT_PROGRAM_CALL(void, ProgramBinary, (GLuint program, GLenum binary_format, const void* binary, GLsizei length),
                     (visible_program(program), binary_format, binary, length))
NINEBIT_PROGRAM_CALL(void, ProgramParameteri, (GLuint program, GLenum pname, GLint value),
                     (visible_program(program), pname, value))
NINEBIT_PROGRAM_CALL(void, ShaderStorageBlockBinding,
                     (GLuint program, GLuint storage_block_index, GLuint storage_block_binding),
                     (visible_program(program), storage_block_index, storage_block_binding))
NINEBIT_PROGRAM_CALL(void, TransformFeedbackVaryings,
                     (GLuint program, GLsizei count, const GLchar* const* varyings, GLenum buffer_mode),
                     (visible_program(program), count, varyings, buffer_mode))
NINEBIT_PROGRAM_CALL(void, UniformBlockBinding,
                     (GLuint program, GLuint uniform_block_index, GLuint uniform_block_binding),
                     (visible_program(program), uniform_block_index, uniform_block_binding))
NINEBIT_PROGRAM_CALL(void, UseProgramStages, (GLuint pipeline, GLbitfield stages, GLuint program),
                     (pipeline, stages, visible_program(program)))

GLAPI void GLAPIENTRY glObjectLabel(GLenum identifier, GLuint name, GLsizei length, const GLchar* label) {
  static const auto next = next_function_as<decltype(&::glObjectLabel)>("glObjectLabel");
  if (next != nullptr) next(identifier, identifier == GL_PROGRAM ? visible_program(name) : name, length, label);
}
GLAPI void GLAPIENTRY glGetObjectLabel(GLenum identifier, GLuint name, GLsizei size, GLsizei* length, GLchar* label) {
  static const auto next = next_function_as<decltype(&::glGetObjectLabel)>("glGetObjectLabel");
  if (next != nullptr) next(identifier, identifier == GL_PROGRAM ? visible_program(name) : name, size, length, label);
}
