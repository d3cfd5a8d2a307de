// Another program as a child process: what it says, and each way in which it may end.
#include "src/system/child_program.h"

#include <gtest/gtest.h>

#include <chrono>

namespace ninebit::posix {
namespace {

TEST(ChildProgram, ReadsAndWrites) {
  const std::string text(300'000, 'x');  // more than a pipe holds, in both directions
  const ProgramResult result = run_program({"cat"}, text, 20);
  EXPECT_EQ(result.end, ProgramEnd::ended);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, text);
}

TEST(ChildProgram, HasAStatus) {
  const ProgramResult result = run_program({"sh", "-c", "echo one; exit 7"}, "", 20);
  EXPECT_EQ(result.end, ProgramEnd::ended);
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(result.output, "one\n");
}

TEST(ChildProgram, NeedNotReadWhatItIsGiven) {
  const ProgramResult result = run_program({"true"}, std::string(300'000, 'x'), 20);
  EXPECT_EQ(result.end, ProgramEnd::ended);
  EXPECT_EQ(result.status, 0);
}

TEST(ChildProgram, MayCrash) {
  EXPECT_EQ(run_program({"sh", "-c", "kill -SEGV $$"}, "", 20).end, ProgramEnd::crashed);
}

TEST(ChildProgram, MayBeMissing) {
  EXPECT_EQ(run_program({"ninebit-no-such-program"}, "", 20).end, ProgramEnd::not_found);
}

TEST(ChildProgram, EndsWithItsTime) {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult result = run_program({"sh", "-c", "echo begun; exec sleep 60"}, "", 0.5);
  EXPECT_EQ(result.end, ProgramEnd::out_of_time);
  EXPECT_EQ(result.output, "begun\n");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(ChildProgram, EndsWhenItsCallerSaysSo) {
  int calls = 0;
  const ProgramResult result = run_program({"sleep", "60"}, "", 50, [&calls] { return ++calls < 3; });
  EXPECT_EQ(result.end, ProgramEnd::stopped);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace ninebit::posix
