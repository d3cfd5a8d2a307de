// Random calls of what the layer stands in front of, with wrong enumerants and null pointers, by two threads with
// contexts that share objects and one without a context, for two seconds. Nothing is compared: no crash, no hang.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

using Clock = std::chrono::steady_clock;

GLenum some_enum(Random& random) {
  return random.pick<GLenum>({0,
                              1,
                              7,
                              GL_TEXTURE_2D,
                              GL_TEXTURE_3D,
                              GL_TEXTURE_1D,
                              GL_TEXTURE_CUBE_MAP,
                              GL_FOG,
                              GL_LIGHTING,
                              GL_REGISTER_COMBINERS_NV,
                              GL_PER_STAGE_CONSTANTS_NV,
                              GL_TEXTURE_SHADER_NV,
                              GL_SHADER_OPERATION_NV,
                              GL_CULL_MODES_NV,
                              GL_CONST_EYE_NV,
                              GL_PREVIOUS_TEXTURE_INPUT_NV,
                              GL_CONSTANT_COLOR0_NV,
                              GL_NUM_GENERAL_COMBINERS_NV,
                              GL_CURRENT_PROGRAM,
                              GL_NUM_EXTENSIONS,
                              GL_EXTENSIONS,
                              GL_PROGRAM_OBJECT_ARB,
                              GL_COMPILE,
                              GL_COMPILE_AND_EXECUTE,
                              GL_VERTEX_PROGRAM_ARB,
                              0x1234,
                              0xFFFFFFFFU});
}

void some_texture_call(Random& random) {
  const GLenum target = random.one_in(3) ? some_enum(random) : GLenum{GL_TEXTURE_SHADER_NV}, name = some_enum(random);
  const GLfloat floats[]{random.real_f(-70000, 70000), static_cast<GLfloat>(some_enum(random)), 0, 1};
  const GLint integers[]{static_cast<GLint>(some_enum(random)), GL_LESS, GL_GEQUAL, -1};
  GLfloat got_floats[16]{};
  GLint got_integers[16]{};
  const bool null = target == GL_TEXTURE_SHADER_NV && random.one_in(8);  // the driver does not look for null pointers
  switch (random.below(7)) {
    case 0:
      return glTexEnvf(target, name, floats[0]);
    case 1:
      return glTexEnvi(target, name, integers[0]);
    case 2:
      return glTexEnvfv(target, name, null ? nullptr : floats);
    case 3:
      return glTexEnviv(target, name, null ? nullptr : integers);
    case 4:
      return glGetTexEnvfv(target, name, null ? nullptr : got_floats);
    case 5:
      return glGetTexEnviv(target, name, null ? nullptr : got_integers);
    default:
      return glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(random.below(6)));
  }
}

void some_get(Random& random) {
  const GLenum name = some_enum(random);
  const bool ours =
      name == GL_REGISTER_COMBINERS_NV || name == GL_CONSTANT_COLOR0_NV || name == GL_NUM_GENERAL_COMBINERS_NV;
  const bool null = ours && random.one_in(4);
  GLfloat floats[64]{};
  GLint integers[64]{};
  GLdouble doubles[64]{};
  GLboolean booleans[64]{};
  switch (random.below(8)) {
    case 0:
      return glGetFloatv(name, null ? nullptr : floats);
    case 1:
      return glGetIntegerv(name, null ? nullptr : integers);
    case 2:
      return glGetDoublev(name, null ? nullptr : doubles);
    case 3:
      return glGetBooleanv(name, null ? nullptr : booleans);
    case 4:
      static_cast<void>(glGetString(name));
      return;
    case 5:
      static_cast<void>(glGetStringi(name, static_cast<GLuint>(random.below(500))));
      return;
    case 6:
      static_cast<void>(glGetHandleARB(name));
      return;
    default:
      static_cast<void>(glIsEnabled(name));
  }
}

// What a thread is in the middle of.
struct Caller {
  GLuint open = 0;  // the list that it compiles
  bool in_begin = false;
  GLuint programs = 0;  // the names of its programs begin behind this one
};

