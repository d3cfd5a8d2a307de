// Completions for bash, zsh and fish.
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "src/tools/help/verb_text.h"

namespace ninebit::tools {
namespace {

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

// Quoted as one word of bash or zsh.
std::string in_quotes(const std::string& text) {
  return "'" + replaced(text, "'", "'\\''") + "'";
}

std::string in_fish_quotes(const std::string& text) {
  return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

template <class Visit>
void for_each_verb(const VerbText& verb, const Visit& visit) {
  visit(verb);
  for (const VerbText& part : verb.verbs) for_each_verb(part, visit);
}

std::vector<std::string> names_of(const std::vector<VerbText>& verbs) {
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const VerbText& verb : verbs) names.push_back(verb.name());
  return names;
}

// The files that complete a value, as the script for bash names them.
std::string_view completed_files(const FlagText& flag) {
  if (flag.takes_profile) return "json";
  return flag.choices.empty() ? "all" : "none";
}

// --- zsh: one function per verb, for _arguments.

std::string zsh_action(const FlagText& flag) {
  const std::string choices = fmt::format("{}", fmt::join(flag.choices, " "));
  if (flag.takes_profile) return " _ninebit_profile " + choices;  // behind a space: zsh adds no arguments of its own
  return choices.empty() ? "" : "(" + choices + ")";
}

std::string zsh_value(const FlagText& flag) {
  std::string action = zsh_action(flag);
  if (flag.takes_file && action.empty()) action = "_files";
  return fmt::format(":{}:{}", replaced(flag.value, ":", "\\:"), action);
}

std::string zsh_description(const std::string& text) {
  return replaced(replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":", "\\:");
}

std::string zsh_flag(const FlagText& flag) {
  std::string out;
  const std::string all = flag.names.size() > 1 ? fmt::format("({})", fmt::join(flag.names, " ")) : "";
  for (const std::string& name : flag.names) {
    const std::string value = flag.value.empty() ? "" : zsh_value(flag);
    const char* const equals = flag.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
    out += " \\\n    " +
           in_quotes(fmt::format("{}{}{}[{}]{}", all, name, equals, zsh_description(flag.description), value));
  }
  return out;
}

// Completes one of its arguments, or a profile's file.
constexpr std::string_view kZshProfileFunction =
    "_ninebit_profile() {\n  _alternative \"profiles:profile:($*)\" 'files:file:_files -g \"*.json\"'\n}\n";

std::string zsh_function(const VerbText& verb) {
  std::string out = fmt::format("_{}() {{\n", fmt::join(verb.path, "_"));
  if (!verb.verbs.empty()) out += "  local context state state_descr line\n  typeset -A opt_args\n";
  out += verb.verbs.empty() ? "  _arguments" : "  _arguments -C";
  for (const FlagText& flag : verb.flags) out += zsh_flag(flag);
  for (std::size_t i = 0; i < verb.arguments.size(); ++i) {
    const FlagText& argument = verb.arguments[i];
    std::string action = zsh_action(argument);
    if (action.empty()) action = "_files";
    out += " \\\n    " + in_quotes(fmt::format("{}:{}:{}", i + 1, replaced(argument.names[0], ":", "\\:"), action));
  }
  if (verb.verbs.empty()) return out + "\n}\n";
  out +=
      " \\\n    '1:verb:->verb' \\\n    '*::argument:->argument'\n  case $state in\n    verb)\n      local -a verbs=(";
  for (const VerbText& part : verb.verbs) {
    out += "\n        " + in_quotes(part.name() + ":" + replaced(part.description, ":", "\\:"));
  }
  out += "\n      )\n      _describe verb verbs\n      ;;\n    argument)\n      case $line[1] in\n";
  for (const VerbText& part : verb.verbs) {
    out += fmt::format("        {}) _{} ;;\n", part.name(), fmt::join(part.path, "_"));
  }
  return out + "      esac\n      ;;\n  esac\n}\n";
}

}  // namespace

std::string bash_completion(const VerbText& program) {
  std::string paths, values, words;
  for_each_verb(program, [&](const VerbText& verb) {
    if (verb.path.size() > 1) paths += fmt::format("{}{}", paths.empty() ? "" : " | ", in_quotes(verb.command()));
    std::vector<std::string> offered = names_of(verb.verbs);
    for (const FlagText& flag : verb.flags) {
      offered.insert(offered.end(), flag.names.begin(), flag.names.end());
      if (flag.value.empty()) continue;
      std::string keys;
      for (const std::string& name : flag.names) {
        keys += fmt::format("{}{}", keys.empty() ? "" : " | ", in_quotes(verb.command() + ' ' + name));
      }
      values += fmt::format("    {}) words={} files={} ;;\n", keys,
                            in_quotes(fmt::format("{}", fmt::join(flag.choices, " "))),
                            flag.takes_file || flag.takes_profile ? completed_files(flag) : "none");
    }
    const FlagText* const first = verb.arguments.empty() ? nullptr : &verb.arguments[0];
    if (first != nullptr) offered.insert(offered.end(), first->choices.begin(), first->choices.end());
    words += fmt::format("    {}) words={} files={} ;;\n", in_quotes(verb.command()),
                         in_quotes(fmt::format("{}", fmt::join(offered, " "))),
                         first == nullptr ? "none" : completed_files(*first));
  });
  return fmt::format(
      R"(# Completion of ninebit for bash, generated by `ninebit generate bash`.
_ninebit() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} path=ninebit words='' files=none i
  # bash splits --flag=value at the equals sign.
  if [[ $current == = ]]; then
    current=''
  elif [[ $before == = ]]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$path ${{COMP_WORDS[i]}}" in
      {}) path+=" ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$path $before" in
{}    *)
      case $path in
{}      esac
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [[ $files != none && $current != -* ]]; then
    compopt -o filenames 2>/dev/null
    if [[ $files == json ]]; then
      mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -X '!*.json' -- "$current"; compgen -d -- "$current")
    else
      mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$current")
    fi
  fi
}}
complete -F _ninebit ninebit
)",
      paths, values, replaced(words, "\n    '", "\n        '").insert(0, "    "));
}

