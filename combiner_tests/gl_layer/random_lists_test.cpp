// Random commands, executed directly in one context and by display lists in another: all results are the same.
#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <set>

#include "combiner_tests/gl_layer/command_streams.h"

namespace ninebit::test {
namespace {

// A part of a stream, and how it is executed.
struct ListPart {
  enum class How { direct, compiled, while_compiled, called_by_another, by_numbers } how = How::direct;
  std::vector<StreamCommand> commands;
  GLuint list = 0;  // and the three numbers above
};

void run_all(const std::vector<StreamCommand>& commands) {
  for (const StreamCommand& one : commands) one.run();
}

void compile_list(GLuint number, const std::vector<StreamCommand>& commands, GLenum mode = GL_COMPILE) {
  glNewList(number, mode);
  run_all(commands);
  glEndList();
}

void compile_part(const ListPart& part) {
  auto middle = part.commands.begin() + static_cast<std::ptrdiff_t>(part.commands.size() / 2);
  while (middle != part.commands.begin() && std::prev(middle)->in_begin) ++middle;
  const std::vector<StreamCommand> first(part.commands.begin(), middle), second(middle, part.commands.end());
  switch (part.how) {
    case ListPart::How::compiled:
      return compile_list(part.list, part.commands);
    case ListPart::How::called_by_another:
      compile_list(part.list + 1, first);
      glNewList(part.list, GL_COMPILE);
      glCallList(part.list + 1);
      run_all(second);
      return glEndList();
    case ListPart::How::by_numbers:
      compile_list(part.list + 1, first);
      compile_list(part.list + 2, second);
      glNewList(part.list, GL_COMPILE);
      glListBase(part.list);
      {
        const GLubyte numbers[]{1, 2};
        glCallLists(2, GL_UNSIGNED_BYTE, numbers);
      }
      glListBase(0);
      return glEndList();
    default:
      return;
  }
}

void run_part(const ListPart& part) {
  if (part.how == ListPart::How::direct) return run_all(part.commands);
  if (part.how == ListPart::How::while_compiled) return compile_list(part.list, part.commands, GL_COMPILE_AND_EXECUTE);
  glCallList(part.list);
}

std::vector<ListPart> random_parts(Random& random, const std::vector<StreamCommand>& stream) {
  std::vector<ListPart> parts;
  GLuint list = 1;  // the numbers of the stream of before: redefinition
  for (std::size_t i = 0; i < stream.size();) {
    ListPart part;
    part.how = static_cast<ListPart::How>(random.below(5));
    part.list = list;
    list += 3;
    // A list holds whole pairs of glBegin and glEnd: Mesa 22.3 draws other primitives wrongly after half a pair.
    std::size_t size = static_cast<std::size_t>(random.between(1, 14));
    for (; i < stream.size() && (size > 0 || stream[i - 1].in_begin); ++i, size -= size > 0 ? 1 : 0) {
      part.commands.push_back(stream[i]);
    }
    parts.push_back(part);
  }
  return parts;
}

std::string described(const std::vector<ListPart>& parts) {
  std::string text;
  for (const ListPart& part : parts) {
    text += "\n[" + std::to_string(static_cast<int>(part.how)) + ", list " + std::to_string(part.list) + ']';
    for (const StreamCommand& one : part.commands) text += ' ' + one.name + ';';
  }
  return text;
}

// Some of the lists are compiled before the first command of the combiners. That works for programs that look the entry
// points up first.
TEST(LayerRandomLists, AreTheSameAsTheirCommands) {
  const char* const only = std::getenv("NINEBIT_GL_STREAM");
  ASSERT_NE(eglGetProcAddress("glCombinerInputNV"), nullptr);
  std::set<std::vector<Pixel>> pictures;
  std::set<GLenum> errors;
  for (std::uint64_t pair = 0; pair < 3; ++pair) {
    NINEBIT_GL_CONTEXT(direct);
    make_stream_objects();
    const auto by_lists = GlContext::make(why_not);
    make_stream_objects();
    for (std::uint64_t round = 0; round < 14; ++round) {
      const std::uint64_t index = pair * 100 + round;
      Random random(20010203, index);
      const auto stream = random_stream(random, 30);
      const auto parts = random_parts(random, stream);
      if (only != nullptr && std::strtoull(only, nullptr, 10) == index) std::cout << described(parts) << '\n';
      direct->make_current();
      run_all(stream);
      const StreamResult expected = stream_result();
      by_lists->make_current();
      for (const ListPart& part : parts) compile_part(part);
      for (const ListPart& part : parts) run_part(part);
      const StreamResult got = stream_result();
      ASSERT_EQ(got.error, expected.error) << index << described(parts);
      ASSERT_EQ(got.state, expected.state) << index << described(parts);
      ASSERT_EQ(differences(got.picture, expected.picture), "") << index << described(parts);
      pictures.insert(expected.picture);
      errors.insert(expected.error);
      if (random.one_in(3)) glDeleteLists(1, 20);
    }
  }
  EXPECT_GT(pictures.size(), 30U);
  EXPECT_GE(errors.size(), 3U);
}

}  // namespace
}  // namespace ninebit::test