// Lists 1 to 5, which call only lists of lower numbers, so that playing them ends. None between glBegin and glEnd: Mesa
// 22.3 crashes or hangs on halves of pairs and draws inside of pairs in lists, with the layer or without.
void some_list_call(Random& random, Caller& caller) {
  GLuint& open = caller.open;
  if (caller.in_begin) return;
  const auto list = static_cast<GLuint>(random.between(1, 5));
  const GLubyte numbers[]{static_cast<GLubyte>(random.below(static_cast<int>(open == 0 ? 6 : open))), 0, 1};
  switch (random.below(6)) {
    case 0:
      glNewList(list, random.one_in(8) ? some_enum(random) : random.pick<GLenum>({GL_COMPILE, GL_COMPILE_AND_EXECUTE}));
      open = static_cast<GLuint>(integer_of(GL_LIST_INDEX)) == list ? list : open;
      return;
    case 1:
    case 2:
      glEndList();
      open = 0;
      return;
    case 3:
      return glCallList(numbers[0]);
    case 4:
      return glCallLists(random.between(-1, open == 1 ? 1 : 2),
                         random.one_in(8) ? some_enum(random) : GLenum{GL_UNSIGNED_BYTE}, numbers);
    default:
      return glDeleteLists(random.one_in(8) ? 0 : list, random.between(-1, 2));
  }
}

void some_draw(Random& random, Caller& caller) {
  if (caller.in_begin) return;
  random.one_in(2) ? draw_square() : glRectf(-1, -1, 1, 1);
}

// The functions of NV_vertex_program and their neighbours. Arrays are of the test's memory. Each thread has programs of
// its own: Mesa 22.3 crashed when a context was destroyed after two threads had drawn with one program.
void some_vertex_call(Random& random, const Caller& caller) {
  static const std::array<GLdouble, 64> memory{};
  static const std::string texts[]{"!!VP1.0 MOV o[HPOS], v[OPOS];END", "!!VSP1.0 MOV c[0], v[0];END", "!!VP1.0 MOV"};
  const GLenum target = random.pick<GLenum>({GL_VERTEX_PROGRAM_NV, GL_VERTEX_STATE_PROGRAM_NV, GL_TEXTURE_2D});
  const GLuint name = random.one_in(6) ? 0 : caller.programs + static_cast<GLuint>(random.between(1, 5));
  const auto parameter = static_cast<GLuint>(random.below(120)), index = static_cast<GLuint>(random.below(18));
  const GLenum type = random.pick<GLenum>({GL_FLOAT, GL_SHORT, GL_UNSIGNED_BYTE, GL_DOUBLE, GL_INT});
  const GLfloat floats[16]{1, 2, 3, 4};
  GLfloat got[16]{};
  GLint integers[16]{};
  GLuint names[2]{name, caller.programs + 3};
  const std::string& text = texts[random.below(3)];
  switch (random.below(22)) {
    case 0:
      return glLoadProgramNV(target, name, static_cast<GLsizei>(text.size()) - (random.one_in(9) ? 40 : 0),
                             reinterpret_cast<const GLubyte*>(text.data()));
    case 1:
    case 2:
      return glBindProgramNV(target, name);
    case 3:
      return glBindProgramARB(GL_VERTEX_PROGRAM_ARB, name);
    case 4:
      return random.one_in(2) ? glDeleteProgramsNV(random.between(-1, 2), names) : glDeleteProgramsARB(1, names);
    case 5:
      return random.one_in(2) ? glGenProgramsNV(2, names) : glGenProgramsARB(2, names);
    case 6:
      static_cast<void>(glIsProgramNV(name) == glIsProgramARB(name));
      return;
    case 7:
      return glGetProgramivNV(name, GL_PROGRAM_LENGTH_NV, integers);
    case 8:
      return glProgramParameters4fvNV(target, parameter, random.between(-1, 4), floats);
    case 9:
      return glGetProgramParameterfvNV(target, parameter, GL_PROGRAM_PARAMETER_NV, got);
    case 10:
      return glTrackMatrixNV(target, 4 * index, random.pick<GLenum>({GL_NONE, GL_MODELVIEW, GL_TEXTURE, GL_MATRIX0_NV}),
                             GL_INVERSE_NV);
    case 11:
      return glGetTrackMatrixivNV(target, 4 * index, GL_TRACK_MATRIX_NV, integers);
    case 12:
      return glExecuteProgramNV(target, name, floats);
    case 13:
      return glVertexAttribs2fvNV(index, random.between(-1, 3), floats);
    case 14:
      return glVertexAttrib4ubNV(index, 1, 2, 3, 4);
    case 15:
      return glGetVertexAttribfvNV(index, GL_CURRENT_ATTRIB_NV, got);
    case 16:
      if (caller.in_begin) return;
      return random.one_in(2) ? glVertexAttribPointerNV(index, random.between(0, 5), type, 0, memory.data())
                              : glVertexAttribPointerARB(index, 4, type, GL_TRUE, 0, memory.data());
    case 17:
      if (index < 16)
        glGetVertexAttribPointervARB(index, GL_VERTEX_ATTRIB_ARRAY_POINTER, reinterpret_cast<void**>(got));
      if (index > 15 || *reinterpret_cast<void**>(got) == nullptr || caller.in_begin) return;
      return random.one_in(2) ? glEnableClientState(GL_VERTEX_ATTRIB_ARRAY0_NV + index)
                              : glEnableVertexAttribArrayARB(index);
    case 18:
      return random.one_in(2) ? glDisableClientState(GL_VERTEX_ATTRIB_ARRAY0_NV + index)
                              : glDisableVertexAttribArray(index);
    case 19:
      return glArrayElement(random.below(8));
    case 20:
      return glMatrixMode(random.pick<GLenum>({GL_MATRIX0_NV, GL_MODELVIEW, GL_MATRIX1_ARB}));
    default:
      return (random.one_in(2) ? glEnable : glDisable)(GL_VERTEX_PROGRAM_NV);
  }
}

