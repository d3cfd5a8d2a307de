// Effects in ZIP archives: `draw` and `trace --effect` open them as they are; a damaged archive is one clear error.
#include <gtest/gtest.h>
#include <sys/syscall.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

using NamedFiles = std::vector<std::pair<std::string, std::string>>;

std::string number(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255U);
  return text;
}

// An archive of files that are not compressed but those of which `deflated` has the packed bytes.
std::string archive_of(const NamedFiles& files, const std::map<std::string, std::string>& deflated = {}) {
  std::string files_part, directory;
  for (const auto& [name, content] : files) {
    const auto found = deflated.find(content);
    const std::string& packed = found != deflated.end() ? found->second : content;
    const std::string facts = number(20, 2) + number(0, 2) + number(found != deflated.end() ? 8 : 0, 2) + number(0, 4) +
                              number(crc32_of(content), 4) + number(packed.size(), 4) + number(content.size(), 4) +
                              number(name.size(), 2) + number(0, 2);
    directory += "PK\1\2" + number(20, 2) + facts + std::string(10, '\0') + number(files_part.size(), 4) + name;
    files_part += "PK\3\4" + facts + name + packed;
  }
  return files_part + directory + "PK\5\6" + number(0, 4) + number(files.size(), 2) + number(files.size(), 2) +
         number(directory.size(), 4) + number(files_part.size(), 4) + number(0, 2);
}

const std::string kProgramText = "!!RC1.0\nout.rgb = col0.rgb;\nout.a = col0.a;\n";

// The same, deflated by zlib.
const std::string kDeflatedProgram(
    "\x53\x54\x0C\x72\x36\xD4\x33\xE0\xCA\x2F\x2D\xD1\x2B\x4A\x4F\x52\xB0\x55\x48\xCE\xCF\x31\x00\x31\xAD\xC1\x62"
    "\x89\x30\x91\x44\x6B\x2E\x00",
    34);

std::string effect_of(const std::string& color) {
  return R"({"ninebit": "effect", "version": 1, "size": [4, 4], "profile": "nv2a", "passes": [{"program": "lib/p.rc1", )"
         R"("primary": "constant:)" +
         color + "\"}]}";
}

NamedFiles two_effects() {
  return {{"a.json", effect_of("1,0,0")}, {"b.json", effect_of("0,0,1")}, {"lib/p.rc1", kProgramText}, {"notes/", ""}};
}

// A folder for temporary files of the programs that a test runs.
class OwnTemporaryFiles {
 public:
  OwnTemporaryFiles() { ::setenv("TMPDIR", folder_.path().c_str(), 1); }
  OwnTemporaryFiles(const OwnTemporaryFiles&) = delete;
  OwnTemporaryFiles& operator=(const OwnTemporaryFiles&) = delete;
  ~OwnTemporaryFiles() {
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path())) << "something stays behind";
    ::unsetenv("TMPDIR");
  }
  [[nodiscard]] std::string path() const { return folder_.path().string(); }

 private:
  TempFolder folder_;
};

TEST(Archive, TheFirstEffectAndNamedOnesAreDrawn) {
  const TempFolder folder;
  const std::string archive = folder / "frame.zip";
  write_bytes(archive, archive_of(two_effects()));
  const Json first = json_of(ninebit({"draw", archive, "-o", folder / "p.png", "--json", "--quiet"}));
  const Json second = json_of(ninebit({"draw", archive + "/b.json", "-o", folder / "p.png", "--json", "--quiet"}));
  EXPECT_NE(first["hash"]["color"], second["hash"]["color"]);
  EXPECT_TRUE(second["warnings"].empty()) << second["warnings"];
  ASSERT_EQ(first["warnings"].size(), 1U);
  const auto warning = first["warnings"][0].get<std::string>();
  expect_parts(warning, {"frame.zip/a.json is taken, the first of 2 effects"});
  EXPECT_TRUE(err_of(ninebit({"trace", "--effect", archive + "/b.json", "--pixel", "1,1"})).empty());
  expect_error(ninebit({"draw", archive + "/c.json", "-o", folder / "p.png"}), 3,
               {"frame.zip", "'c.json'", "expected one of its 2"});
}

