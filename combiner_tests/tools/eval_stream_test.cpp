// `ninebit eval` on tables that are wrong, endless or very long, and on outputs that cannot be written.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class EvalStream : public testing::Test {
 protected:
  Outcome eval(const std::string& table, Words more = {}, const ChildSettings& settings = {}) {
    return ninebit(Words{"eval", article_, "--inputs", write_bytes(folder_ / "in.csv", table)} + more, settings);
  }
  TempFolder folder_;
  std::string article_ = write_program(folder_, "article.json", article_state());
};

TEST_F(EvalStream, FaultsHaveTheirPlace) {
  struct Case {
    std::string table, place;
    Words words;
  };
  for (const Case& c : std::vector<Case>{
           {"", ":1:1: ", {"empty", "header"}},
           {" \n\r\n", ":1:1: ", {"empty"}},
           {"primary.r,tex9.r\n", ":1:11: ", {"'tex9.r'", "tex0 to tex1"}},
           {"primary.r,tex2.r\n", ":1:11: ", {"'tex2.r'"}},
           {"primary.r,zero.r\n", ":1:11: ", {"'zero.r'"}},
           {"primary.r,,tex0.r\n", ":1:11: ", {"''"}},
           {"primary.r,\n", ":1:11: ", {"''"}},
           {"primary\n", ":1:1: ", {"'primary'"}},
           {"\n  Primary.r\n", ":2:3: ", {"'Primary.r'"}},
           {"primary.r,tex0.r,primary.r\n", ":1:18: ", {"primary.r", "duplicate column"}},
           {"primary.r\n1\nx\n", ":3:1: ", {"primary.r", "-255", "255", "'x'"}},
           {"primary.r,tex0.a\n1,2\n\n3,\n", ":4:3: ", {"tex0.a", "''"}},
           {"primary.r,tex0.a\n1,256\n", ":2:3: ", {"tex0.a", "255", "'256'"}},
           {"primary.r,tex0.a\n-256,0\n", ":2:1: ", {"'-256'"}},
           {"primary.r\n1.5\n", ":2:1: ", {"'1.5'"}},
           {"primary.r\n99999999999999999999\n", ":2:1: ", {"primary.r"}},
           {"primary.r\n0x10\n", ":2:1: ", {"'0x10'"}},
           {"primary.r,tex0.a\n1 2,3\n", ":2:1: ", {"'1 2'"}},
           {"primary.r,tex0.a\n1\n", ":2:2: ", {"1 field,", "2"}},
           {"primary.r,tex0.a\n1,2,3\n", ":2:4: ", {"3 fields", "2"}},
           {"primary.r,tex0.a\n1,2,\n", ":2:4: ", {"3 fields", "2"}},
           {std::string("primary.r\n1\0\n", 13), ":2:1: ", {"'1?'"}},
           {"primary.r\n1\n" + std::string(70'000, ' ') + "2\n", ":3:1: ", {"65536 bytes"}},
           {std::string(1'000'000, 'a'), ":1:1: ", {"65536 bytes"}},
       }) {
    SCOPED_TRACE(testing::PrintToString(c.table.substr(0, 60)));
    expect_error(eval(c.table, {"-o", folder_ / "out.csv"}), 3, c.words + Words{"in.csv" + c.place});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.csv"));
  }
  expect_error(eval("primary.r\n200\n", {"--profile", "geforce256-8bit", "-o", folder_ / "out.csv"}), 3,
               {":2:1: ", "-127 to 127"});
}

TEST_F(EvalStream, WrongFilesAndFlags) {
  expect_error(ninebit({"eval", article_, "--inputs", folder_ / "none.csv"}), 3, {"none.csv", "No such file"});
  expect_error(ninebit({"eval", article_, "--inputs", folder_.path().string()}), 3, {"Is a directory"});
  expect_error(ninebit({"eval", folder_ / "none.gl", "--inputs", article_}), 3, {"none.gl", "No such file"});
  expect_error(ninebit({"eval", article_}), 2, {"--inputs"});
  expect_error(ninebit({"eval", "-", "--inputs", "-"}), 2, {"standard input"});
  expect_error(eval("primary.r\n", {"--engine", "gpu"}), 2, {"--engine"});
}

// An older output stays whole until the new one is complete.
TEST_F(EvalStream, OutputsAreWholeOrNotThere) {
  const std::string out = write_bytes(folder_ / "out.csv", "older");
  expect_error(eval("primary.r\n1\nx\n", {"-o", out}), 3, {":3:1: "});
  EXPECT_EQ(read_bytes(out), "older");
  expect_error(eval("primary.r\n1\n", {"-o", folder_.path().string()}), 4, {"Is a directory"});
  expect_error(eval("primary.r\n1\n", {"-o", "/dev/full"}), 4, {"/dev/full", "No space left"});
  expect_error(eval("primary.r\n1\n", {}, {.out = "/dev/full"}), 4, {"standard output", "No space left"});
  EXPECT_EQ(files_in(folder_.path()).size(), 3U) << "nothing is left over";

  EXPECT_EQ(eval("primary.r\n1\n", {"-o", "/dev/null"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  const Outcome good = eval("primary.r\n1\n", {"-o", out});
  EXPECT_EQ(good.err, "wrote " + out + "\n");
  EXPECT_EQ(good.out, "");
  EXPECT_EQ(read_bytes(out), "out.r,out.g,out.b,out.a\n0,0,0,0\n");
  EXPECT_EQ(eval("primary.r\n1\n", {"--quiet", "-o", folder_ / "made/for/this.csv"}).err, "");
  EXPECT_EQ(read_bytes(folder_ / "made/for/this.csv"), read_bytes(out));
  // The inputs themselves may be the output.
  const std::string table = write_bytes(folder_ / "same.csv", "primary.r,tex0.r\n10,12\n");
  EXPECT_EQ(ninebit({"eval", article_, "--inputs", table, "-o", table}).code, 0);
  EXPECT_EQ(read_bytes(table), "out.r,out.g,out.b,out.a\n0,0,0,1\n");
}

TEST_F(EvalStream, ManyRowsInConstantMemory) {
  constexpr int kRows = 1'000'000;  // 7 bytes each, of which the program may hold 4 MiB
  std::string text = "primary.r,tex0.r\n";
  for (int i = 0; i < kRows; ++i) text += std::to_string(i % 256) + ',' + std::to_string(i / 256 % 256) + '\n';
  const std::string many = write_bytes(folder_ / "many.csv", text);
  const long one_row =
      ninebit({"eval", article_, "--inputs", write_bytes(folder_ / "one.csv", "primary.r\n1\n")}).peak_kib;
  const std::string simd = folder_ / "simd.csv", reference = folder_ / "reference.csv";
  const Outcome outcome = ninebit({"eval", article_, "--inputs", many, "-o", simd});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LT(outcome.peak_kib, one_row + 4096) << "KiB; one row takes " << one_row;
  const std::string rows = read_bytes(simd);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), kRows + 1);
  ASSERT_EQ(ninebit({"eval", article_, "--inputs", many, "-o", reference, "--engine", "reference"}).code, 0);
  EXPECT_EQ(rows, read_bytes(reference));
}

// A table that does not end: what is waiting for more is interrupted at once and leaves nothing behind.
TEST_F(EvalStream, InterruptedWhileWaiting) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int writer = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  const std::string rows = "primary.r\n1\n2\n";
  ASSERT_EQ(::write(writer, rows.data(), rows.size()), static_cast<ssize_t>(rows.size()));
  Child child({"eval", article_, "--inputs", "-", "-o", folder_ / "out.csv"}, {.in = pipe});
  child.until([&] { return folder_.names().size() == 3; });  // the output has been begun
  child.send(SIGINT);
  expect_error(child.wait(), 130, {"interrupted"});
  ::close(writer);
  EXPECT_EQ(folder_.names(), (Words{"article.json", "pipe"}));
}

}  // namespace
}  // namespace tools_test
