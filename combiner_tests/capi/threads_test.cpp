// A program is used by several threads at once. With the preset tsan this looks for races; everywhere, for wrong
// results.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <thread>
#include <vector>

#include "combiner_tests/capi/support.h"

namespace ninebit::test {
namespace {

struct Answers {
  std::vector<std::int16_t> red;
  std::array<std::int16_t, 4> color{};
  std::string trace, glsl;
  friend bool operator==(const Answers&, const Answers&) = default;
};

Answers ask(const ninebit_program* program, const std::vector<std::int16_t>& plane,
            const ninebit_registers& registers) {
  Answers answers;
  answers.red.resize(plane.size());
  ninebit_planes planes{};
  planes.struct_size = sizeof planes;
  planes.count = plane.size();
  for (auto& reg : planes.input) reg[0] = plane.data();
  planes.color[0] = answers.red.data();
  (void)ninebit_evaluate_planes(program, &planes, nullptr);
  (void)ninebit_evaluate(program, &registers, answers.color.data(), nullptr, nullptr);
  char* text = nullptr;
  (void)ninebit_trace_json(program, &registers, &text, nullptr);
  answers.trace = take(text);
  (void)ninebit_emit_glsl(program, 330, nullptr, &text, nullptr);
  answers.glsl = take(text);
  return answers;
}

TEST(CapiThreads, OneProgramInSeveral) {
  Random random(0xCA94);
  const CombinerState state = random_state(random, profiles::nv2a);
  const ProgramHandle program = compiled(profiles::nv2a, state);
  ASSERT_NE(program, nullptr);
  const ninebit_registers registers = registers_of(random_registers(random, profiles::nv2a));
  std::vector<std::int16_t> plane(3000);
  for (std::int16_t& code : plane) code = static_cast<std::int16_t>(random_code(random, profiles::nv2a));
  const Answers expected = ask(program.get(), plane, registers);
  EXPECT_FALSE(expected.trace.empty());
  EXPECT_FALSE(expected.glsl.empty());

  std::array<Answers, 4> found;
  std::vector<std::thread> threads;
  for (Answers& answers : found) {
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) answers = ask(program.get(), plane, registers);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Answers& answers : found) EXPECT_EQ(answers, expected);
}

// States are independent of each other: each thread has its own, and GL's current context is a thread's own affair.
TEST(CapiThreads, AStateEach) {
  std::array<std::string, 4> found;
  std::vector<std::thread> threads;
  for (std::string& text : found) {
    threads.emplace_back([&text] {
      ninebit_state* made = nullptr;
      (void)ninebit_state_create("geforce2", &made, nullptr);
      const StateHandle state(made);
      for (int i = 0; i < 100; ++i) (void)ninebit_gl_combiner_parameteri(made, 0x854E, 1 + i % 2);
      char* printed = nullptr;
      (void)ninebit_state_print(made, NINEBIT_FORM_JSON, &printed, nullptr);
      text = take(printed);
    });
  }
  for (std::thread& thread : threads) thread.join();
  CombinerState expected;
  expected.num_general_combiners = 2;
  for (const std::string& text : found) EXPECT_EQ(text, print_json_program(expected));
}

}  // namespace
}  // namespace ninebit::test
