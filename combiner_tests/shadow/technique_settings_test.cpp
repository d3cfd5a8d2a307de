// The table of the techniques' settings: names, ranges, words, and who reads them.
#include "ninebit/frame/technique_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "ninebit/shadow/technique.h"

namespace {

using namespace ninebit;

const TechniqueSetting& setting(std::string_view name) {
  return *find_technique_setting(name);
}

TEST(TechniqueSettings, NamesAndAxesAreUnique) {
  std::set<std::string_view> names, axes, columns;
  for (const TechniqueSetting& s : technique_settings()) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name;
    EXPECT_EQ(find_technique_setting(s.name), &s);
    EXPECT_FALSE(s.help.empty()) << s.name;
    EXPECT_NE(s.group, nullptr) << s.name;
    if (s.axis.flag.empty()) continue;
    EXPECT_TRUE(axes.insert(s.axis.flag).second) << s.name;
    EXPECT_FALSE(s.axis.help.empty()) << s.name;
    EXPECT_EQ(s.axis.expected.empty(), s.kind == SettingKind::word) << s.name;
    for (std::size_t i = 0; i < s.numbers; ++i) EXPECT_TRUE(columns.insert(s.axis.columns.at(i)).second) << s.name;
  }
  EXPECT_EQ(find_technique_setting("index-stp"), nullptr);
}

// Each setting has a member of its own: set, read, and printed as the text that it came from.
TEST(TechniqueSettings, ValuesComeBack) {
  for (const TechniqueSetting& s : technique_settings()) {
    if (s.kind == SettingKind::files) continue;
    EXPECT_TRUE(s.allows(s.get(RenderSettings{}))) << s.name << ": the default";
    std::vector<std::string> texts;
    for (const SettingWord& word : s.words) texts.emplace_back(word.word);
    if (texts.empty()) {
      std::string text;
      for (std::size_t i = 0; i < s.numbers; ++i) {
        const double number = s.power_of_two ? 8.0 : 7.0 + static_cast<double>(i);
        text += (i == 0 ? "" : ",") + std::to_string(static_cast<int>(std::clamp(number, s.least, s.greatest)));
      }
      texts.push_back(text);
    }
    for (const std::string& text : texts) {
      const auto value = s.value_of(text);
      ASSERT_TRUE(value) << s.name << ' ' << text;
      RenderSettings settings;
      s.set(settings, *value);
      EXPECT_EQ(s.get(settings), *value) << s.name;
      EXPECT_EQ(s.text_of(s.get(settings)), text) << s.name;
      for (const TechniqueSetting& other : technique_settings()) {
        if (other.get == nullptr || &other == &s) continue;
        EXPECT_EQ(other.get(settings), other.get(RenderSettings{})) << s.name << " changes " << other.name;
      }
    }
  }
}

TEST(TechniqueSettings, InvalidTextsHaveNoValue) {
  for (const auto& [name, text] :
       std::initializer_list<std::pair<const char*, const char*>>{{"index-step", "0"},
                                                                  {"index-step", "17"},
                                                                  {"index-step", "1.5"},
                                                                  {"index-step", "1,2"},
                                                                  {"index-step", ""},
                                                                  {"map-size", "48"},
                                                                  {"map-size", "32768"},
                                                                  {"bias", "-1"},
                                                                  {"bias", "nan"},
                                                                  {"kernel", "0.5"},
                                                                  {"patch-angle", "91"},
                                                                  {"polygon-offset", "1"},
                                                                  {"polygon-offset", "1,inf"},
                                                                  {"light-rotate", "1,2"},
                                                                  {"index-order", "File"},
                                                                  {"style", ""}}) {
    EXPECT_FALSE(setting(name).value_of(text)) << name << ' ' << text;
  }
}

TEST(TechniqueSettings, ValuesOfAnotherKindAreNotAllowed) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"map-size", "index-step"}) {
    for (const SettingValue& value : {SettingValue{}, {1.5}, {kNaN}, {1e300}, {1, 1}}) {
      EXPECT_FALSE(setting(name).allows(value)) << name;
    }
    EXPECT_TRUE(setting(name).allows({4})) << name;
  }
  EXPECT_TRUE(setting("bias").allows({}));
  EXPECT_FALSE(setting("kernel").allows({}));
}

TEST(TechniqueSettings, RealNumbersAreShownAsPeopleWriteThem) {
  EXPECT_EQ(shortest_decimal(0.1F), 0.1);
  EXPECT_EQ(shortest_decimal(16384), 16384);
}

TEST(TechniqueSettings, ANewTechniqueReadsWhatAllRead) {
  const auto all = technique_settings();
  const auto common = std::find_if(all.begin(), all.end(),
                                   [](const TechniqueSetting& s) { return s.group->readers == kAllTechniques; });
  ASSERT_NE(common, all.end());
  EXPECT_TRUE(is_read(*common, "table", {}));
}

TEST(TechniqueSettings, EachTechniqueReadsItsOwn) {
  const auto read = [](std::string_view technique, const RenderSettings& settings = {}) {
    std::string names;
    for (const TechniqueSetting& s : technique_settings()) {
      if (s.group->readers != kAllTechniques && is_read(s, technique, settings)) names += std::string(s.name) + ' ';
    }
    return names;
  };
  const std::string indices =
      "map-size index-format index-scope index-step section-size index-order patch-angle index-scales ";
  const std::string map = "depth-encoding polygon-offset depth-storage ";
  EXPECT_EQ(read("index-cube"), indices);
  EXPECT_EQ(read("depth-cube"), "map-size depth-bits bias ");
  EXPECT_EQ(read("shadow-map"), "map-size " + map);
  EXPECT_EQ(read("shadow-volume"), "volume-method stencil-sides ");
  EXPECT_EQ(read("reflective"), "map-size " + map + "samples kernel pattern gather-scale ");
  EXPECT_EQ(read("light-cookie"), indices + "cookie light-rotate cookie-shadows ");
  RenderSettings lit;
  lit.light_cookie.shadows = false;
  EXPECT_EQ(read("light-cookie", lit), "cookie light-rotate cookie-shadows ");
  EXPECT_EQ(read("none"), "");
  for (const Technique& technique : techniques()) {
    EXPECT_NE(read(technique.name), "") << technique.name << " has no row in the readers of technique_settings.cpp";
  }
}

// The title of a group names the techniques that read it.
TEST(TechniqueSettings, TitlesOfGroupsNameTheirReaders) {
  const auto names = [](const TechniqueSetting& s, std::string_view technique) {
    const std::string_view title = s.group->title;
    const std::size_t at = title.find(technique, title.find('('));
    return at != std::string_view::npos && std::string_view(" (").find(title[at - 1]) != std::string_view::npos;
  };
  for (const TechniqueSetting& s : technique_settings()) {
    EXPECT_EQ(is_read(s, "none", {}), s.group->readers == kAllTechniques) << s.name;
    if (s.group->readers == kAllTechniques) continue;
    for (const Technique& technique : techniques()) {
      EXPECT_EQ(is_read(s, technique.name, {}), names(s, technique.name)) << s.name << " by " << technique.name;
    }
    RenderSettings lit;
    lit.light_cookie.shadows = false;
    EXPECT_EQ(is_read(s, "light-cookie", lit), s.group->title.starts_with("Light cookie")) << s.name;
  }
}

}  // namespace
