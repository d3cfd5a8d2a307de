#include "combiner_tests/tools/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace tools_test {

namespace fs = std::filesystem;

Files files_in(const fs::path& folder) {
  Files files;
  if (!fs::exists(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = entry.is_regular_file() ? read_bytes(entry.path()) : "(no file)";
  }
  return files;
}

std::vector<std::string> small_render(const std::string& scene, const std::string& folder,
                                      const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"render", scene, "-o", folder};
  const auto has = [&](const char* flag) { return std::find(more.begin(), more.end(), flag) != more.end(); };
  if (!has("--size")) arguments.insert(arguments.end(), {"--size", "48x36"});
  if (!has("--map-size") && !has("shadow-volume") && !has("--cookie-shadows"))
    arguments.insert(arguments.end(), {"--map-size", "32"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expect_error(const Outcome& outcome, int code, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.ends_with('\n')) << outcome.err;
  // Notes may come before the error, and behind it the line of the text with a mark.
  std::size_t errors = 0;
  std::istringstream lines(outcome.err);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ninebit: note: ") || (errors > 0 && line.starts_with("  "))) continue;
    EXPECT_TRUE(line.starts_with("ninebit: error: ")) << outcome.err;
    ++errors;
  }
  EXPECT_EQ(errors, 1U) << outcome.err;
  for (const std::string& word : words) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << "no '" << word << "' in: " << outcome.err;
  }
}

Json json_of(const Outcome& outcome) {
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  Json object = Json::parse(outcome.out, nullptr, false);
  EXPECT_TRUE(object.is_object()) << outcome.out;
  return object.is_object() ? object : Json();
}

Json data_of(const std::string& page) {
  const std::string begin = "id=\"data\">";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) throw std::runtime_error("the page has no data");
  const std::size_t from = at + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

void expect_traces(const Json& traces, std::size_t& texts) {
  for (const Json& one : traces) {
    std::istringstream command(one["command"].get<std::string>());
    std::vector<std::string> words{std::istream_iterator<std::string>(command), {}};
    const std::string pixel = std::to_string(one["x"].get<int>()) + ',' + std::to_string(one["y"].get<int>());
    EXPECT_EQ(words[words.size() - 2], pixel);
    if (one["text"] == "") continue;
    ++texts;
    words.erase(words.begin());
    words.emplace_back("--quiet");
    EXPECT_EQ(one["text"], ninebit(words).out) << command.str();
    EXPECT_NE(one["text"].get<std::string>().find("the pixel is wrong ("), std::string::npos) << command.str();
  }
}

Json faults_of(const Outcome& outcome, int code) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  Json object = Json::parse(outcome.out, nullptr, false);
  const bool is_whole = object.is_object() && object.contains("error") && object.contains("errors");
  EXPECT_TRUE(is_whole) << outcome.out;
  if (!is_whole) return {{"error", {{"message", ""}}}, {"errors", Json::array()}};
  EXPECT_EQ(object["exit_code"], code);
  EXPECT_EQ(object["error"], object["errors"][0]);
  return object;
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

}  // namespace tools_test
