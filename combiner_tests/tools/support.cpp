#include "combiner_tests/tools/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace tools_test {

namespace fs = std::filesystem;

namespace {

void add_help(const Words& path, std::map<std::string, std::string>& verbs) {
  std::string name;
  for (const std::string& word : path) name += (name.empty() ? "" : " ") + word;
  const Outcome outcome = ninebit(path + Words{"--help"});
  EXPECT_EQ(outcome.code, 0) << name;
  EXPECT_EQ(outcome.err, "") << name;
  const std::string& help = verbs[name] = outcome.out;
  const std::size_t list = help.find("\nSubcommands:\n");
  if (list == std::string::npos) return;
  // An empty line ends the list; examples may follow.
  const std::string listed = help.substr(list + 13, help.find("\n\n", list) - list - 13);
  static const std::regex line("\n  ([a-z0-9-]+) ");
  for (std::sregex_iterator it(listed.begin(), listed.end(), line), end; it != end; ++it) {
    add_help(path + Words{(*it)[1]}, verbs);
  }
}

}  // namespace

Files files_in(const fs::path& folder) {
  Files files;
  if (!fs::exists(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = entry.is_regular_file() ? read_bytes(entry.path()) : "(no file)";
  }
  return files;
}

bool has_file(const std::string& folder, const std::function<bool(const std::string& name)>& is_it) {
  std::error_code gone;
  fs::directory_iterator entry(folder, gone);
  for (; !gone && entry != fs::directory_iterator(); entry.increment(gone)) {
    if (is_it(entry->path().filename().string())) return true;
  }
  return false;
}

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Words small_render(const std::string& scene, const std::string& folder, const Words& more) {
  Words arguments{"render", scene, "-o", folder};
  const auto has = [&](const char* flag) { return std::find(more.begin(), more.end(), flag) != more.end(); };
  if (!has("--size")) arguments.insert(arguments.end(), {"--size", "48x36"});
  if (!has("--map-size") && !has("shadow-volume") && !has("--cookie-shadows"))
    arguments.insert(arguments.end(), {"--map-size", "32"});
  return arguments + more;
}

std::pair<std::string, int> shell(const std::string& command) {
  std::FILE* const out = popen((command + " 2>&1").c_str(), "r");
  if (out == nullptr) throw std::runtime_error("cannot start a shell");
  std::string text;
  for (int byte = std::fgetc(out); byte != EOF; byte = std::fgetc(out)) text += static_cast<char>(byte);
  return {text, WEXITSTATUS(pclose(out))};
}

std::uint32_t crc32_of(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

Words lines_of(const std::string& text) {
  Words lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void expect_parts(const std::string& text, const Words& parts, const Place& place) {
  for (const std::string& part : parts) {
    if (text.find(part) != std::string::npos) continue;
    ADD_FAILURE_AT(place.file, place.line) << "no '" << part << "' in: " << text;
  }
}

void expect_error(const Outcome& outcome, int code, const Words& words, const Place& place) {
  const testing::ScopedTrace trace(place.file, place.line, "expected here");
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.ends_with('\n')) << outcome.err;
  // Notes may come before the error, and behind it the line of the text with a mark.
  std::size_t errors = 0;
  for (const std::string& line : lines_of(outcome.err)) {
    if (line.starts_with("ninebit: note: ") || (errors > 0 && line.starts_with("  "))) continue;
    EXPECT_TRUE(line.starts_with("ninebit: error: ")) << outcome.err;
    ++errors;
  }
  EXPECT_EQ(errors, 1U) << outcome.err;
  expect_parts(outcome.err, words, place);
}

const std::map<std::string, std::string>& help_of_all_verbs() {
  static const std::map<std::string, std::string> verbs = [] {
    std::map<std::string, std::string> all;
    add_help({}, all);
    return all;
  }();
  return verbs;
}

namespace {

void expect_code(const Outcome& outcome, int code, const Place& place) {
  const testing::ScopedTrace trace(place.file, place.line, "expected here");
  EXPECT_EQ(outcome.code, code) << outcome.out << outcome.err;
}

}  // namespace

std::string out_of(const Outcome& outcome, int code, const Place& place) {
  expect_code(outcome, code, place);
  return outcome.out;
}

std::string err_of(const Outcome& outcome, int code, const Place& place) {
  expect_code(outcome, code, place);
  return outcome.err;
}

Json json_of(const Outcome& outcome, int code, const Place& place) {
  expect_code(outcome, code, place);
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
    const std::string command = one["command"];
    std::istringstream in(command);
    Words words{std::istream_iterator<std::string>(in), {}};
    const std::string pixel = std::to_string(one["x"].get<int>()) + ',' + std::to_string(one["y"].get<int>());
    EXPECT_EQ(words[words.size() - 2], pixel);
    if (one["text"] == "") continue;
    ++texts;
    words.erase(words.begin());
    words.emplace_back("--quiet");
    EXPECT_EQ(one["text"], ninebit(words).out) << command;
    EXPECT_NE(one["text"].get<std::string>().find("the pixel is wrong ("), std::string::npos) << command;
  }
}

Json faults_of(const Outcome& outcome, int code) {
  Json object = json_of(outcome, code);
  const bool is_whole = object.is_object() && object.contains("error") && object.contains("errors");
  EXPECT_TRUE(is_whole) << outcome.out;
  if (!is_whole) return {{"error", {{"message", ""}}}, {"errors", Json::array()}};
  EXPECT_EQ(object["exit_code"], code);
  EXPECT_EQ(object["error"], object["errors"][0]);
  return object;
}

Words keys_of(const Json& object) {
  Words keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

}  // namespace tools_test
