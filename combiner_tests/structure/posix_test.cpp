// One room holds all calls that are not in the standard library of every system.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

// The first POSIX header that a text includes, or POSIX function that it calls by its global name; or nothing.
std::string posix_in(const std::string& text) {
  static const std::regex header(
      R"(#include <((?:sys|arpa|linux|netinet)/[a-z]+\.h|(?:dlfcn|fcntl|poll|pthread|pwd|sched|signal|spawn|stdlib|termios|unistd)\.h)>)");
  static const std::regex call(
      R"([^A-Za-z0-9_>]::((?:close|dl[a-z]+|fcntl|fsync|isatty|open|poll|p?read|p?write|stat)\())");
  std::smatch found;
  // Regular expressions see only the lines that may match: over whole files they take seconds.
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("#include <") == std::string::npos && line.find("::") == std::string::npos) continue;
    line.insert(0, 1, '\n');  // which stands before a call at the beginning of a line
    if (std::regex_search(line, found, header) || std::regex_search(line, found, call)) return found[1];
  }
  return "";
}

TEST(Posix, StandsInTheRoomSystem) {
  const fs::path root = NINEBIT_SOURCE_DIR;
  std::string where;
  for (const char* folder : {"include", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".h" && kind != ".cpp" && kind != ".inl") continue;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      const std::string name = fs::relative(entry.path(), root).generic_string();
      if (name.rfind("src/system/", 0) == 0) continue;
      if (name == "src/gl_layer/driver/symbols.cpp") continue;  // stands in front of dlsym itself
      if (const std::string found = posix_in(text); !found.empty()) where += name + ' ';
    }
  }
  EXPECT_EQ(where, "");
}

TEST(Posix, IsFound) {
  EXPECT_EQ(posix_in("#include <unistd.h>\n"), "unistd.h");
  EXPECT_EQ(posix_in("#include <sys/stat.h>\n"), "sys/stat.h");
  EXPECT_EQ(posix_in("  (void)::open(name);\n"), "open(");
  EXPECT_EQ(posix_in("int f();\n::close(3);\n"), "close(");
  EXPECT_EQ(posix_in("#include <cstdio>\nauto f = InputFile::open(name);\n"), "");
}

}  // namespace
