// `ninebit vectors`, its runner with right and broken emulators, and `ninebit verify` of what the runner wrote.
#include "ninebit/study/vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "combiner_tests/tools/support.h"
#include "combiner_tests/tools/vector_runner.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/json.h"

namespace tools_test {
namespace {

const std::string kEmulator = NINEBIT_SOURCE_DIR "/docs/tutorials/combiner.c";
const std::string kReader = NINEBIT_SOURCE_DIR "/docs/tutorials/read_vectors.c";
const std::string kMux = "'-DMUX_BY_MSB(c)=((c)>>8&1)' ", kRight = kMux + "-DROUNDS=1 -DHALF=128";

Words make_pack(const std::string& folder, const Words& more = {}) {
  return Words{"vectors", "-o", folder, "--profile", "nv2a", "--quiet", "--programs", "1200", "--fragments", "6"} +
         more;
}

// The pack that the tests read, made once.
const std::string& pack() {
  static const TempFolder folder;
  static const std::string made = [] {
    const Outcome outcome = ninebit(make_pack(folder / "pack"));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return folder / "pack";
  }();
  return made;
}

const Checked& check(const std::string& flags) {
  return check_emulator(pack(), kEmulator, flags);
}

Json verdict(const std::string& results, int code) {
  return json_of(ninebit({"verify", results, "--vectors", pack(), "--json"}), code);
}

class Vectors : public testing::Test {
 protected:
  TempFolder folder_;
};

TEST_F(Vectors, TheDefaultPackIsSmallAndItsFilesAreNamed) {
  const std::string folder = folder_ / "pack";
  const Outcome outcome = ninebit({"vectors", "-o", folder, "--profile", "nv2a"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("pack ")) << outcome.out;
  expect_parts(outcome.out, {": 10000 programs, 16 fragments each, seed 1\n"});
  std::size_t bytes = 0;
  const Files files = files_in(folder);
  for (const auto& [name, content] : files) {
    bytes += content.size();
    expect_parts(outcome.err, {"wrote " + folder + "/" + name + "\n"});
  }
  EXPECT_EQ(files.size(), 3U);
  EXPECT_LE(bytes, 6'000'000U);
}

TEST_F(Vectors, Answers) {
  const Json object = json_of(
      ninebit({"vectors", "-o", folder_ / "a", "--programs", "200", "--fragments", "3", "--seed", "9", "--json"}));
  EXPECT_EQ(keys_of(object),
            (Words{"command", "version", "profile", "chip", "seed", "programs", "fragments", "id", "rows", "files"}));
  EXPECT_EQ(object["profile"], "geforce2");
  EXPECT_EQ(object["chip"], "nv10");
  EXPECT_EQ(keys_of(object["rows"][0]), (Words{"group", "rules", "what", "programs"}));
  std::size_t programs = 0;
  for (const Json& row : object["rows"]) programs += row["programs"].get<std::size_t>();
  EXPECT_EQ(programs, 200U);
}

TEST_F(Vectors, TheJsonOfAProgramIsThatOfItsWords) {
  const auto read = ninebit::read_vector_pack(read_bytes(pack() + "/vectors.txt"), "v.txt", ninebit::profiles::nv2a);
  ASSERT_TRUE(read.ok()) << read.error().text();
  std::istringstream lines(shell("gzip -dc '" + pack() + "/programs.jsonl.gz'").first);
  std::size_t program = 0;
  for (std::string line; std::getline(lines, line); ++program) {
    const auto parsed = ninebit::parse_json_program({line, "p"}, ninebit::profiles::nv2a);
    ASSERT_TRUE(parsed) << parsed.faults().front().text();
    ASSERT_LT(program, read->programs.size());
    EXPECT_EQ(ninebit::normalize(*parsed, ninebit::profiles::nv2a),
              ninebit::normalize(read->programs[program].state, ninebit::profiles::nv2a))
        << line;
  }
  EXPECT_EQ(program, read->programs.size());
}

TEST_F(Vectors, ARightEmulatorPasses) {
  const Checked& right = check(kRight);
  EXPECT_EQ(right.status, 0);
  EXPECT_EQ(right.text, "profile nv2a: 7200 fragments, 0 differ; 65 of 65 groups pass\n");
  const Json object = verdict(right.results, 0);
  EXPECT_EQ(object["count"], 7200);
  EXPECT_EQ(object["agree"], 7200);
  EXPECT_TRUE(object["mistakes"].empty());
  const Outcome outcome = ninebit({"verify", right.results, "--vectors", pack() + "/vectors.txt", "--profile", "nv2a"});
  EXPECT_EQ(outcome.out, "7200 fragments of 1200 programs: 7200 agree, 0 differ\n");
}

struct Broken {
  std::string flags;
  const char *group, *mistake;
};

// Three emulators that are wrong in one thing each, and others.
TEST_F(Vectors, BrokenEmulatorsAreNamed) {
  const Broken cases[] = {
      {kMux + "-DROUNDS=0 -DHALF=127.5", "mapping-half-bias-normal (rule 4)", "arithmetic = exact"},
      {kRight + " -DCLAMPS_NEGATIVE=0", "negative-texels (rules 2,15)", "negative inputs are not clamped to 0"},
      {"-DROUNDS=1 -DHALF=128 '-DMUX_BY_MSB(c)=!((c)>>8&1)'", "mux-threshold (rules 11,22)",
       "mux by the other bit of spare0's alpha"},
      {"-DROUNDS=1 -DHALF=128 '-DMUX_BY_MSB(c)=1'", "mux-lowest-bit (rule 11)",
       "mux always by the threshold of spare0's alpha"},
      {kMux + "-DROUNDS=1 -DHALF=127", "mapping-half-bias-normal (rule 4)", "half = 127"},
  };
  for (const Broken& broken : cases) {
    SCOPED_TRACE(broken.flags);
    const auto& [program, text, results, status] = check(broken.flags);
    EXPECT_EQ(status, 1);
    EXPECT_TRUE(text.starts_with("first failing group: " + std::string(broken.group) + ": ")) << text;
    expect_parts(text, {"\n  program ", "\n  RC_ENABLE = 0x", "\n  tex0 ", "\n  after stage 0: spare0.r ",
                        "\n  expected ", "\n  got ", "\ngroups that differ:\n"});
    const Json object = verdict(results, 1);
    ASSERT_FALSE(object["mistakes"].empty());
    EXPECT_EQ(object["mistakes"][0]["mistake"], broken.mistake) << object["mistakes"].dump();
    EXPECT_EQ(object["mistakes"][0]["agree_then"], object["count"]) << object["mistakes"].dump();
    EXPECT_EQ(object["mistakes"][0]["explains"], object["differ"]);
    expect_parts(out_of(ninebit({"verify", results, "--vectors", pack(), "--most", "2"}), 1),
                 {"\nOne mistake explains all of them: " + std::string(broken.mistake)});
  }
}

// Two mistakes at once: neither explains all, the plan has both, each with a program and a fragment.
TEST_F(Vectors, TwoMistakesArePlanned) {
  const Checked& checked = check("-DROUNDS=1 -DHALF=127");
  EXPECT_EQ(checked.status, 1);
  const Json object = verdict(checked.results, 1);
  const Json& plan = object["plan"];
  ASSERT_EQ(plan.size(), 2U) << plan.dump();
  EXPECT_EQ(keys_of(plan[0]), (Words{"mistake", "rules", "group", "explains", "share", "breaks", "same", "program",
                                     "fragment", "shown", "expected", "calls", "inputs"}));
  EXPECT_EQ(plan[0]["mistake"], "half = 127");
  EXPECT_EQ(plan[1]["mistake"], "mux always by the threshold of spare0's alpha");
  EXPECT_EQ(object["unexplained"], 0);
  int explained = 0;
  for (const Json& step : plan) explained += step["explains"].get<int>() - step["breaks"].get<int>();
  EXPECT_EQ(explained, object["differ"].get<int>());
  EXPECT_NEAR(plan[0]["share"].get<double>() + plan[1]["share"].get<double>(), 1.0, 0.01);
  // The program and the fragment of a step give what is expected, and not what is shown.
  const std::string program = write_bytes(folder_ / "step.gl", plan[0]["calls"].get<std::string>());
  Words trace{"trace", program, "--profile", "nv2a", "--json"};
  std::istringstream inputs(plan[0]["inputs"].get<std::string>());
  for (std::string one; inputs >> one;) {
    trace.emplace_back("--set");
    trace.push_back(one);
  }
  const Outcome traced = ninebit(trace);
  EXPECT_EQ(traced.code, 0) << traced.err;
  EXPECT_EQ(json_of(traced)["out"]["bytes"], plan[0]["expected"]) << traced.out;
  EXPECT_NE(plan[0]["shown"], plan[0]["expected"]);
  // The mux by the lowest bit is not in GL: its program is words.
  expect_parts(plan[1]["calls"].get<std::string>(), {"RC_OUT_RGB[0] = 0x"});
  const Outcome outcome = ninebit({"verify", checked.results, "--vectors", pack(), "--most", "0"});
  expect_parts(outcome.out, {"\n1. half = 127 (rules 4, 11): explains ", "\nTogether they explain all of them.\n"});
}

TEST_F(Vectors, QuickPacksAreSmall) {
  const Json object = json_of(ninebit({"vectors", "-o", folder_ / "quick", "--profile", "nv2a", "--quick", "--json"}));
  EXPECT_EQ(object["programs"], 2000);
  expect_error(ninebit({"vectors", "-o", folder_ / "x", "--quick", "--programs", "100"}), 2, {"--quick"});
  expect_error(ninebit({"vectors", "-o", folder_ / "x", "--profile", "nv2a", "--quick", "--texture-shader"}), 2,
               {"--quick", "--programs"});
}

// With combine_stage the runner names the emulator's first wrong register.
TEST_F(Vectors, StagesAreCompared) {
  const auto& [program, text, results, status] = check(kMux + "-DCOMBINE_STAGE -DROUNDS=1 -DHALF=127");
  EXPECT_EQ(status, 1);
  const std::size_t stage = text.find("\n  after stage 0: ");
  ASSERT_NE(stage, std::string::npos) << text;
  expect_parts(text.substr(stage, text.find('\n', stage + 1) - stage), {" (yours is "});
}

// The runner prints a program in each of the layouts of an emulator's words, and all are read as the same program.
TEST_F(Vectors, TheRunnerPrintsAProgramAsWords) {
  const std::string run = "'" + check(kRight).program + "' '" + pack() + "/vectors.txt' --print ";
  const auto explained = [&](const std::string& flags) {
    const auto [text, status] = shell(run + "1100" + flags);
    EXPECT_EQ(status, 0) << text;
    const Outcome outcome =
        ninebit({"convert", write_bytes(folder_ / "p.words", text), "--to", "json", "--profile", "nv2a"});
    EXPECT_EQ(outcome.code, 0) << outcome.err << text;
    return std::pair(text, outcome.out);
  };
  const auto [names, program] = explained("");
  EXPECT_TRUE(names.starts_with("RC_ENABLE = 0x")) << names;
  const auto [registers, same] = explained(" --pgraph");
  EXPECT_TRUE(registers.starts_with("NV_PGRAPH_COMBINECTL = 0x")) << registers;
  EXPECT_EQ(same, program);
  const auto [addresses, also] = explained(" --address");
  EXPECT_TRUE(addresses.starts_with("0x401940 = 0x")) << addresses;
  EXPECT_EQ(also, program);
  EXPECT_EQ(shell(run + "5000").second, 2);
}

TEST_F(Vectors, ThirtyLinesOfCReadAPack) {
  const std::string program = folder_ / "read", source = read_bytes(kReader);
  EXPECT_LE(std::count(source.begin(), source.end(), '\n'), 30);
  for (const std::string& flags : {kRight, kMux + "-DROUNDS=1 -DHALF=127"}) {
    const auto [messages, compiled] = shell("cc -std=c99 -pedantic -Wall -Wextra -Werror " + flags + " '" + kReader +
                                            "' '" + kEmulator + "' -o '" + program + "'");
    ASSERT_EQ(compiled, 0) << messages;
    const auto [text, status] = shell("cd '" + pack() + "' && '" + program + "'");
    const bool is_right = flags == kRight;
    EXPECT_EQ(status, is_right ? 0 : 1) << text;
    EXPECT_TRUE(!is_right || text == "0 of 7200 fragments are wrong\n") << text;
  }
}

TEST_F(Vectors, TheRunnerReportsWhatItCannotRead) {
  const std::string text = read_bytes(pack() + "/vectors.txt"), program = "'" + check(kRight).program + "'";
  const auto run = [&](const std::string& bytes) {
    write_bytes(folder_ / "v.txt", bytes);
    return shell(program + " '" + (folder_ / "v.txt") + "'");
  };
  using Answer = std::pair<std::string, int>;
  EXPECT_EQ(run("hello\n"), Answer("runner: cannot read a pack from " + (folder_ / "v.txt") + "\n", 2));
  EXPECT_EQ(shell(program).second, 2);
  const Answer cut = run(text.substr(0, text.rfind("\np ") + 1));
  EXPECT_EQ(cut.second, 2);
  expect_parts(cut.first, {"the pack is cut off: 'end' is missing"});
  std::string wrong = text;
  wrong.replace(wrong.find("\nbase "), 6, "\nbase x");
  const Answer words = run(wrong);
  EXPECT_EQ(words.second, 2);
  expect_parts(words.first, {": wrong words\n"});
}

TEST_F(Vectors, ResultsThatCannotBeJudged) {
  const std::string text = read_bytes(check(kRight).results), results = write_bytes(folder_ / "results.txt", text);
  expect_error(ninebit({"verify", results}), 3, {"vectors.txt", "No such file"});
  expect_error(ninebit({"verify", results, "--vectors", results}), 3, {"results.txt:1", "expected a pack"});
  expect_error(ninebit({"verify", results, "--vectors", pack(), "--profile", "geforce2"}), 3,
               {"vectors.txt:2", "the pack is of profile nv2a, not of geforce2"});
  expect_error(ninebit({"verify", results, "--vectors", pack(), "--program", "x.gl"}), 2, {"--vectors", "--program"});
  write_bytes(results, text.substr(0, text.size() - 4));
  expect_error(ninebit({"verify", results, "--vectors", pack()}), 3,
               {"results.txt:1201", "expected 6 colours of 8 hexadecimal digits"});
  write_bytes(results, text);
  EXPECT_EQ(ninebit({"verify", "-", "--vectors", pack()}, {.in = results}).code, 0);
  std::filesystem::copy(pack() + "/vectors.txt", folder_ / "vectors.txt");
  EXPECT_EQ(ninebit({"verify", results}).code, 0) << "the pack is beside it";
}

// Parts of a pack may be run; the first program without results is named with its line. Line N + 1 has program N.
TEST_F(Vectors, ProgramsWithoutResultsAreNamed) {
  const std::string text = read_bytes(check(kRight).results), results = folder_ / "results.txt";
  EXPECT_EQ(verdict(check(kRight).results, 0)["missing"], nullptr);
  const auto line_at = [&](int line) {
    std::size_t at = 0;
    for (int i = 1; i < line; ++i) at = text.find('\n', at) + 1;
    return at;
  };
  struct Case {
    int line, end;  // lines [line, end) are taken out
    const char* said;
  };
  for (const Case& c : {Case{5, 6, ":5: program 4 is missing; 1199 of 1200 programs have results\n"},
                        Case{2, 4, ":2: program 1 is missing; 1198 of 1200 programs have results\n"},
                        Case{301, 1202, ":301: program 300 is missing; 299 of 1200 programs have results\n"}}) {
    SCOPED_TRACE(c.said);
    write_bytes(results, text.substr(0, line_at(c.line)) + text.substr(line_at(c.end)));
    const std::string outcome = out_of(ninebit({"verify", results, "--vectors", pack()}));
    EXPECT_TRUE(outcome.starts_with(results + c.said)) << outcome;
    const Json missing = verdict(results, 0)["missing"];
    EXPECT_EQ(missing, (Json{{"programs", c.end - c.line}, {"first", c.line - 1}, {"line", c.line}})) << missing.dump();
  }
}

// A profile of one's own has packs, too; verify needs its file.
TEST_F(Vectors, OfAProfileOfOnesOwn) {
  const std::string own = write_bytes(folder_ / "own.json", R"({"base": "nv2a", "name": "mine", "half": 127})");
  const std::string folder = folder_ / "own";
  ASSERT_EQ(ninebit({"vectors", "-o", folder, "--profile", own, "--programs", "300", "--fragments", "4"}).code, 0);
  const Checked& checked = check_emulator(folder, kEmulator, kMux + "-DROUNDS=1 -DHALF=127");
  EXPECT_EQ(checked.status, 0);
  expect_error(ninebit({"verify", checked.results, "--vectors", folder}), 3,
               {"profile mine", "give its file with --profile"});
  EXPECT_EQ(ninebit({"verify", checked.results, "--vectors", folder, "--profile", own}).code, 0);
}

TEST_F(Vectors, OtherFilesOfTheFolderStay) {
  std::filesystem::create_directories(folder_ / "pack");
  write_bytes(folder_ / "pack/notes.txt", "mine");
  ASSERT_EQ(ninebit(make_pack(folder_ / "pack", {"--seed", "2"})).code, 0);
  EXPECT_NE(read_bytes(folder_ / "pack/vectors.txt"), read_bytes(pack() + "/vectors.txt"));
  EXPECT_EQ(read_bytes(folder_ / "pack/notes.txt"), "mine");
  EXPECT_EQ(files_in(folder_ / "pack").size(), 4U);
}

TEST_F(Vectors, AnInterruptLeavesNothing) {
  const std::string folder = folder_ / "pack";
  Child child({"vectors", "-o", folder, "--programs", "100000", "--fragments", "80", "--threads", "1"});
  child.until([&] { return std::filesystem::exists(folder); });
  child.send(SIGINT);
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(Vectors, WrongUsage) {
  expect_error(ninebit({"vectors"}), 2, {"--output"});
  expect_error(ninebit({"vectors", "-o", folder_ / "x", "--programs", "3"}), 2,
               {"--programs", "3 is too few", "expected at least"});
  expect_error(ninebit({"vectors", "-o", folder_ / "x", "--programs", "100000", "--fragments", "256"}), 2,
               {"--programs", "too many", "expected at most 8388608 fragments"});
  write_bytes(folder_ / "file", "");
  expect_error(ninebit({"vectors", "-o", folder_ / "file/x", "--programs", "100"}), 4, {"file/x"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x"));
}

}  // namespace
}  // namespace tools_test
