// Logs of register writes: the styles of tools, columns, frames, draws, set-ups, notes and faults.
#include "ninebit/language/register_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/register_log_shapes.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kLogProfile = profiles::nv2a;
constexpr TraceWrite kFlip{0x12c, 0}, kStall{0x130, 0}, kClear{0x1d94, 0xf3};

RegisterLog read(const std::string& text, const RegisterLogOptions& options = {}) {
  auto parsed = parse_register_log({text, "log"}, options);
  EXPECT_TRUE(parsed) << all_faults(parsed) << text;
  return parsed ? *parsed : RegisterLog{};
}

std::string notes_of(const std::string& text, const RegisterLogOptions& options = {}) {
  std::string notes;
  for (const TextFault& note : parse_register_log({text, "log"}, options).notes) notes += note.text() + '\n';
  return notes;
}

std::string xemu_text(const Trace& trace) {
  return all_styles().front().text(trace);
}

// One stage that multiplies texture `unit` by the primary colour.
Trace simple_program(int unit, Random& random) {
  return writes_of({{"RC_IN_RGB[0]", 0x08040000 + (static_cast<std::uint32_t>(unit) << 24), {}},
                    {"RC_IN_ALPHA[0]", 0, {}},
                    {"RC_OUT_RGB[0]", 0xc0, {}},
                    {"RC_OUT_ALPHA[0]", 0, {}},
                    {"RC_FINAL0", 0xc, {}},
                    {"RC_FINAL1", 0x1c80, {}},
                    {"RC_ENABLE", 0x101, {}}},
                   random);
}

// Two frames with three programs, of which the first is used in both, twice each.
struct TwoFrames {
  Trace trace{};
  std::vector<CombinerState> states{};
};
TwoFrames two_frames(Random& random) {
  TwoFrames made;
  std::vector<Trace> programs;
  while (made.states.size() < 3) {
    const CombinerState state = random_state(random, kLogProfile);
    programs.push_back(writes_of(*encode_register_words(state, ChipClass::nv20, kLogProfile), random));
    made.states.push_back(state);
  }
  const auto use = [&](std::size_t program, std::uint32_t primitive) {
    // A program with fewer stages leaves words of an earlier one behind, as on the chip.
    made.trace.insert(made.trace.end(), programs[program].begin(), programs[program].end());
    add_draw(made.trace, primitive);
  };
  made.trace.push_back({0x1e70, 0x21});
  use(0, 5);
  use(1, 6);
  add_draw(made.trace, 8);
  made.trace.insert(made.trace.end(), {kFlip, kStall, {0x1e70, 0x23}});
  use(0, 7);
  use(2, 5);
  made.trace.insert(made.trace.end(), {kFlip, kStall});
  return made;
}

