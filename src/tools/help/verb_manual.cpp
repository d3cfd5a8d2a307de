// The manual page: troff of the macro package man(7).
#include <fmt/ranges.h>

#include <string_view>

#include "src/tools/help/verb_text.h"

namespace ninebit::tools {
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
