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

TEST(EffectSchema, RefusesMistakes) {
  const std::string head = R"({"ninebit": "effect", "version": 1, )";
  for (const char* wrong :
       {R"("passes": []})", R"("passes": [{"programm": "x"}]})", R"("size": [0, 4], "passes": [{}]})",
        R"("passes": [{"depth": {"function": "smaller"}}]})", R"("passes": [{"units": [{}]}]})",
        R"("passes": [{"units": [null, null, null, null, null]}]})", R"("targets": {"m": {}}, "passes": [{}]})",
        R"("textures": {"t": {"source": 1}}, "passes": [{}]})", R"("passes": [{"cull": "up"}]})",
        R"("passes": [{"constants": {"combiners": [{"const2": [0, 0, 0, 0]}]}}]})",
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
  for (const std::string& word : words_of(kCullFaces)) EXPECT_EQ(accepts(R"({"cull": ")" + word + R"("})"), "");
  for (const std::string& word : words_of(kColorFormatWords)) {
    const std::string key = R"("color_format": ")" + word + '"';
    const std::string targets = R"("targets": {"t": {"size": 4, )" + key + "}}";
    EXPECT_EQ(complaint(Json::parse(R"({"ninebit": "effect", "version": 1, )" + key + ", " + targets +
                                    R"(, "passes": [{}]})")),
              "");
  }
  for (const std::string& word : words_of(kShadeModels)) EXPECT_EQ(accepts(R"({"shade": ")" + word + R"("})"), "");
}

}  // namespace
}  // namespace ninebit::test