TEST(RegisterLog, EveryStyleGivesTheSameSetUps) {
  for (int i = 0; i < cases_here(40); ++i) {
    Random random(91, static_cast<std::uint64_t>(i));
    const TwoFrames made = two_frames(random);
    for (const TraceStyle& style : all_styles()) {
      const std::string text = style.text(made.trace);
      ASSERT_TRUE(is_register_log(text)) << style.name << '\n' << text.substr(0, 1000);
      const auto parsed = parse_register_log({text, "log"});
      ASSERT_TRUE(parsed) << style.name << all_faults(parsed);
      const RegisterLog& log = *parsed;
      ASSERT_EQ(log.setups.size(), 3U) << style.name << " case " << i;
      ASSERT_EQ(log.frames, 2U) << style.name;
      ASSERT_EQ(log.draws, 5U) << style.name;
      ASSERT_EQ(log.writes, made.trace.size()) << style.name;
      const std::uint64_t draws[] = {2, 2, 1};
      const std::uint32_t first[] = {1, 1, 2}, last[] = {2, 1, 2};
      for (std::size_t k = 0; k < 3; ++k) {
        const LogSetup& setup = log.setups[k];
        ASSERT_EQ(setup.draws, draws[k]) << style.name;
        ASSERT_EQ(setup.draw_calls.size(), draws[k]) << style.name;
        ASSERT_EQ(setup.first_frame, first[k]) << style.name;
        ASSERT_EQ(setup.last_frame, last[k]) << style.name;
        for (const LogDraw& draw : setup.draw_calls) ASSERT_EQ(draw.vertices, 3U) << style.name;
        std::vector<RegisterWord> other_words;
        const auto state = program_of(log, k + 1, "log", kLogProfile, &other_words);
        ASSERT_TRUE(state) << style.name << all_faults(state);
        ASSERT_EQ(normalize(*state, kLogProfile), normalize(made.states[k], kLogProfile))
            << style.name << " set-up " << k + 1;
        ASSERT_EQ(other_words.size(), 1U) << style.name;
        ASSERT_EQ(other_words[0].name, "PSTextureModes");
        ASSERT_EQ(other_words[0].value, k == 2 ? 0x23U : 0x21U) << style.name;
      }
      ASSERT_TRUE(log.setups[0].other_words_change) << style.name;
      ASSERT_EQ(log.setups[1].draw_calls[1].primitive, 8U) << style.name;
      const bool said = std::any_of(parsed.notes.begin(), parsed.notes.end(), [](const TextFault& note) {
        return note.message.starts_with("read as: method in column ");
      });
      ASSERT_EQ(said, style.guesses) << style.name;
    }
  }
}

TEST(RegisterLog, GuessedColumnsAreSaid) {
  Random random(92);
  Trace trace = simple_program(0, random);
  add_draw(trace, 5);
  const std::pair<const char*, const char*> notes[] = {
      {"two columns",
       "log:1:1: read as: method in column 1, data in column 2; a first line with the names of the columns"},
      {"class, method, data", "read as: method in column 7, data in column 9, class in column 5;"},
      {"data first", "read as: method in column 4, data in column 2;"},
      {"bare columns", "read as: method in column 1, data in column 2 (hexadecimal);"},
      {"a page", "read as: method in column 2, data in column 3;"},
  };
  for (const auto& [name, note] : notes) {
    for (const TraceStyle& style : all_styles()) {
      if (std::string(style.name) != name) continue;
      EXPECT_TRUE(has(notes_of(style.text(trace)), note)) << name;
    }
  }
}

TEST(RegisterLog, LinesOfDrawsAreThoseOfTheFile) {
  const std::string text =
      "# a "
      "comment\n\nmethod,data\n0x1e60,0x101\n0x17fc,0x5\n0x1810,0x08000000\n0x1810,0x00000000\n0x17fc,0\n0x17fc,6\n";
  const RegisterLog log = read(text);
  ASSERT_EQ(log.setups.size(), 1U);
  ASSERT_EQ(log.setups[0].draw_calls.size(), 2U);
  EXPECT_EQ(log.setups[0].first_line, 5U);
  EXPECT_EQ(log.setups[0].draw_calls[0].vertices, 10U);
  EXPECT_EQ(log.setups[0].draw_calls[1].line, 9U);
  EXPECT_EQ(log.setups[0].draw_calls[1].vertices, std::nullopt);
  EXPECT_EQ(log.lines, 9U);
  EXPECT_TRUE(has(notes_of(text), "log:9:1: the draw that begins here has no end"));
}

