#include "src/tools/help/verb_text.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::tools {
namespace {

// Parses CLI11's text of a value type: "TEXT:{gl,rc10}", "INT:INT in [0 - 1024]" or "TEXT:NAME|FILE".
void read_type(const std::string& type, FlagText& flag) {
  const std::size_t colon = type.find(':');
  flag.value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  std::string rest = type.substr(colon + 1);
  if (const std::size_t open = rest.find('{'); open != std::string::npos) {
    std::string list = rest.substr(open + 1);
    list.resize(std::min(list.find('}'), list.size()));
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      flag.choices.push_back(list.substr(begin, end - begin));
      begin = end + 1;
    }
  } else if (rest.find(' ') == std::string::npos && rest.find(':') == std::string::npos) {
    flag.value = std::move(rest);
  }
}

FlagText flag_text(const CLI::Option& option) {
  FlagText flag;
  if (option.get_positional()) {
    flag.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  }
  flag.description = option.get_description();
  flag.required = option.get_required();
  if (option.get_items_expected_max() == 0) return flag;
  read_type(option.get_type_name(), flag);
  flag.default_value = option.get_default_str();
  for (const char* word : {"FILE", "DIR", "PROGRAM", "SCENE"}) {
    flag.takes_file = flag.takes_file || flag.value.find(word) != std::string::npos;
  }
  constexpr std::string_view kProfile = "NAME|FILE";  // as add_profile_option() and add_profile_flag() name it
  if (flag.value.ends_with(kProfile)) {
    flag.takes_profile = true;
    flag.takes_file = false;
    if (const std::size_t word = flag.value.size() - kProfile.size(); word != 0) {
      flag.choices.push_back(flag.value.substr(0, word - 1));
    }
    for (const HardwareProfile& profile : hardware_profiles()) flag.choices.emplace_back(profile.name);
  }
  return flag;
}

}  // namespace

std::string VerbText::command() const {
  return fmt::format("{}", fmt::join(path, " "));
}

VerbText describe(const CLI::App& app) {
  VerbText verb;
  if (app.get_parent() != nullptr) {
    for (const CLI::App* at = &app; at != nullptr; at = at->get_parent())
      verb.path.insert(verb.path.begin(), at->get_name());
  } else {
    verb.path.push_back(app.get_name());
  }
  verb.description = app.get_description();
  verb.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? verb.arguments : verb.flags).push_back(flag_text(*option));
  }
  for (const CLI::App* part : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
    verb.verbs.push_back(describe(*part));
  }
  // The words of `help` are verbs.
  for (VerbText& part : verb.verbs) {
    if (part.name() != "help") continue;
    for (const VerbText& other : verb.verbs) part.arguments[0].choices.push_back(other.name());
  }
  return verb;
}

// The manual page: troff of the macro package man(7).

namespace {

// Text escaped for troff: no line starts with a command, and hyphens stay ASCII, so that they can be copied to a shell.
std::string roff(std::string_view text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    line_begins = c == '\n';
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string synopsis(const VerbText& verb) {
  std::string out = fmt::format("\\fB{}\\fR", roff(verb.command()));
  for (const FlagText& argument : verb.arguments) {
    const std::string shown = "\\fI" + roff(argument.value.empty() ? argument.names[0] : argument.value) + "\\fR";
    out += argument.required ? ' ' + shown : " [" + shown + ']';
  }
  for (const FlagText& flag : verb.flags) {
    if (flag.required) out += fmt::format(" \\fB{}\\fR \\fI{}\\fR", roff(flag.names[0]), roff(flag.value));
  }
  return out + " [\\fIflags\\fR]";
}

std::string item(const FlagText& flag) {
  std::string out = ".TP\n\\fB" + roff(fmt::format("{}", fmt::join(flag.names, ", "))) + "\\fR";
  if (!flag.value.empty()) out += " \\fI" + roff(flag.value) + "\\fR";
  out += '\n' + roff(flag.description) + '.';
  if (!flag.choices.empty()) out += roff(fmt::format(" One of {}.", fmt::join(flag.choices, ", ")));
  if (!flag.default_value.empty()) out += roff(fmt::format(" Default: {}.", flag.default_value));
  return out + '\n';
}

// A footer without filling: its lines are laid out by hand.
std::string as_it_stands(const std::string& text) {
  return text.empty() ? "" : fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text));
}

std::string section(const VerbText& verb) {
  std::string out = fmt::format(".SS {}\n{}.\n", roff(verb.command()), roff(verb.description));
  if (verb.verbs.empty()) {
    out += fmt::format(".PP\n{}\n", synopsis(verb));
    for (const FlagText& argument : verb.arguments) out += item(argument);
    for (const FlagText& flag : verb.flags) out += item(flag);
  }
  out += as_it_stands(verb.footer);
  for (const VerbText& part : verb.verbs) out += section(part);
  return out;
}

}  // namespace

std::string manual_page(const VerbText& program) {
  std::string out = fmt::format(
      ".TH NINEBIT 1 \"\" \"ninebit {0}\" \"User Commands\"\n"
      ".SH NAME\nninebit \\- {1}\n"
      ".SH SYNOPSIS\n\\fBninebit\\fR \\fIcommand\\fR [\\fIarguments\\fR] [\\fIflags\\fR]\n"
      ".SH FLAGS\n",
      NINEBIT_VERSION, roff(program.description));
  for (const FlagText& flag : program.flags) out += item(flag);
  out += as_it_stands(program.footer);
  out += ".SH COMMANDS\n";
  for (const VerbText& verb : program.verbs) out += section(verb);
  out +=
      ".SH EXIT STATUS\n.TP\n0\nSuccess.\n.TP\n1\nA check found a difference.\n.TP\n2\nWrong usage.\n"
      ".TP\n3\nUnreadable or invalid input.\n.TP\n4\nAn output could not be written.\n.TP\n5\nOut of memory.\n"
      ".TP\n128 + n\nSignal n ended the program.\n"
      ".SH ENVIRONMENT\n.TP\nNO_COLOR\nIf set and not empty, output is not coloured. Colours are used only on "
      "terminals.\n"
      ".TP\nTERM\nIf dumb, there are no escape sequences and no progress bar.\n";
  return out;
}

}  // namespace ninebit::tools
