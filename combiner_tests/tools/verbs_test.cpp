// Every verb has help with an example, JSON and nothing else on stdout, streams that may be full or closed.
#include <gtest/gtest.h>

#include <set>

#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

// The examples of the help work as they stand, but for the folder and the scene's place.
TEST(Verbs, TheExampleOfRenderWorks) {
  const TempFolder folder;
  const Outcome outcome =
      ninebit({"render", "scenes/index_room.gltf", "-o", folder / "out"}, {.folder = NINEBIT_SOURCE_DIR});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const ninebit::Image8 color = ninebit::test::read_png(folder / "out/color.png");
  EXPECT_EQ(color.width, 1024);
  EXPECT_EQ(color.height, 768);
}

TEST(Verbs, RowsAnswerWithOneObject) {
  for (const char* verb : {"profiles", "info"}) {
    SCOPED_TRACE(verb);
    const Outcome outcome = ninebit({verb, "--json", "--profile", "nv2a"});
    const Json object = json_of(outcome);
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(keys_of(object), (Words{"command", "version", "profile", "rows"}));
    EXPECT_EQ(object["command"], verb);
    EXPECT_EQ(object["profile"], "nv2a");
    EXPECT_TRUE(ninebit({"--version"}).out.starts_with("ninebit " + object["version"].get<std::string>() + "\n"));
    EXPECT_TRUE(object["rows"].is_array() && !object["rows"].empty());
  }
}

// Every profile has every field once, each with a word for its evidence.
TEST(Verbs, ProfilesAreComplete) {
  const Json rows = json_of(ninebit({"profiles", "--json"})).at("rows");
  std::map<std::string, std::set<std::string>> fields;
  for (const Json& row : rows) {
    EXPECT_EQ(keys_of(row), (Words{"profile", "field", "value", "evidence", "source"}));
    EXPECT_TRUE(fields[row.at("profile")].insert(row.at("field")).second) << row;
    for (const char* key : {"value", "evidence", "source"}) EXPECT_NE(row.at(key), "") << row;
  }
  ASSERT_TRUE(fields.contains("geforce2"));
  EXPECT_GE(fields.size(), 4U);
  for (const auto& [profile, names] : fields) EXPECT_EQ(names, fields["geforce2"]) << profile;

  const std::string people = out_of(ninebit({"profiles"}));
  for (const std::string& field : fields["geforce2"]) expect_parts(people, {field});
}

// An answer that could not be delivered is an error that could not be written; messages that cannot be are none.
TEST(Verbs, FullStandardStreams) {
  const TempFolder folder;
  for (const Words& arguments : std::vector<Words>{{"profiles"},
                                                   {"profiles", "--json"},
                                                   {"info"},
                                                   {"info", "--json"},
                                                   {"--help"},
                                                   {"--version"},
                                                   {"render", "--help"},
                                                   {"study", "index-steps", "--help"},
                                                   {"generate", "man"},
                                                   {"explain", NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl"},
                                                   small_render(kRoom, folder / "a", {"--json", "--quiet"})}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Outcome outcome = ninebit(arguments, {.out = "/dev/full"});
    expect_error(outcome, 4, {"standard output", "No space left on device"});
  }
  EXPECT_EQ(ninebit(small_render(kRoom, folder / "b"), {.err = "/dev/full"}).code, 0);
  EXPECT_EQ(files_in(folder / "b").size(), 4U);
  EXPECT_EQ(ninebit(small_render(folder / "missing.obj", folder / "c"), {.err = "/dev/full"}).code, 3);
  EXPECT_EQ(ninebit({"--bogus"}, {.err = "/dev/full"}).code, 2);
}

}  // namespace
}  // namespace tools_test