TEST(RegisterLog, VerticesAreCountedByWhatDrawsThem) {
  const auto vertices = [](const Trace& before, const Trace& inside) {
    Trace trace{{0x1e60, 0x101}};
    trace.insert(trace.end(), before.begin(), before.end());
    add_draw(trace, 5, inside);
    return read(xemu_text(trace)).setups[0].draw_calls[0].vertices;
  };
  EXPECT_EQ(vertices({}, {}), std::nullopt);
  EXPECT_EQ(vertices({}, {{0x1810, 0xff000010}, {0x1810, 0x04000110}}), 256U + 5U);
  EXPECT_EQ(vertices({}, {{0x1800, 1}, {0x1800, 2}, {0x1808, 3}}), 5U);
  // Positions of three and four floats, and of attribute 0.
  EXPECT_EQ(vertices({}, {{0x1500, 1}, {0x1504, 1}, {0x1508, 1}, {0x1518, 1}, {0x1524, 1}, {0x1a0c, 1}}), 3U);
  // Three floats, four bytes, two shorts: 20 bytes a vertex.
  const Trace formats{{0x1760, 0x32}, {0x176c, 0x40}, {0x1784, 0x25}, {0x1764, 0x02}};
  EXPECT_EQ(vertices(formats, Trace(15, {0x1818, 7})), 3U);
  EXPECT_EQ(vertices(formats, Trace(14, {0x1818, 7})), std::nullopt);
  EXPECT_EQ(vertices({}, Trace(15, {0x1818, 7})), std::nullopt);
  // A byte and a float: 8 bytes, as the float begins at a multiple of four.
  EXPECT_EQ(vertices({{0x1760, 0x10}, {0x1764, 0x12}}, Trace(6, {0x1818, 7})), 3U);
  // Xemu counts indices that it does not list, from 0.
  Trace trace{{0x1e60, 0x101}, {0x17fc, 5}};
  const std::string text = xemu_text(trace) +
                           "nv2a_pgraph_method_abbrev 0: 0x97 -> 0x1800 NV097_ARRAY_ELEMENT16 * 11\n" +
                           xemu_text({{0x17fc, 0}});
  EXPECT_EQ(read(text).setups[0].draw_calls[0].vertices, 24U);
}

TEST(RegisterLog, FramesEndAtFlipsBehindSomethingDrawn) {
  Trace trace{kStall, {0x1e60, 0x101}};
  add_draw(trace, 5);
  trace.insert(trace.end(), {kFlip, kStall, kStall, kClear, kFlip, kStall});
  add_draw(trace, 5);
  trace.push_back(kStall);
  add_draw(trace, 5);
  const RegisterLog log = read(xemu_text(trace));
  ASSERT_EQ(log.setups.size(), 1U);
  std::vector<std::uint32_t> frames;
  for (const LogDraw& draw : log.setups[0].draw_calls) frames.push_back(draw.frame);
  EXPECT_EQ(frames, (std::vector<std::uint32_t>{1, 3, 4}));  // frame 2 is only cleared
  const RegisterLog third = read(xemu_text(trace), {.frame = 3});
  EXPECT_EQ(third.draws, 1U);
  EXPECT_EQ(third.frames, 4U);
  // A column has frames of its own; flips change nothing then.
  const RegisterLog given =
      read("frame,method,data\n7,0x1e60,0x101\n7,0x17fc,5\n7,0x17fc,0\n7,0x130,0\n9,0x17fc,5\n9,0x17fc,0\n");
  EXPECT_EQ(given.setups[0].first_frame, 7U);
  EXPECT_EQ(given.setups[0].last_frame, 9U);
}

TEST(RegisterLog, SetUpsKeepTheirNumbersInEveryFrame) {
  Random random(93);
  const TwoFrames made = two_frames(random);
  const RegisterLog log = read(xemu_text(made.trace), {.frame = 2});
  ASSERT_EQ(log.setups.size(), 3U);
  EXPECT_EQ(log.setups[0].draws, 1U);
  EXPECT_EQ(log.setups[1].draws, 0U);
  EXPECT_EQ(log.setups[2].draws, 1U);
  EXPECT_EQ(log.setups[0].first_frame, 2U);
}

TEST(RegisterLog, WhatHasNoEffectMakesNoOtherSetUp) {
  Random random(94);
  Trace trace = simple_program(0, random);
  add_draw(trace, 5);
  const Trace without_effect = {
      {0xac4, 0x12345678},   // stage 1 does not run
      {0xa60, 0xffffffff},   // nothing reads a constant
      {0x1e20, 0xff00ff00},  // nor the final combiner's
      {0x1e60, 0x11001},     // no mux, no constants: the number of stages is the same
      {0x300, 1},            // alpha test
  };
  for (const TraceWrite& write : without_effect) {
    trace.push_back(write);
    add_draw(trace, 5);
  }
  EXPECT_EQ(read(xemu_text(trace)).setups.size(), 1U);
  for (const TraceWrite& write : {TraceWrite{0xac0, 0x09040000}, {0x1e40, 0x100c0}, {0x28c, 0x1c00}, {0x1e60, 0x102}}) {
    trace.push_back(write);
    add_draw(trace, 5);
  }
  EXPECT_EQ(read(xemu_text(trace)).setups.size(), 5U);
}

