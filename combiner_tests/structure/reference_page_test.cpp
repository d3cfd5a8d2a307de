// Every public header stands in the reference, in its room's group, with an example that the tests compile and run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRepository = NINEBIT_SOURCE_DIR;

std::string file_text(const fs::path& file) {
  std::ifstream in(kRepository / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The public headers, relative to include/ninebit.
std::vector<fs::path> public_headers() {
  std::vector<fs::path> headers;
  for (const auto& entry : fs::recursive_directory_iterator(kRepository / "include/ninebit")) {
    if (entry.path().extension() == ".h")
      headers.push_back(fs::relative(entry.path(), kRepository / "include/ninebit"));
  }
  EXPECT_GT(headers.size(), 50U);
  return headers;
}

TEST(ReferencePage, EveryPublicHeaderIsInTheGroupOfItsRoom) {
  const std::string input = file_text("docs/reference/Doxyfile"), rooms = file_text("docs/reference/rooms.dox");
  for (const fs::path& header : public_headers()) {
    EXPECT_TRUE(holds(input, " include/ninebit/" + header.string() + " "))
        << header << " is not in the Doxyfile's INPUT";
    const std::string room = header.has_parent_path() ? header.parent_path().filename().string() : "ninebit";
    EXPECT_TRUE(holds(rooms, "@defgroup " + room + " ")) << "rooms.dox does not describe the room " << room;
  }
}

TEST(ReferencePage, EveryPublicHeaderHasAnExample) {
  std::set<std::string> expected;
  for (const fs::path& header : public_headers()) {
    const std::string file = header.stem().string() + ".cpp";
    EXPECT_TRUE(expected.insert(file).second) << "two headers are called " << header.filename();
    const std::string example = file_text("combiner_tests/examples/" + file);
    EXPECT_TRUE(holds(example, "#include <ninebit/" + header.string() + ">")) << file;
    EXPECT_TRUE(holds(example, "\nTEST(Examples, ")) << file;
    EXPECT_TRUE(holds(example, " EXPECT_")) << file;
  }
  for (const auto& entry : fs::directory_iterator(kRepository / "combiner_tests/examples")) {
    EXPECT_TRUE(expected.count(entry.path().filename().string())) << entry.path() << " has no header of its name";
  }
}

}  // namespace
