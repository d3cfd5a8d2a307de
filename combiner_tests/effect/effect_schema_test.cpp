// docs/effect.schema.json against the gallery, and against what the reader refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "combiner_tests/support/json_schema.h"
#include "src/effect/effect_words.h"

namespace ninebit::test {
namespace {

std::string complaint(const Json& value) {
  std::ifstream file(NINEBIT_SOURCE_DIR "/docs/effect.schema.json");
  static const Json root = Json::parse(file);
  return schema_complaint(root, root, value, "");
}

TEST(EffectSchema, AcceptsTheGallery) {
  for (const auto& entry : std::filesystem::directory_iterator(NINEBIT_SOURCE_DIR "/scenes/effects")) {
    if (entry.path().extension() != ".json" || entry.path().stem() == "expected_hashes") continue;
    std::ifstream file(entry.path());
    EXPECT_EQ(complaint(Json::parse(file)), "") << entry.path();
  }
}

TEST(EffectSchema, AcceptsNumbersThatMove) {
  const Json moving = Json::parse(R"json({"ninebit": "effect", "version": 1,
    "scene": {"mesh": "cube", "light": ["sin(time)", 1, 2], "fov": "40 + frame"},
    "passes": [{"constants": {"const0": ["time", 0, 0, 1]}, "units": [{"texture": null,
      "matrix": [[1, 0, 0, "time"], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}]}]})json");
  EXPECT_EQ(complaint(moving), "");
}

TEST(EffectSchema, RefusesMistakes) {
  const std::string head = R"({"ninebit": "effect", "version": 1, )";
  for (const char* wrong :
       {R"("passes": []})", R"("passes": [{"programm": "x"}]})", R"("size": [0, 4], "passes": [{}]})",
        R"("passes": [{"depth": {"function": "smaller"}}]})", R"("passes": [{"units": [{}]}]})",
        R"("passes": [{"units": [null, null, null, null, null]}]})", R"("targets": {"m": {}}, "passes": [{}]})",
        R"("textures": {"t": {"source": 1}}, "passes": [{}]})", R"("passes": [{"cull": "up"}]})",
        R"("passes": [{"constants": {"combiners": [{"const2": [0, 0, 0, 0]}]}}]})",
        R"("passes": [{"point_size": 65}]})", R"("passes": [{"line_width": 0}]})", R"("passes": [{"line_smooth": 1}]})",
        R"("passes": [{"polygon_stipple": "12"}]})",
        R"("targets": {"t": {"size": 4, "samples": "4"}}, "passes": [{}]})",
        R"("textures": {"t": {"source": "gradient", "border_color": [1]}}, "passes": [{}]})",
        R"("passes": [{"clear": {"stencil": 256}}]})", R"("scene": {"light": [1, 2]}, "passes": [{}]})"}) {
    EXPECT_NE(complaint(Json::parse(head + wrong)), "") << wrong;
  }
}

template <class T, std::size_t N>
std::vector<std::string> words_of(const effect_detail::Words<T, N>& words) {
  std::vector<std::string> all;
  for (const auto& [word, value] : words) all.emplace_back(word);
  return all;
}

// Each word of the reader is accepted at its place.
TEST(EffectSchema, HasTheWordsOfTheReader) {
  using namespace effect_detail;
  const auto accepts = [](const std::string& pass) {
    return complaint(Json::parse(R"({"ninebit": "effect", "version": 1, "passes": [)" + pass + "]}"));
  };
  for (const std::string& word : words_of(kCompareFunctions)) {
    EXPECT_EQ(accepts(R"({"alpha_test": {"function": ")" + word + R"("}})"), "");
  }
  for (const std::string& word : words_of(kStencilOperations)) {
    EXPECT_EQ(accepts(R"({"stencil": {"pass": ")" + word + R"("}})"), "");
  }
  for (const std::string& word : words_of(kBlendFactors)) {
    EXPECT_EQ(accepts(R"({"blend": {"source": ")" + word + R"("}})"), "");
  }
  for (const std::string& word : words_of(kBlendEquations)) {
    EXPECT_EQ(accepts(R"({"blend": {"equation": ")" + word + R"("}})"), "");
  }
  for (const std::string& word : words_of(kPolygonModes)) {
    EXPECT_EQ(accepts(R"({"polygon_mode": ")" + word + R"("})"), "");
  }
  for (const std::string& word : words_of(kCullFaces)) EXPECT_EQ(accepts(R"({"cull": ")" + word + R"("})"), "");
  for (const std::string& word : words_of(kColorFormatWords)) {
    const std::string key = R"("color_format": ")" + word + '"';
    const std::string targets = R"("targets": {"t": {"size": 4, )" + key + "}}";
    EXPECT_EQ(complaint(Json::parse(R"({"ninebit": "effect", "version": 1, )" + key + ", " + targets +
                                    R"(, "passes": [{}]})")),
              "");
  }
  const auto accepts_in = [](const std::string& group, const std::string& part) {
    return complaint(Json::parse(R"({"ninebit": "effect", "version": 1, ")" + group + R"(": {"t": )" + part +
                                 R"(}, "passes": [{}]})"));
  };
  for (const std::string& word : words_of(kSampleModes)) {
    EXPECT_EQ(accepts_in("targets", R"({"size": 4, "samples": ")" + word + R"("})"), "");
  }
  const auto accepts_texture = [&](const std::string& key, const std::string& word) {
    return accepts_in("textures", R"({"source": "gradient", ")" + key + R"(": ")" + word + R"("})");
  };
  for (const std::string& word : words_of(kFilters)) EXPECT_EQ(accepts_texture("filter", word), "");
  for (const std::string& word : words_of(kWraps)) EXPECT_EQ(accepts_texture("wrap", word), "");
  for (const std::string& word : words_of(kCylinderWraps)) EXPECT_EQ(accepts_texture("cylinder_wrap", word), "");
  for (const std::string& word : words_of(kColorKeyOperations)) {
    EXPECT_EQ(accepts_texture("color_key", word + ":0123abCD"), "");
    EXPECT_NE(accepts_texture("color_key", word + ":0123abC"), "");
  }
  for (const std::string& word : words_of(kShadeModels)) EXPECT_EQ(accepts(R"({"shade": ")" + word + R"("})"), "");
}

}  // namespace
}  // namespace ninebit::test