std::string zsh_completion(const VerbText& program) {
  std::string out = "#compdef ninebit\n# Completion of ninebit for zsh, generated by `ninebit generate zsh`.\n";
  out += kZshProfileFunction;
  for_each_verb(program, [&](const VerbText& verb) { out += zsh_function(verb); });
  return out + "_ninebit \"$@\"\n";
}

std::string fish_completion(const VerbText& program) {
  std::string out = "# Completion of ninebit for fish, generated by `ninebit generate fish`.\n";
  for_each_verb(program, [&](const VerbText& verb) {
    // The condition that the line has exactly the words of this verb.
    std::string here;
    for (std::size_t i = 1; i < verb.path.size(); ++i) {
      here += fmt::format("{}__fish_seen_subcommand_from {}", i > 1 ? "; and " : "", verb.path[i]);
    }
    if (!verb.verbs.empty()) {
      here += fmt::format("{}not __fish_seen_subcommand_from {}", here.empty() ? "" : "; and ",
                          fmt::join(names_of(verb.verbs), " "));
    }
    const std::string begin = "complete -c ninebit -n " + in_fish_quotes(here);
    for (const VerbText& part : verb.verbs) {
      out += fmt::format("{} -f -a {} -d {}\n", begin, part.name(), in_fish_quotes(part.description));
    }
    for (const FlagText& argument : verb.arguments) {
      if (argument.choices.empty()) continue;
      out += fmt::format("{}{} -a {}\n", begin, argument.takes_profile ? "" : " -f",
                         in_fish_quotes(fmt::format("{}", fmt::join(argument.choices, " "))));
    }
    for (const FlagText& flag : verb.flags) {
      out += begin;
      for (const std::string& name : flag.names) {
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (!flag.value.empty()) out += flag.takes_file ? " -r" : " -x";
      const std::string files =
          flag.takes_profile
              ? R"re( (__fish_complete_path (commandline -ct) | string match -r '.*[^/](?:\.json|/)(?=\t|$)'))re"
              : "";
      if (!flag.choices.empty()) {
        out += " -a " + in_fish_quotes(fmt::format("{}{}", fmt::join(flag.choices, " "), files));
      }
      out += " -d " + in_fish_quotes(flag.description) + "\n";
    }
  });
  return out;
}

}  // namespace ninebit::tools