TEST(Archive, WhatItHasOfItsOwnIsSaid) {
  const TempFolder folder;
  NamedFiles files = two_effects();
  files.emplace_back("profile.json", "{}");
  write_bytes(folder / "a.zip", archive_of(files));
  const Json drawn =
      json_of(ninebit({"draw", (folder / "a.zip") + "/a.json", "-o", folder / "p.png", "--json", "--quiet"}));
  ASSERT_EQ(drawn["warnings"].size(), 1U);
  expect_parts(drawn["warnings"][0].get<std::string>(), {"--profile profile.json"});
}

TEST(Archive, FaultsAreNamed) {
  const TempFolder folder;
  const std::string archive = folder / "a.zip";
  const auto refused = [&](const NamedFiles& files, const std::string& why) {
    write_bytes(archive, archive_of(files));
    expect_error(ninebit({"draw", archive, "-o", folder / "p.png"}), 3, {"a.zip", why});
  };
  refused({{"lib/p.rc1", kProgramText}}, "has no effect");
  refused({{"../a.json", effect_of("1,0,0")}}, "does not lie in it");
  refused({{"/a.json", effect_of("1,0,0")}}, "does not lie in it");
  refused({{"b\\a.json", effect_of("1,0,0")}}, "does not lie in it");
  refused({{"a.json", effect_of("1,0,0")}, {"a.json", effect_of("1,0,0")}}, "twice");
  refused({{"a.json", effect_of("1,0,0")}, {"./a.json", effect_of("0,1,0")}}, "'a.json' twice");
  refused({{"t/x.png", "1"}, {"t//x.png", "2"}}, "'t/x.png' twice");
  const std::string whole = archive_of(two_effects());
  for (std::size_t size = 4; size < whole.size(); size += 101) {
    write_bytes(archive, whole.substr(0, size));
    expect_error(ninebit({"draw", archive, "-o", folder / "p.png"}), 3, {"a.zip", "ends early"});
  }
  std::string changed = whole;
  changed[changed.find("!!RC1.0")] = '?';
  write_bytes(archive, changed);
  expect_error(ninebit({"draw", archive, "-o", folder / "p.png"}), 3, {"a.zip", "'lib/p.rc1' has other bytes"});
}

TEST(Archive, WhatIsNotReadIsRefusedByTheTrueReason) {
  const TempFolder folder;
  const OwnTemporaryFiles temporary;
  const std::string archive = folder / "a.zip", whole = archive_of({{"a.json", effect_of("1,0,0")}});
  const std::size_t directory = whole.find("PK\1\2"), end = whole.find("PK\5\6");
  const auto refused = [&](std::size_t at, const std::string& bytes, const std::string& why) {
    std::string changed = whole;
    changed.replace(at, bytes.size(), bytes);
    write_bytes(archive, changed);
    expect_error(ninebit({"draw", archive, "-o", folder / "p.png"}), 3, {"a.zip", why});
  };
  const std::string four(4, '\xFF');
  refused(directory + 8, "\1", "has 'a.json' encrypted");
  refused(directory + 10, "\14", "packed in another way than by deflate");
  refused(directory + 20, four, "'a.json' as a ZIP64 entry");
  refused(directory + 24, four, "'a.json' as a ZIP64 entry");
  refused(directory + 42, four, "'a.json' as a ZIP64 entry");
  refused(end + 10, "\xFF\xFF", "is a ZIP64 archive");
  refused(end + 16, four, "is a ZIP64 archive");
  refused(directory + 46, "b", "has another name");
}