TEST(RegisterLog, ConstantsThatAreReadMakeSetUps) {
  Trace trace{{0x1e60, 0x11102},   {0xac0, 0x01040000}, {0x1e40, 0xc0},
              {0xac4, 0x0c010000}, {0x1e44, 0xc0},      {0x288, 0x2}};
  const auto draw = [&](std::uint32_t method, std::uint32_t data) {
    trace.push_back({method, data});
    add_draw(trace, 5);
  };
  draw(0xa60, 1);
  draw(0xa64, 2);   // of stage 1
  draw(0xa80, 3);   // constant 1 is not read by stages
  draw(0x1e24, 4);  // but by the final combiner
  draw(0xa68, 5);   // of stage 2, which does not run
  EXPECT_EQ(read(xemu_text(trace)).setups.size(), 3U);
  // With one constant for all stages, only stage 0's counts.
  draw(0x1e60, 0x102);
  draw(0xa64, 6);
  draw(0xa60, 7);
  EXPECT_EQ(read(xemu_text(trace)).setups.size(), 5U);
}

TEST(RegisterLog, OtherObjectsAreSkipped) {
  Random random(95);
  Trace trace = simple_program(0, random);
  trace.push_back({0xac0, 0xffffffff, 0x9f});  // a blit's
  trace.push_back({0x17fc, 5, 0x39});
  add_draw(trace, 5);
  for (const TraceStyle& style : all_styles()) {
    if (!style.classes) continue;
    const std::string text = style.text(trace);
    const RegisterLog log = read(text);
    ASSERT_EQ(log.setups.size(), 1U) << style.name;
    EXPECT_EQ(log.draws, 1U) << style.name;
    EXPECT_TRUE(program_of(log, 1, "log", kLogProfile)) << style.name;
    EXPECT_TRUE(has(notes_of(text), "2 lines with writes to other objects skipped")) << style.name;
  }
}

TEST(RegisterLog, CelsiusHasItsOwnMethods) {
  Random random(96);
  const CombinerState state = random_state(random, profiles::geforce2);
  const auto words = encode_register_words(state, ChipClass::nv10, profiles::geforce2);
  const std::pair<const char*, std::uint32_t> rows[] = {
      {"RC_IN_ALPHA", 0x260}, {"RC_IN_RGB", 0x268}, {"RC_COLOR", 0x270}, {"RC_OUT_ALPHA", 0x278},
      {"RC_OUT_RGB", 0x280},  {"RC_FINAL0", 0x288}, {"RC_FINAL1", 0x28c}};
  Trace trace;
  for (const RegisterWord& word : *words) {
    for (const auto& [name, number] : rows) {
      if (!word.name.starts_with(name)) continue;
      const std::size_t open = word.name.find('[');
      const std::uint32_t index = open == std::string::npos ? 0 : static_cast<std::uint32_t>(word.name[open + 1] - '0');
      trace.push_back({number + 4 * index, word.value, 0x56});
    }
  }
  trace.insert(trace.end(), {{0xdfc, 5, 0x56}, {0x1400, 0x05000000, 0x56}, {0xdfc, 0, 0x56}});
  const RegisterLog log = read(xemu_text(trace));
  EXPECT_EQ(log.chip, ChipClass::nv10);
  ASSERT_EQ(log.setups.size(), 1U);
  EXPECT_EQ(log.setups[0].draw_calls.at(0).vertices, 6U);
  const auto back = program_of(log, 0, "log", profiles::geforce2);
  ASSERT_TRUE(back) << all_faults(back);
  EXPECT_EQ(normalize(*back, profiles::geforce2), normalize(state, profiles::geforce2));
  // Without classes, the caller says which chip it is.
  for (TraceWrite& write : trace) write.object_class = 0x56;
  const std::string bare = all_styles()[13].text(trace);
  EXPECT_EQ(read(bare, {.chip = ChipClass::nv10}).setups.at(0).draws, 1U);
  EXPECT_EQ(read(bare, {.fallback = ChipClass::nv10}).chip, ChipClass::nv10);
}

