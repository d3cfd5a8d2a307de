// Logs in pieces, long logs, and noise.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "combiner_tests/fuzz/common.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/register_log_shapes.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/register_log.h"

namespace ninebit::test {
namespace {

using Clock = std::chrono::steady_clock;

std::string random_log(Random& random) {
  const std::vector<TraceStyle> styles = all_styles();
  const Trace trace = random_trace(random);
  return styles[static_cast<std::size_t>(random.below(static_cast<int>(styles.size())))].text(trace);
}

// All that a log says, as text.
std::string summary(const Parsed<RegisterLog>& log) {
  std::string text = all_faults(log);
  for (const TextFault& note : log.notes) text += note.text() + '\n';
  if (!log) return text;
  for (const LogSetup& setup : log->setups) {
    text += std::to_string(setup.draws) + ' ' + std::to_string(setup.first_line) + ' ' +
            std::to_string(setup.last_frame) + ':';
    for (const RegisterWord& word : setup.words) {
      text += ' ' + word.name + '=' + std::to_string(word.value) + '@' + std::to_string(word.place.line);
    }
    for (const LogDraw& draw : setup.draw_calls)
      text += ' ' + std::to_string(draw.line) + '/' + std::to_string(draw.vertices.value_or(0));
    text += '\n';
  }
  return text;
}

TEST(RegisterLogHostile, PiecesDoNotMatter) {
  for (int i = 0; i < 300; ++i) {
    Random random(111, static_cast<std::uint64_t>(i));
    const std::string text = random_log(random);
    const std::string whole = summary(parse_register_log({text, "log"}));
    RegisterLogReader reader("log", {});
    for (std::size_t at = 0; at < text.size();) {
      const auto size = static_cast<std::size_t>(random.below(random.one_in(3) ? 3 : 200));
      reader.read(std::string_view(text).substr(at, size));
      at += size;
    }
    ASSERT_EQ(summary(reader.finish()), whole) << "case " << i;
  }
}

// The peak of the resident memory since the last call, in MiB; 0 where the system does not say.
std::size_t peak_memory() {
  std::ifstream status("/proc/self/status");
  std::size_t kib = 0;
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) kib = std::stoul(line.substr(6));
  }
  std::ofstream("/proc/self/clear_refs") << "5";
  return kib / 1024;
}

// Feeds `bytes` bytes of a repeated piece; returns the log. It must take less than a microsecond a byte and little
// memory.
Parsed<RegisterLog> feed(const std::string& beginning, const std::string& piece, std::size_t bytes) {
  std::string block;
  while (block.size() < (std::size_t{1} << 16)) block += piece;
  const std::size_t before = peak_memory();
  const auto start = Clock::now();
  RegisterLogReader reader("log", {});
  reader.read(beginning);
  for (std::size_t read = 0; read < bytes; read += block.size()) reader.read(block);
  auto log = reader.finish();
  const std::chrono::duration<double> time = Clock::now() - start;
  const std::size_t after = peak_memory();
  if (!kSanitized) {
    EXPECT_LT(time.count(), 1e-6 * static_cast<double>(bytes)) << beginning << piece.substr(0, 100);
  }
  if (before > 0) {
    EXPECT_LT(after, before + 150) << beginning << piece.substr(0, 100);
  }
  return log;
}

TEST(RegisterLogHostile, OneLineOfAHundredMegabytesIsSkipped) {
  if (kSanitized) GTEST_SKIP() << "shows how long a text takes";
  constexpr std::size_t kBytes = 100'000'000;
  EXPECT_FALSE(feed("", "x", kBytes));
  EXPECT_FALSE(feed("", "0x1e60 0x101 ", kBytes));
  const auto log = feed("method,data\n0x1e60,0x101\n0x17fc,5\n", "0x17fc,5;", kBytes);
  ASSERT_TRUE(log) << all_faults(log);
  EXPECT_EQ(log->draws, 1U);
  EXPECT_EQ(log.notes.front().message, "1 line of more than 65536 bytes skipped; the first is line 4");
}

TEST(RegisterLogHostile, LongLogsTakeLinearTimeAndBoundedMemory) {
  if (kSanitized) GTEST_SKIP() << "shows how long a text takes";
  constexpr std::size_t kBytes = 60'000'000;
  const std::string draw =
      "nv2a_pgraph_method 0: 0x97 -> 0x17fc NV097_SET_BEGIN_END[0] 0x5\n"
      "nv2a_pgraph_method 0: 0x97 -> 0x1810 NV097_DRAW_ARRAYS[0] 0x2000000\n"
      "nv2a_pgraph_method 0: 0x97 -> 0x17fc NV097_SET_BEGIN_END[0] 0x0\n";
  const auto log = feed("nv2a_pgraph_method 0: 0x97 -> 0x1e60 NV097_SET_COMBINER_CONTROL[0] 0x101\n", draw, kBytes);
  ASSERT_TRUE(log) << all_faults(log);
  ASSERT_EQ(log->setups.size(), 1U);
  EXPECT_GT(log->draws, 290'000U);
  EXPECT_EQ(log->setups[0].draw_calls.size(), log->draws);
  for (const char* piece : {"0x17fc 0x0\n", "a_b_c d_e_f 0x12 ", "\n", "<command op=\"\n", "NV097_SET_X,1,2,3\n",
                            "-> 0x method 0x -> 0x", "<td>", "PB: 0x0 a.b = ", "\"", ",", "\t"}) {
    for (const char* beginning : {"", "method,data\n0x1e60,0x101\n", "0x1e60 0x101\n"}) {
      const auto other = feed(beginning, piece, kBytes / 12);
      EXPECT_NE(bool(other), !other.faults().empty()) << beginning << piece;
      EXPECT_LE(other.faults().size(), kMaxTextFaults);
    }
  }
}

TEST(RegisterLogHostile, MoreDrawsThanAreKeptAreCounted) {
  const auto log = feed("method,data\n1e60,101\n", "17fc,5\n17fc,0\n", 14 * (kMaxLogDraws + 200'000));
  ASSERT_TRUE(log) << all_faults(log);
  EXPECT_GT(log->draws, kMaxLogDraws + 199'000);
  EXPECT_EQ(log->setups[0].draw_calls.size(), kMaxLogDraws);
  EXPECT_TRUE(has(log.notes.back().message, "draws are counted, but not listed; the limit is 1000000"));
}

TEST(RegisterLogHostile, TooManySetUpsAreAFaultAtTheirLine) {
  const auto start = Clock::now();
  RegisterLogReader reader("log", {});
  reader.read("method,data\n0x1e60,0x101\n0xac0,0x01000000\n0x1e40,0xc0\n");
  for (int i = 0; i < 30'000; ++i) {
    reader.read("0xa60," + std::to_string(i) + "\n0x17fc,5\n0x17fc,0\n");
  }
  const auto log = reader.finish();
  const std::chrono::duration<double> time = Clock::now() - start;
  EXPECT_EQ(all_faults(log), "log:30006:1: more than 10000 different combiner set-ups\n");
  EXPECT_LT(time.count(), 20);
}

TEST(RegisterLogHostile, NoiseIsNotALog) {
  for (int i = 0; i < 200; ++i) {
    Random random(113, static_cast<std::uint64_t>(i));
    std::string noise;
    for (int k = 0; k < 5000; ++k) noise += static_cast<char>(random.byte());
    EXPECT_FALSE(is_register_log(noise)) << i;
    const auto log = parse_register_log({noise, fuzz::kFile});
    EXPECT_EQ(fuzz::wrong_with_answer(log, noise), "") << i;
  }
}

}  // namespace
}  // namespace ninebit::test
