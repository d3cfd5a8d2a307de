#include "ninebit/study/study.h"

namespace ninebit {

namespace {

// Quotes a word for a shell.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

double Study::weight(std::size_t /*unit*/) const {
  return 1.0;
}

std::vector<std::string> StudyQuestion::words() const {
  std::vector<std::string> words{study};
  if (!arguments.empty()) words.push_back(arguments);
  for (const auto& [flag, value] : options) {
    if (!flag.starts_with("-")) continue;
    words.push_back(flag);
    if (!value.empty()) words.push_back(value);
  }
  if (profile != "all") words.insert(words.end(), {"--profile", profile});
  return words;
}

std::string StudyQuestion::command() const {
  std::string text = "ninebit study";
  for (const std::string& word : words()) text += ' ' + quoted(word);
  return text;
}

}  // namespace ninebit