TEST(RegisterLog, WordsThatTheLogDoesNotWriteAreZeroAndNoted) {
  const std::string text = "method,data\n0x1e60,0x101\n0x17fc,5\n0x17fc,0\n";
  const RegisterLog log = read(text);
  const auto state = program_of(log, 1, "log", kLogProfile);
  ASSERT_TRUE(state) << all_faults(state);
  ASSERT_EQ(state.notes.size(), 1U);
  EXPECT_EQ(state.notes[0].text(),
            "log:3:1: words that the log does not write before this draw count as 0: RC_IN_ALPHA[0], RC_IN_RGB[0], "
            "RC_OUT_ALPHA[0], RC_OUT_RGB[0] and 2 more");
  const auto unknown = program_of(read("method,data\n0xac0,0\n0x17fc,5\n0x17fc,0\n"), 1, "log", kLogProfile);
  EXPECT_EQ(
      all_faults(unknown),
      "log:3:1: the log does not write RC_ENABLE before this draw, so the number of general combiners is unknown\n");
}

TEST(RegisterLog, WritesWithoutDataAreUnknown) {
  Random random(97);
  Trace trace = simple_program(0, random);
  std::string text = xemu_text(trace);
  text += "nv2a_pgraph_method 0: 0x97 -> 0xac0 <NO_DATA>\n";
  text += "nv2a_pgraph_method 0: 0x97 -> 0x17fc 0x5\nnv2a_pgraph_method 0: 0x97 -> 0x17fc 0x0\n";
  text += "nv2a_pgraph_method 0: 0x97 -> 0xac0 0x08040000\nnv2a_pgraph_method 0: 0x97 -> 0x17fc 0x5\n";
  const RegisterLog log = read(text);
  ASSERT_EQ(log.setups.size(), 2U);
  EXPECT_EQ(all_faults(program_of(log, 1, "log", kLogProfile)),
            "log:8:1: the log has no data for RC_IN_RGB[0], which set-up 1 depends on\n");
  EXPECT_TRUE(program_of(log, 2, "log", kLogProfile));
  EXPECT_TRUE(has(notes_of(text), "log:8:1: 1 line with writes without data; the first is line 8"));
}

// Whether it begins or ends something is unknown, so that the draw around it goes on.
TEST(RegisterLog, ABeginningWithoutDataChangesNoDraw) {
  const std::string set_up = "method,data\n0x1e60,0x101\n", part = "0x1810,0x02000000\n";
  const RegisterLog inside = read(set_up + "0x17fc,5\n" + part + "0x17fc,\n" + part + "0x17fc,0\n" + part);
  ASSERT_EQ(inside.setups.size(), 1U);
  ASSERT_EQ(inside.setups[0].draw_calls.size(), 1U);
  EXPECT_EQ(inside.setups[0].draw_calls[0].vertices, 6U);
  EXPECT_FALSE(has(notes_of(set_up + "0x17fc,5\n" + part + "0x17fc,\n" + part + "0x17fc,0\n"), "no end"));
  const RegisterLog outside = read(set_up + "0x17fc,\n" + part + "0x17fc,5\n" + part + "0x17fc,0\n");
  ASSERT_EQ(outside.setups.at(0).draw_calls.size(), 1U);
  EXPECT_EQ(outside.setups[0].draw_calls[0].line, 5U);
  EXPECT_EQ(outside.setups[0].draw_calls[0].vertices, 3U);
}

TEST(RegisterLog, AFlipEndsADraw) {
  const std::string text = "method,data\n0x1e60,0x101\n0x17fc,5\n0x1810,0x02000000\n0x12c,0\n0x1810,0x02000000\n";
  const RegisterLog log = read(text);
  ASSERT_EQ(log.setups.at(0).draw_calls.size(), 1U);
  EXPECT_EQ(log.setups[0].draw_calls[0].vertices, 3U);
}

