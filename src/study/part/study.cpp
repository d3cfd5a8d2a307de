#include "ninebit/study/study.h"

#include "src/system/quoting.h"

namespace ninebit {

double Study::weight(std::size_t /*unit*/) const {
  return 1.0;
}

Status Study::draw(std::span<const StudyRow> /*rows*/, const DrawProgress& /*progress*/,
                   StudyReport& /*report*/) const {
  return {};
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
  for (const std::string& word : words()) text += ' ' + shell_word(word);
  return text;
}

}  // namespace ninebit
