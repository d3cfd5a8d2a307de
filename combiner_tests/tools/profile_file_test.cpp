// --profile with a file: what it computes as, what it is called, and what a bad file gets.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

TEST(ProfileFile, IsListedByItsOwnNameAfterTheShippedOnes) {
  const TempFolder folder;
  const std::string file =
      write_bytes(folder / "mine.json", R"({"base": "nv2a", "name": "my-card", "half": 127, "texture_units": 3})");
  const Json answer = json_of(ninebit({"profiles", "--json", "--profile", file}));
  EXPECT_EQ(answer.at("profile"), "my-card");
  std::size_t rows = 0;
  for (const Json& row : answer.at("rows")) {
    if (row.at("profile") != "my-card") continue;
    ++rows;
    const bool own = row.at("field") == "half" || row.at("field") == "texture_units";
    EXPECT_EQ(row.at("source") == file, own) << row;
    if (row.at("field") == "half") {
      EXPECT_EQ(row.at("value"), "127");
    }
    if (own) {
      EXPECT_EQ(row.at("evidence"), "assumed");
    }
  }
  EXPECT_EQ(rows, json_of(ninebit({"profiles", "--json", "--profile", "nv2a"})).at("rows").size());
}

TEST(ProfileFile, EqualsItsBaseInARendering) {
  const TempFolder folder;
  const std::string same = write_bytes(folder / "same.json", R"({"base": "geforce2", "name": "same"})");
  const std::string other =
      write_bytes(folder / "early.json", R"({"base": "geforce2", "name": "early", "narrowing_point": "before-scale"})");
  const auto hash_of = [&](const std::string& profile) {
    const Words more{"--json", "--index-step", "2", "--profile", profile};
    return json_of(ninebit(small_render(kRoom, folder / "out", more))).at("hash");
  };
  const Json base = hash_of("geforce2");
  EXPECT_EQ(hash_of(same), base);
  EXPECT_EQ(hash_of(other), hash_of("geforce2-early-truncation"));
}

// Real numbers lose no shadow of the article's step of two. The colours may differ by a vertex colour's last bit.
TEST(ProfileFile, IdealAndFloatShaderDrawTheShadowsOfTheGeforce2) {
  const TempFolder folder;
  const auto answer_of = [&](const std::string& profile) {
    return json_of(ninebit(small_render(kRoom, folder / "out", {"--json", "--profile", profile})));
  };
  const Json geforce2 = answer_of("geforce2");
  EXPECT_NE(geforce2.at("pixels").at("shadowed"), 0);
  for (const char* const profile : {"ideal", "float-shader"}) {
    const Json answer = answer_of(profile);
    EXPECT_EQ(answer.at("profile"), profile);
    for (const char* const plane : {"stencil", "index_map"}) {
      EXPECT_EQ(answer.at("hash").at(plane), geforce2.at("hash").at(plane)) << profile;
    }
  }
}

TEST(ProfileFile, AFaultIsInvalidInputAndNamesItsPlace) {
  const TempFolder folder;
  const std::string bad = write_bytes(folder / "bad.json", "{\"base\": \"nv2a\",\n \"name\": \"x\", \"half\": 300}");
  expect_error(ninebit({"profiles", "--profile", bad}), 3, {bad + ":2:23: ", "half", "0 to 255"});
  expect_error(ninebit({"profiles", "--profile", folder / "none.json"}), 3,
               {folder / "none.json", "could not be read"});
  write_bytes(folder / "empty.json", "");
  expect_error(ninebit({"info", "--profile", folder / "empty.json"}), 3, {"empty.json:1:1: "});
}

TEST(ProfileFile, ANameThatIsNoneIsWrongUsage) {
  expect_error(ninebit({"profiles", "--profile", "Ideal"}), 2,
               {"unknown profile 'Ideal'", "float-shader", ".json file"});
}

TEST(ProfileFile, AllFaultsAreTold) {
  const TempFolder folder;
  const std::string bad = write_bytes(folder / "bad.json", "{\"base\": \"x\",\n \"name\": \"nv2a\"}");
  expect_parts(err_of(ninebit({"profiles", "--profile", bad}), 3),
               {"ninebit: error: " + bad + ":1:10: ", "\nninebit: error: " + bad + ":2:10: "});
}

}  // namespace
}  // namespace tools_test
