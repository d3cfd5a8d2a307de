// The output folder removed while a verb works: exit code 4 and one line, never a success whose files nobody has.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class FolderRemoved : public testing::Test {
 protected:
  // Runs until a file of the folder satisfies `begun`, then removes the folder.
  [[nodiscard]] Outcome run(const Words& arguments, const std::function<bool(const std::string& name)>& begun,
                            const std::function<void()>& go_on = {}, const ChildSettings& settings = {}) const {
    Child child(arguments, settings);
    if (go_on) feed_ = std::thread(go_on);
    EXPECT_TRUE(child.until([&] { return has_file(out_, begun); })) << "the program ended before it wrote";
    // Again where the program has written one more file meanwhile.
    for (std::error_code error; std::filesystem::exists(out_, error);) std::filesystem::remove_all(out_, error);
    removed_ = true;
    if (feed_.joinable()) feed_.join();
    return child.wait();
  }

  TempFolder folder_;
  std::string out_ = folder_ / "out";
  mutable std::thread feed_;
  mutable std::atomic<bool> removed_ = false;
};

TEST_F(FolderRemoved, WhileAPictureIsDrawn) {
  const auto words = small_render(kBunny, out_, {"--quiet", "--layers", "--size", "1000x750", "--map-size", "512"});
  // The folder's probe is there first; nothing else is until the first picture is encoded.
  expect_error(run(words, [](const std::string& name) { return name.starts_with(".color"); }), 4, {out_});
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(FolderRemoved, WhileAStudyRuns) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const auto begun = [this](const std::string& name) {
    return name == "part-1-of-1.jsonl" && std::filesystem::file_size(out_ + '/' + name) > 2000;
  };
  expect_error(run({"study", "index-steps", "--quiet", "-o", out_}, begun), 4, {"part-1-of-1.jsonl", "was removed"});
  EXPECT_FALSE(std::filesystem::exists(out_));
}

// They are over too soon to be seen from outside: the program is held where it brings a file to the disk.
TEST_F(FolderRemoved, WhileFilesAreWritten) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "the leak sanitizer does not work in a traced program";
  const std::string parts = folder_ / "parts";
  ASSERT_EQ(ninebit({"study", "index-steps", "--profile", "geforce2", "--formats", "l", "--steps", "1-2", "--quiet",
                     "-o", parts})
                .code,
            0);
  const std::string article = out_ + "/article.rc";
  for (const auto& [words, named] :
       {std::pair{Words{"convert", kArticle, "--to", "rc10", "-o", article}, article},
        {Words{"study", "merge", parts + "/part-1-of-1.jsonl", "--quiet", "-o", out_}, out_}}) {
    SCOPED_TRACE(words[0]);
    Child child(words, {.traced = true});
    if (!child.run_to([](std::uint64_t call) { return call == SYS_fsync; })) {
      const Outcome outcome = child.wait();
      if (outcome.code == 126) GTEST_SKIP() << "tracing is not allowed here";
      FAIL() << "it ended before it wrote: " << outcome.err;
    }
    EXPECT_GE(files_in(out_).size(), 1U);
    std::filesystem::remove_all(out_);
    child.let_go();
    expect_error(child.wait(), 4, {named});
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
}

TEST_F(FolderRemoved, WhileATableIsEvaluated) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_directory(out_);
  const std::string program = write_program(folder_, "article.json", article_state());
  const auto feed = [this, pipe] {
    std::ofstream table(pipe);
    table << "primary.r\n1\n" << std::flush;
    while (!removed_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    table << "2\n";
  };
  const auto begun = [](const std::string& name) { return name.starts_with(".table"); };
  const Words words{"eval", program, "--inputs", "-", "--quiet", "-o", out_ + "/table.csv"};
  expect_error(run(words, begun, feed, {.in = pipe}), 4, {out_ + "/table.csv"});
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace tools_test
