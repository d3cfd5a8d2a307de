// Inputs that are not regular files are refused at once, and the first signal ends a wait for standard input.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "combiner_tests/tools/program_support.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

using std::chrono::steady_clock;

// Fails, and kills the program, where it does not end soon.
Outcome ends_soon(Child& child) {
  const auto latest = steady_clock::now() + std::chrono::seconds(20);
  while (!child.ended() && steady_clock::now() < latest) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const bool in_time = child.ended();
  EXPECT_TRUE(in_time) << "the program waits";
  if (!in_time) child.send(SIGKILL);
  return child.wait();
}

class RegularFiles : public testing::Test {
 protected:
  void SetUp() override {
    program_ = write_bytes(folder_ / "p.rc1", "!!RC1.0\nout.rgb = tex0;\nout.a = tex0;\n");
    table_ = write_bytes(folder_ / "t.csv", "tex0.r,out.r\n1,1\n");
    results_ = write_bytes(folder_ / "results.txt", "ninebit-results 1\n");
  }

  // Each command reads FILE as something else, or FILE.obj, a link to it.
  [[nodiscard]] std::vector<Words> commands(const std::string& file) const {
    const std::string scene = file + ".obj";
    const std::string out = folder_ / "out", png = out + ".png";
    return {{"validate", file},
            {"explain", file},
            {"explain", file + "#1"},
            {"convert", file, "--to", "rc10"},
            {"convert", file, "--from", "xbox", "--to", "rc10"},
            {"trace", file, "--set", "tex0.r=1"},
            {"eval", file, "--inputs", table_},
            {"eval", program_, "--inputs", file},
            {"verify", file},
            {"verify", file, "--program", program_},
            {"verify", table_, "--program", file},
            {"verify", results_, "--vectors", file},
            {"verify", "--decide", file},
            {"prove", "equivalent", file, program_},
            {"prove", "equivalent", program_, file},
            {"draw", file, "-o", png},
            {"draw", program_, "-o", png, "--tex0", file},
            {"draw", program_, "-o", png, "--tex0", "normals:" + file},
            {"draw", program_, "-o", png, "--mesh", scene},
            {"trace", "--effect", file, "--pixel", "1,1"},
            {"trace", "--scene", scene, "--pixel", "1,1"},
            {"render", scene, "-o", out},
            {"render", kRoom, "-o", out, "--technique", "light-cookie", "--cookie", file},
            {"compare", scene, "-o", out},
            {"bench", "frame", scene, "--quick"},
            {"study", "shadows", scene},
            {"study", "index-steps", "--program", file},
            {"study", "datapath", "--program", file, "--over", "tex0.r"},
            {"study", "datapath", "--program", program_, "--inputs", file},
            {"study", "merge", file, "-o", out},
            {"profiles", "--profile", file},
            {"eval", program_, "--inputs", table_, "--profile", file}};
  }

  TempFolder folder_;
  std::string program_, table_, results_;
};

TEST_F(RegularFiles, OthersAreRefusedAtOnce) {
  const std::string socket = folder_ / "s.json", fifo = folder_ / "f.json", device = folder_ / "d.json";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", device);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(socket.size(), sizeof address.sun_path);
  socket.copy(address.sun_path, socket.size());
  const int listening = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const std::string& file : {fifo, device, socket}) {
    std::filesystem::create_symlink(file, file + ".obj");
    // Every reader meets the pipe, on which it would wait; every fifth one what else there is.
    const std::vector<Words> all = commands(file);
    for (std::size_t i = 0; i < all.size(); i += file == fifo ? 1U : 5U) {
      const Words& words = all[i];
      SCOPED_TRACE(testing::PrintToString(words));
      Child child(words);
      const Outcome outcome = ends_soon(child);
      expect_error(outcome, 3, {file.substr(file.rfind('/')), "regular file"});
      ASSERT_FALSE(HasFailure());
    }
  }
  ::close(listening);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

// As bash gives them for <(command).
TEST_F(RegularFiles, PipesAreReadAsStandardInputAlone) {
  const std::string fifo = folder_ / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const int writer = ::open(fifo.c_str(), O_RDWR | O_CLOEXEC);
  const std::string text = read_bytes(program_);
  ASSERT_EQ(::write(writer, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  Child child({"validate", "/dev/stdin"}, {.in = fifo});
  expect_error(ends_soon(child), 3, {"/dev/stdin: is not a regular file; expected one, or - for standard input"});
  ::close(writer);
  EXPECT_EQ(ninebit({"validate", "/dev/stdin"}, {.in = program_}).code, 0) << "that is a regular file";
  EXPECT_EQ(ninebit({"validate", "-"}, {.in = program_}).code, 0);
}

// The other end of the pipe is open, and nothing comes.
TEST_F(RegularFiles, TheFirstSignalEndsAWaitForStandardInput) {
  const std::string fifo = folder_ / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const int writer = ::open(fifo.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  for (const Words& words : std::vector<Words>{{"validate", "-"},
                                               {"eval", "-", "--inputs", table_},
                                               {"eval", program_, "--inputs", "-"},
                                               {"verify", "-"},
                                               {"verify", table_, "--program", "-"},
                                               {"verify", "--decide", "-"},
                                               {"prove", "equivalent", program_, "-"},
                                               {"draw", "-", "-o", folder_ / "out.png"}}) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      if (signal != SIGINT && words[0] != "validate") continue;  // one handler for all verbs
      SCOPED_TRACE(testing::PrintToString(words) + " " + std::to_string(signal));
      Child child(words, {.in = fifo});
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      EXPECT_FALSE(child.ended());
      child.send(signal);
      ASSERT_EQ(ends_soon(child).code, 128 + signal);
    }
  }
  ::close(writer);
  EXPECT_EQ(folder_.names(), (Words{"fifo", "p.rc1", "results.txt", "t.csv"}));
}

}  // namespace
}  // namespace tools_test