// In hexadecimal if one number of the column must be.
TEST(RegisterLog, BareDataWithALetter) {
  const RegisterLog log = read("method,data\n0x1e60,101\n0x1e40,c0\n0x17fc,5\n0x17fc,10\n");
  ASSERT_EQ(log.setups.size(), 1U);
  const std::map<std::string, std::uint32_t> expected{{"RC_ENABLE", 0x101}, {"RC_OUT_RGB[0]", 0xc0}};
  std::size_t found = 0;
  for (const RegisterWord& word : log.setups[0].words) {
    const auto at = expected.find(word.name);
    if (at == expected.end()) continue;
    EXPECT_EQ(word.value, at->second) << word.name;
    ++found;
  }
  EXPECT_EQ(found, expected.size());
  EXPECT_EQ(log.setups[0].draw_calls.at(0).primitive, 5U);
}

// Which bit a mux looks at matters if there is a mux with an output.
TEST(RegisterLog, AMuxWithoutOutputMakesNoOtherSetUp) {
  for (const auto& [output, set_ups] : {std::pair(0x40c0U, 1U), std::pair(0x4cd0U, 2U)}) {
    Trace trace{{0x1e60, 0x101}, {0xac0, 0x08040000}, {0x1e40, output}};
    add_draw(trace, 5);
    trace.push_back({0x1e60, 0x001});
    add_draw(trace, 5);
    EXPECT_EQ(read(xemu_text(trace)).setups.size(), set_ups) << std::hex << output;
  }
}

// NV10's number of stages is 1 or 2.
TEST(RegisterLog, StagesOfNv10) {
  for (const auto& [count, set_ups] : {std::pair(1U, 1U), std::pair(2U, 2U)}) {
    Trace trace{
        {0x260, 0, 0x56}, {0x268, 0x08040000, 0x56}, {0x278, 0, 0x56}, {0x280, 0xc0, 0x56}, {0x284, count << 28, 0x56}};
    const Trace draw{{0xdfc, 5, 0x56}, {0x1400, 0x02000000, 0x56}, {0xdfc, 0, 0x56}};
    trace.insert(trace.end(), draw.begin(), draw.end());
    trace.push_back({0x26c, 0x09040000, 0x56});  // an input of stage 1
    trace.insert(trace.end(), draw.begin(), draw.end());
    const RegisterLog log = read(xemu_text(trace));
    EXPECT_EQ(log.chip, ChipClass::nv10);
    EXPECT_EQ(log.setups.size(), set_ups) << count;
  }
}

TEST(RegisterLog, ALogWithoutDrawsHasItsLastWords) {
  Random random(98);
  const RegisterLog log = read(xemu_text(simple_program(2, random)));
  ASSERT_EQ(log.setups.size(), 1U);
  EXPECT_EQ(log.setups[0].draws, 0U);
  const auto state = program_of(log, 0, "log", kLogProfile);
  ASSERT_TRUE(state) << all_faults(state);
  EXPECT_EQ(state->general[0].rgb.a.reg, Register::texture2);
}

TEST(RegisterLog, NumbersOfSetUpsAreChecked) {
  Random random(99);
  const RegisterLog log = read(xemu_text(two_frames(random).trace));
  EXPECT_EQ(all_faults(program_of(log, 0, "f", kLogProfile)),
            "f:1:1: the log has 3 combiner set-ups; pick one with #1 to #3 behind the file's name\n");
  EXPECT_EQ(all_faults(program_of(log, 4, "f", kLogProfile)),
            "f:1:1: the log has 3 combiner set-ups; expected a number from 1 to 3\n");
}