// One rule says what an effect is, in an archive and outside.
TEST(Archive, EffectsAreJudgedOnceByTheirText) {
  const TempFolder folder;
  const OwnTemporaryFiles temporary;
  const std::string late = "{" + std::string(5000, ' ') + effect_of("1,0,0").substr(1);
  for (const std::string& effect : {"\n " + effect_of("1,0,0"), late}) {
    const NamedFiles files{{"a.json", effect}, {"lib/p.rc1", kProgramText}};
    std::filesystem::create_directories(folder / "lib");
    for (const auto& [name, content] : files) write_bytes(folder / name, content);
    write_bytes(folder / "a.zip", archive_of(files, {{kProgramText, kDeflatedProgram}}));
    for (const char* const name : {"a.json", "a.zip", "a.zip/./a.json"}) {
      const Json drawn = json_of(ninebit({"draw", folder / name, "-o", folder / "p.png", "--json", "--quiet"}));
      EXPECT_TRUE(drawn.contains("effect")) << name;
    }
  }
}

// The folder in which an archive is unpacked is gone when somebody reads its name.
TEST(Archive, MessagesNameTheArchive) {
  const TempFolder folder;
  const OwnTemporaryFiles temporary;
  const std::string archive = folder / "a.zip";
  const auto refused = [&](const NamedFiles& files, const std::string& where) {
    write_bytes(archive, archive_of(files));
    for (const Words& words : {Words{"draw", archive, "-o", folder / "p.png", "--json"},
                               Words{"trace", "--effect", archive, "--pixel", "1,1", "--json"}}) {
      const Outcome outcome = ninebit(words);
      EXPECT_EQ(outcome.code, 3) << outcome.err;
      for (const std::string& text : {outcome.out, outcome.err}) {
        expect_parts(text, {"a.zip/" + where});
        EXPECT_EQ(text.find(temporary.path()), std::string::npos) << text;
      }
    }
  };
  refused({{"a.json", effect_of("1,0,0")}}, "lib/p.rc1");
  refused({{"a.json", effect_of("1,0,0")}, {"lib/p.rc1", "!!RC1.0\nout.rgb = no;\n"}}, "lib/p.rc1");
  refused({{"t/a.json", R"({"ninebit": "effect", "version": 1})"}}, "t/a.json");
}

TEST(Archive, AnInterruptLeavesNothingBehind) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "the leak sanitizer does not work in a traced program";
  const TempFolder folder;
  const OwnTemporaryFiles temporary;
  write_bytes(folder / "a.zip", archive_of(two_effects()));
  Child child({"draw", folder / "a.zip", "-o", folder / "p.png"}, {.traced = true});
  if (!child.run_to([](std::uint64_t call) { return call == SYS_mkdir; })) {
    const Outcome outcome = child.wait();
    if (outcome.code == 126) GTEST_SKIP() << "tracing is not allowed here";
    FAIL() << "it ended before it unpacked: " << outcome.err;
  }
  child.send(SIGTERM);
  child.let_go();
  EXPECT_EQ(child.wait().code, 128 + SIGTERM);
  EXPECT_FALSE(std::filesystem::exists(folder / "p.png"));
}

// A change of any byte of a heading is refused or changes nothing, and nothing stays behind.
TEST(Archive, DamagedHeadings) {
  const TempFolder folder;
  const OwnTemporaryFiles temporary;
  const std::string whole = archive_of(two_effects(), {{kProgramText, kDeflatedProgram}}), archive = folder / "a.zip";
  const auto drawn = [&](const std::string& bytes) {
    write_bytes(archive, bytes);
    return ninebit({"draw", archive + "/a.json", "-o", folder / "p.png", "--quiet", "--json"});
  };
  const Json expected = json_of(drawn(whole))["hash"];
  const std::size_t directory = whole.find("PK\1\2");
  for (std::size_t at = directory; at < whole.size(); at += 7) {
    std::string changed = whole;
    changed[at] = static_cast<char>(~changed[at]);
    const Outcome outcome = drawn(changed);
    if (outcome.code == 0) {
      EXPECT_EQ(json_of(outcome)["hash"], expected) << at;
    } else {
      EXPECT_EQ(outcome.code, 3) << at << ": " << outcome.err;
      EXPECT_NE(outcome.err.find("a.zip"), std::string::npos) << at << ": " << outcome.err;
    }
  }
}

}  // namespace
}  // namespace tools_test
