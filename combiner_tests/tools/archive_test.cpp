// Effects in ZIP archives: `draw` and `trace --effect` open them as they are; a damaged archive is one clear error.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

using NamedFiles = std::vector<std::pair<std::string, std::string>>;

std::string number(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255U);
  return text;
}

std::uint32_t checksum(const std::string& text) {
  std::uint32_t value = ~0U;
  for (const char c : text) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = value >> 1U ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~value;
}

// An archive of files that are not compressed.
std::string archive_of(const NamedFiles& files) {
  std::string files_part, directory;
  for (const auto& [name, content] : files) {
    const std::string facts = number(20, 2) + number(0, 8) + number(checksum(content), 4) + number(content.size(), 4) +
                              number(content.size(), 4) + number(name.size(), 2) + number(0, 2);
    directory += "PK\1\2" + number(20, 2) + facts + number(0, 10) + number(files_part.size(), 4) + name;
    files_part += "PK\3\4" + facts + name + content;
  }
  return files_part + directory + "PK\5\6" + number(0, 4) + number(files.size(), 2) + number(files.size(), 2) +
         number(directory.size(), 4) + number(files_part.size(), 4) + number(0, 2);
}

const std::string kProgramText = "!!RC1.0\nout.rgb = col0.rgb;\nout.a = col0.a;\n";

std::string effect_of(const std::string& color) {
  return R"({"ninebit": "effect", "version": 1, "size": [4, 4], "profile": "nv2a", "passes": [{"program": "lib/p.rc1", )"
         R"("primary": "constant:)" +
         color + "\"}]}";
}

NamedFiles two_effects() {
  return {{"a.json", effect_of("1,0,0")}, {"b.json", effect_of("0,0,1")}, {"lib/p.rc1", kProgramText}, {"notes/", ""}};
}

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
  EXPECT_NE(warning.find("frame.zip/a.json is taken, the first of 2 effects"), std::string::npos) << warning;
  const Outcome traced = ninebit({"trace", "--effect", archive + "/b.json", "--pixel", "1,1"});
  EXPECT_EQ(traced.code, 0) << traced.err;
  EXPECT_TRUE(traced.err.empty()) << traced.err;
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
  EXPECT_NE(drawn["warnings"][0].get<std::string>().find("--profile profile.json"), std::string::npos);
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
  const std::string whole = archive_of(two_effects());
  for (std::size_t size = 4; size < whole.size(); size += 37) {
    write_bytes(archive, whole.substr(0, size));
    expect_error(ninebit({"draw", archive, "-o", folder / "p.png"}), 3, {"a.zip", "ends early"});
  }
  std::string changed = whole;
  changed[changed.find("!!RC1.0")] = '?';
  write_bytes(archive, changed);
  expect_error(ninebit({"draw", archive, "-o", folder / "p.png"}), 3, {"a.zip", "'lib/p.rc1' has other bytes"});
}

// A change of any byte of a heading is refused or changes nothing, and nothing stays behind.
TEST(Archive, DamagedHeadings) {
  const TempFolder folder;
  const std::string whole = archive_of(two_effects()), archive = folder / "a.zip";
  const std::size_t directory = whole.find("PK\1\2");
  for (std::size_t at = directory; at < whole.size(); at += 5) {
    std::string changed = whole;
    changed[at] = static_cast<char>(~changed[at]);
    write_bytes(archive, changed);
    const Outcome outcome = ninebit({"draw", archive + "/a.json", "-o", folder / "p.png", "--quiet"});
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << at << ": " << outcome.err;
    if (outcome.code == 3) {
      EXPECT_NE(outcome.err.find(": "), std::string::npos) << at;
    }
  }
}

}  // namespace
}  // namespace tools_test