void some_call(Random& random, Caller& caller) {
  const GLenum cap = some_enum(random);
  if (random.one_in(6)) return some_vertex_call(random, caller);
  switch (random.below(16)) {
    case 0:
      return some_texture_call(random);
    case 1:
      return some_get(random);
    case 2:
    case 3:
      return some_list_call(random, caller);
    case 4:
      return (random.one_in(2) ? glEnable : glDisable)(cap);
    case 5:
      return random.one_in(2) ? glPushAttrib(random.one_in(2) ? GL_ALL_ATTRIB_BITS : GL_TEXTURE_BIT) : glPopAttrib();
    case 6:
      if (caller.open != 0 || caller.in_begin) return;
      caller.in_begin = !random.one_in(4);
      return glBegin(caller.in_begin ? GLenum{GL_TRIANGLES} : GLenum{0x1234});
    case 7:
      if (caller.open == 0) glEnd();
      caller.in_begin = false;
      return;
    case 8:
    case 9:
      return some_draw(random, caller);
    case 10:
      return glUseProgram(random.one_in(4) ? static_cast<GLuint>(random.below(9)) : 0);
    case 11:
      return glBindTexture(random.one_in(4) ? cap : GLenum{GL_TEXTURE_2D}, static_cast<GLuint>(random.below(3)));
    case 12:
      static_cast<void>(glGetError());
      return;
    case 13:
      return glColor4ub(random.byte(), 1, 2, 3);
    default:
      execute(kLayerFunctions, random_command(random, profiles::nv2a, false, 6));
  }
}

// Returns the number of calls.
std::uint64_t call_until(Clock::time_point end, std::uint64_t seed, const GlContext* context) {
  if (context != nullptr) context->make_current();
  std::uint64_t calls = 0;
  Caller caller{.programs = 1000 * static_cast<GLuint>(seed)};
  for (std::uint64_t round = 0; Clock::now() < end; ++round) {
    Random random(seed, round);
    for (int i = 0; i < 40; ++i, ++calls) some_call(random, caller);
  }
  GlContext::release();
  return calls;
}

// NINEBIT_GL_FUZZ_SECONDS asks for more.
std::chrono::seconds fuzz_duration() {
  const char* const text = std::getenv("NINEBIT_GL_FUZZ_SECONDS");
  return std::chrono::seconds(text != nullptr ? std::atoi(text) : 2);
}

TEST(LayerEntryPoints, RandomCallsFromThreads) {
  std::optional<WithExtensions> wanted(std::in_place, "all");
  NINEBIT_GL_CONTEXT(first);
  const auto second = GlContext::make(why_not, profiles::nv2a, first.get());
  ASSERT_NE(second, nullptr);
  GlContext::release();
  const auto end = Clock::now() + fuzz_duration();
  std::atomic<std::uint64_t> calls{0}, calls_without{0};
  std::thread one([&] { calls += call_until(end, 1, first.get()); });
  std::thread two([&] { calls += call_until(end, 2, second.get()); });
  std::thread without([&] { calls_without += call_until(end, 3, nullptr); });
  one.join();
  two.join();
  without.join();
  EXPECT_GT(calls, 500U);
  EXPECT_GT(calls_without, 500U);
  // A context of afterwards works.
  wanted.reset();
  const auto third = GlContext::make(why_not);
  show_constant({0, 1, 0, 1});
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 255, 0, 255}));
}

}  // namespace
}  // namespace ninebit::test
