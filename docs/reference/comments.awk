# Doxygen's input filter for the headers, whose comments are plain `//` lines, or `/* */` in those for C. What stands
# directly above a declaration, or behind one on its line, documents it. A `//` comment above declarations that follow
# each other without an empty line documents all of them, and so does one of either place where a declaration names
# several things. Lines keep their numbers, so that Doxygen's warnings name the right ones.
#
# What a header declares stands in the group of its room, which is its folder (rooms.dox), and its page shows its example,
# combiner_tests/examples/HEADER.cpp: its lines without the frame of the test.

# A comment with the characters that Doxygen takes for commands or HTML made plain; what stands between backquotes is
# left alone.
function plain(text,    parts, n, i, out) {
  n = split(text, parts, "`")
  for (i = 1; i <= n; ++i) {
    if (i % 2) {
      gsub(/[\\@<>#&%]/, "\\\\&", parts[i])
      gsub(/--/, "\\--", parts[i])
    }
    out = out (i > 1 ? "`" : "") parts[i]
  }
  return out
}

function indent(text) {
  match(text, /^ */)
  return RLENGTH
}

# Whether a declaration begins here; otherwise it goes on from the line above, or is none.
function fresh(text) { return text !~ /^ *([})&|?:+*\/<>=]|public:|private:|protected:|#)/ || text ~ /^ *#define / }

function starts_item(text) { return text ~ /^ *(-|[0-9]+\.) / }

# Whether line i of the block is indented as code or a table is.
function set_in(i) { return i <= lines && block[i] ~ /^  +[^ ]/ }

# Prints the block in its place: as documentation, or to keep the count of lines. Lines that are indented, and are not part
# of a list, keep their blanks.
function flush(documents,    i, list, literal, line) {
  for (i = 1; i <= lines; ++i) {
    line = plain(block[i])
    if (literal) gsub(/`/, "", line)
    if (starts_item(block[i])) list = 1
    else if (block[i] ~ /^[^ ]/) list = 0
    if (!literal && !list && set_in(i + 1) && !starts_item(block[i + 1])) {
      literal = 1
      line = line " <pre>"
    } else if (literal && !set_in(i + 1) && !(block[i + 1] == "" && set_in(i + 2))) {
      literal = 0
      line = line " </pre>"
    }
    print documents ? "/// " line : "//"
  }
  lines = 0
}

# `TYPE a, b = 1;` as `TYPE a; TYPE b = 1;`, each with the comments of all: `before` but for the first, and `behind`.
function declaration(code, before, behind,    depth, i, c, n, part, type, out) {
  if (code !~ /^ *[A-Za-z].*;$/ || code ~ /^ *(using|return|friend|template|typedef) /) return code behind
  n = 1
  for (i = 1; i < length(code); ++i) {
    c = substr(code, i, 1)
    if (index("<({[", c)) ++depth
    if (index(">)}]", c) && --depth < 0) return code behind
    if (c == "," && depth == 0) ++n
    else part[n] = part[n] c
  }
  if (n == 1) return code behind
  type = part[1]
  sub(/( = |\{|\[).*/, "", type)
  sub(/[A-Za-z0-9_]+$/, "", type)
  out = part[1] ";" behind
  for (i = 2; i <= n; ++i) out = out " " before type part[i] ";" behind
  return out
}

# The file's room and example, as a second comment on the file behind its last line.
function print_file_page(    path, line, body) {
  print "/** @file"
  print "@ingroup " room
  path = FILENAME
  sub(/.*\//, "combiner_tests/examples/", path)
  sub(/\.h$/, ".cpp", path)
  print "\n@par Example"
  print "@code{.cpp}"
  while ((getline line < path) > 0) {
    if (line ~ /^TEST\(/) body = 1
    else if (body && line ~ /^}/) body = 0
    else if (line !~ /^#include <gtest/) print substr(line, body ? 3 : 1)
  }
  close(path)
  print "@endcode"
  print "*/"
}

FNR == 1 { top = 1; lines = 0; said = ""; level = -1; trailed = 0; kept = 0; within = 0; goes_on = 0
  room = FILENAME
  sub(/\/[^\/]*$/, "", room)
  sub(/.*\//, "", room)
}

# The file's own comment, up to #pragma once.
top && /^#pragma once/ { flush(1); print "/// @file"; top = 0; next }
top {
  text = $0
  sub(/ *\*\/$/, "", text)
  sub(/^(\/\/|\/\*| \*|  ) ?/, "", text)
  block[++lines] = text
  next
}

# What a namespace declares is in the room's group, under the header's name.
/^(namespace .*|extern "C") \{$/ {
  name = FILENAME
  sub(/.*include\/ninebit\//, "", name)
  print $0 " /** @addtogroup " room " */ /** @{ */ /** @name " name " */ /** @{ */"
  next
}
/^}  \/\/ namespace / || (/^}$/ && room == "capi") { print "/** @} */ /** @} */ " $0; next }

# C comments, each of one declaration; those that begin with --- divide the file.
kept || /^ *\/\* ---/ { kept = !/\*\/ *$/; print; next }
within || /^ *\/\*/ {
  within = !/\*\/ *$/
  sub(/^ *\/\*/, "/**")
  ending = sub(/\*\/ *$/, "") ? "*/" : ""
  opening = sub(/^\/\*\*/, "") ? "/**" : ""
  print opening plain($0) ending
  next
}
/[;,a-z0-9] +\/\* .*\*\/$/ {
  match($0, / +\/\* /)
  print substr($0, 1, RSTART) "/**< " plain(substr($0, RSTART + RLENGTH, length($0) - RSTART - RLENGTH - 1)) "*/"
  next
}

/^ *\/\/ clang-format/ { print ""; next }
/^ *\/\// {
  text = $0
  sub(/^ *\/\/ ?/, "", text)
  if (trailed && indent($0) > trailed) { print "///< " plain(text); next }  # it goes on from the line above
  if (!lines) { said = ""; level = indent($0) }
  block[++lines] = text
  said = said (said == "" ? "" : " ") text
  trailed = 0
  next
}
/^ *$/ { flush(0); said = ""; level = -1; trailed = 0; print; next }
{
  before = behind = prefix = ""
  trailed = 0
  documented = said != "" && indent($0) == level && fresh($0) && !goes_on
  if (!lines && /^ *(virtual )?~/) {
    prefix = "/** Frees what the object holds. */ "
    documented = 0
    said = ""
  }
  goes_on = /^ *template <.*>$/
  if (/^ *};/ && indent($0) == level) said = ""
  at = match($0, /[;,({}A-Za-z0-9_] +\/\/ /)
  if (at) {
    behind = plain(substr($0, RSTART + RLENGTH))
    $0 = substr($0, 1, RSTART)
    trailed = indent($0) + 1
  }
  # A member's own comment comes before that of its group: it is the brief one.
  if (at && documented && /[;,]$/ && !/^ *(enum|struct|class) /) {
    behind = behind (behind ~ /[.:;,]$/ ? "" : ".") " " plain(said)
    flush(0)
  } else if (documented) {
    before = "/** " plain(said) " */ "
    if (!lines) prefix = before
    flush(1)
  } else {
    flush(0)
    if (/operator==\(.*= default;$/) prefix = "/** Compares all members. */ "
  }
  if (at) behind = " /**< " behind " */"
  print prefix declaration($0, before, behind)
}
END { print_file_page(); print "using namespace ninebit;" }
