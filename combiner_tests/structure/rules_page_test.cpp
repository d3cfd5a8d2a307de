// docs/numerics.md sends the readers of each rule to functions, profile fields and files that exist and hold it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) found.push_back((*it)[1].str());
  return found;
}

// The rules of the page, by number, each with the text up to the next one.
std::map<int, std::string> rules_of(const std::string& page) {
  const std::size_t begin = page.find("\n## The rules\n"), end = page.find("\n## ", begin + 1);
  if (begin == std::string::npos || end == std::string::npos) return {};
  const std::string section = page.substr(begin, end - begin);
  std::map<int, std::string> rules;
  const std::regex item("\n([0-9]+)\\. \\*\\*");
  for (std::sregex_iterator it(section.begin(), section.end(), item), last; it != last; ++it) {
    std::string rule = section.substr(static_cast<std::size_t>(it->position()) + 1);
    // A rule ends at the next one, or where a paragraph of the page follows the list.
    std::smatch next;
    if (std::regex_search(rule, next, std::regex("\n[0-9]+\\. \\*\\*|\n\n"))) {
      rule.resize(static_cast<std::size_t>(next.position()));
    }
    rules[std::stoi((*it)[1].str())] = rule;
  }
  return rules;
}

// Whether a comment in the text names the rule: "rule 21", "Rules 9 and 14", "rules 3 to 8".
bool names_rule(const std::string& text, int number) {
  const std::regex mention("[Rr]ules? ([0-9]+)(?:( to | and )([0-9]+))?(?: and ([0-9]+))?");
  for (std::sregex_iterator it(text.begin(), text.end(), mention), end; it != end; ++it) {
    const int first = std::stoi((*it)[1].str());
    const int second = (*it)[3].matched ? std::stoi((*it)[3].str()) : first;
    const int third = (*it)[4].matched ? std::stoi((*it)[4].str()) : first;
    const bool in_range = (*it)[2].str() == " to " && first <= number && number <= second;
    if (in_range || number == first || number == second || number == third) return true;
  }
  return false;
}

// The faults of the places to which a rule of the page sends its readers; empty: none.
std::string complaint(const fs::path& top, int number, const std::string& rule) {
  std::string places = text_of(top / "include/ninebit/combiner/arithmetic.inl") +
                       text_of(top / "include/ninebit/numerics/hardware_profile.h") +
                       text_of(top / "include/ninebit/numerics/fixed9.h");
  std::string wrong;
  for (const std::string& link : all_matches(rule, "\\]\\(\\.\\./([^)#]+)\\)")) {
    const std::string text = text_of(top / link);
    if (text.empty()) wrong += link + " does not exist; ";
    if (!names_rule(text, number)) wrong += link + " has no comment with rule " + std::to_string(number) + "; ";
    places += text;
  }
  for (const std::string& name : all_matches(rule, "`([a-z0-9_]+)`")) {
    if (name == "geforce2" || name == "nv2a") continue;
    if (!std::regex_search(places, std::regex("\\b" + name + "\\b"))) wrong += name + " is in none of the files; ";
  }
  return wrong;
}

TEST(RulesPage, EveryRuleIsWhereItSays) {
  const fs::path top = NINEBIT_SOURCE_DIR;
  const std::map<int, std::string> rules = rules_of(text_of(top / "docs/numerics.md"));
  ASSERT_EQ(rules.size(), 54U);
  int links = 0;
  for (const auto& [number, rule] : rules) {
    EXPECT_EQ(complaint(top, number, rule), "") << "rule " << number;
    EXPECT_TRUE(rule.find('`') != std::string::npos || rule.find("](../") != std::string::npos)
        << "rule " << number << " names neither a function nor a file";
    links += static_cast<int>(all_matches(rule, "\\]\\(\\.\\./([^)#]+)\\)").size());
  }
  EXPECT_GE(links, 9);
}

// Every rule of the arithmetic is named in its file.
TEST(RulesPage, TheArithmeticNamesItsRules) {
  const std::string arithmetic = text_of(fs::path(NINEBIT_SOURCE_DIR) / "include/ninebit/combiner/arithmetic.inl");
  for (const int number : {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 14, 22}) {
    EXPECT_TRUE(names_rule(arithmetic, number)) << "rule " << number;
  }
}

// The first and the last cell of a table's row.
struct TableRow {
  std::string first, last;
};

// The rows of all tables between two lines of a page, without their heads.
std::vector<TableRow> rows_of(const std::string& page, const std::string& heading, const std::string& end) {
  const std::size_t begin = page.find("\n" + heading + "\n"), stop = page.find("\n" + end, begin + 1);
  if (begin == std::string::npos || stop == std::string::npos) return {};
  std::vector<TableRow> rows;
  std::istringstream lines(page.substr(begin, stop - begin));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0 || line.rfind("| question |", 0) == 0) continue;
    const std::size_t last = line.rfind(" | ");
    rows.push_back({line.substr(2, line.find(" | ") - 2), line.substr(last + 3, line.size() - last - 5)});
  }
  return rows;
}

// What is open has a picture that would decide it, or a sentence why not; and no picture is without a question.
TEST(RulesPage, WhatIsOpenHasItsPictures) {
  const fs::path docs = fs::path(NINEBIT_SOURCE_DIR) / "docs";
  const std::string wanted = text_of(docs / "wanted.md");
  std::set<std::string> pictures, used, answered, open;
  for (const TableRow& row : rows_of(wanted, "## Combiners", "## Which picture decides what")) {
    EXPECT_TRUE(pictures.insert(row.first).second) << "two pictures have the name " << row.first;
  }
  for (const TableRow& row : rows_of(wanted, "## Which picture decides what", "## How to send them")) {
    EXPECT_TRUE(answered.insert(row.first).second) << row.first << " occurs twice";
    if (row.last.rfind("none: ", 0) == 0) continue;
    for (const std::string& name : all_matches(row.last + ";", "([^;]+);\\s*")) {
      EXPECT_TRUE(pictures.count(name) == 1) << "wanted.md has no picture " << name;
      used.insert(name);
    }
  }
  for (const TableRow& row : rows_of(text_of(docs / "numerics.md"), "## What is open", "A card can")) {
    EXPECT_TRUE(open.insert(row.first).second) << row.first << " occurs twice";
  }
  EXPECT_GE(open.size(), 40U);
  EXPECT_EQ(answered, open) << "the last table of wanted.md and numerics.md's list of what is open";
  EXPECT_EQ(used, pictures) << "pictures that decide something, and all pictures";
}

TEST(RulesPage, NoticesAWrongPlace) {
  const fs::path top = NINEBIT_SOURCE_DIR;
  EXPECT_NE(complaint(top, 21, "[tile.cpp](../src/raster/setup/no_such_file.cpp)"), "");
  EXPECT_NE(complaint(top, 21, "[polygon_offset.h](../src/raster/setup/polygon_offset.h)"), "");
  EXPECT_NE(complaint(top, 8, "`no_such_field`"), "");
  EXPECT_EQ(complaint(top, 21, "`subpixel_bits`, [window_transform.h](../src/raster/setup/window_transform.h)"), "");
  EXPECT_TRUE(names_rule("// Rules 3 to 8 and 22: returns", 5));
  EXPECT_TRUE(names_rule("// Rules 3 to 8 and 22: returns", 22));
  EXPECT_FALSE(names_rule("// Rules 3 to 8 and 22: returns", 2));
  EXPECT_FALSE(names_rule("// Rules 9 and 14.", 10));
}

}  // namespace