TEST(RegisterLog, WhatTheChipRefusesIsAtItsLine) {
  const std::string text = "method,data\n0x1e60,0x101\n0x1e40,0xccc\n0xac0,0x06000000\n0x17fc,5\n0x17fc,0\n";
  const auto state = program_of(read(text), 1, "f", kLogProfile);
  const std::string faults = all_faults(state);
  EXPECT_TRUE(has(faults, "f:3:1: GL_INVALID_OPERATION"));
  EXPECT_TRUE(has(faults, "f:4:1: RC_IN_RGB[0] = 0x06000000: variable A"));
}

TEST(RegisterLog, FaultsOfTablesHaveTheirPlace) {
  struct Case {
    const char* text;
    const char* fault;
  };
  const Case cases[] = {
      {"", "f:1:1: no register writes in 0 lines; expected lines with a method and its data"},
      {"hello\nworld\n", "f:1:1: no register writes in 2 lines;"},
      {"method,data\n0xac0\n+,0x1\n",
       "f:3:1: '+' is not a method; expected one such as 0x0ac0 or NV097_SET_COMBINER_COLOR_ICW[0]"},
      {"method,data\n0xac0,0x08040000\n0x1e40,  banana\n",
       "f:3:10: 'banana' in column 2 is not a number of 32 bits; expected data"},
      {"method,data\n0xac0,0x1ffffffff\n", "f:2:7: '0x1ffffffff' in column 2 is not a number of 32 bits"},
      {"data,x,method\n0x0,1\n", "f:2:1: the line has 2 columns; expected a method in column 3"},
  };
  for (const Case& one : cases) {
    const auto parsed = parse_register_log({one.text, "f"});
    EXPECT_FALSE(parsed) << one.text;
    EXPECT_TRUE(has(all_faults(parsed), one.fault)) << one.text;
  }
  // Data of methods that nothing here depends on may be anything.
  EXPECT_TRUE(parse_register_log({"method,data\n0x1e60,0x101\n0x1500,1.5\nNV097_SET_X,banana\n", "f"}));
}

TEST(RegisterLog, MisspelledNamesAreNoted) {
  const std::string text = "method,data\nNV097_SET_COMBINER_COLOR_ICV[0],1\nNV097_SET_COMBINER_CONTROL,1\n";
  EXPECT_EQ(notes_of(text),
            "log:2:1: the method 'NV097_SET_COMBINER_COLOR_ICV[0]' is unknown; did you mean "
            "'NV097_SET_COMBINER_COLOR_ICW'?\n");
}

TEST(RegisterLog, SkippedLinesAreCounted) {
  Random random(100);
  const std::string text = "booting\n" + xemu_text(simple_program(0, random)) +
                           "nv2a_reg_write PVIDEO addr 0xb00 size 4 val 0x0\n" +
                           "nv2a_pgraph_flip_increment_write 0x0 -> 0x1\n\n";
  EXPECT_EQ(notes_of(text), "log:1:1: 3 lines are not register writes; the first is line 1\n");
  const std::string log = text + std::string(70'000, 'x') + "\n" + std::string(65'536, 'y') + "\n";
  EXPECT_TRUE(has(notes_of(log), "log:12:1: 1 line of more than 65536 bytes skipped; the first is line 12"));
}

TEST(RegisterLog, OtherTextsAreNot) {
  Random random(101);
  const auto words = print_register_words(random_state(random, kLogProfile), ChipClass::nv20, kLogProfile);
  for (const std::string& text :
       {std::string(), std::string("glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, 0x8523, 0x852c, 0x8536, 0x1907);\n"),
        std::string("!!RC1.0\nout.rgb = col0;\n"), std::string("{\"ninebit\": \"program\"}"), std::string("0x260\n"),
        std::string("tex0.r,primary.r\n1,2\n"), std::string("method\n"), std::string("1 2 3\n4 5 6\n"),
        std::string("# Y, U, V -> R, G, B\nY,U,V,R,G,B\n1,260,128,1,2,3\n2,264,129,1,2,3\n3,288,130,4,5,6\n")}) {
    EXPECT_FALSE(is_register_log(text)) << text;
  }
  EXPECT_FALSE(is_register_log(std::string("method,data\n0x1e60,1\n") + '\0'));
}

}  // namespace
}  // namespace ninebit::test
