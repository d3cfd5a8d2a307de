# Doxygen's input filter for the pages. Pages and headings get names, as every version of Doxygen has others: that of the
# file, then that of the heading as in links on GitHub, in lower case, without punctuation, spaces as hyphens. A link to a
# public header leads to its page. A link to another file of the repository becomes its text, as the reference stands
# alone. Doxygen's Markdown wants pictures without their folders, no code in the text of a link, and none where emphasis
# begins; a quotation mark ends its code, unless that is between two backquotes.

function name_of(page, heading) {
  sub(/scenes\/README/, "scenes", page)
  sub(/.*\//, "", page)
  sub(/\.md$/, "", page)
  gsub(/-/, "_", page)
  return "page_" page (heading == "" ? "" : "_" heading)
}

function slug(text) {
  gsub(/\]\([^)]*\)/, "", text)
  text = tolower(text)
  gsub(/[^a-z0-9 _-]/, "", text)
  gsub(/ /, "-", text)
  return text
}

# A link's target in the reference; empty: it has none.
function target_of(link,    at) {
  at = index(link, "#")
  if (link ~ /:\/\// || link ~ /^@ref /) return link
  if (at) return "@ref " name_of(at > 1 ? substr(link, 1, at - 1) : FILENAME, substr(link, at + 1))
  if (link ~ /include\/ninebit\/.*\.h$/) {
    sub(/.*\//, "", link)
    return "@ref " link
  }
  if (link ~ /\.md$/) return "@ref " name_of(link)
  if (link !~ /\.png$/) return ""
  sub(/.*\//, "", link)
  return link
}

# Prints what was gathered of a text, whose links may go over the end of a line.
function flush(    out, at, label, target, parts, n, i) {
  while (match(text, /\[[^][]*\]\([^()]*\)/)) {
    at = index(substr(text, RSTART, RLENGTH), "](")
    label = substr(text, RSTART + 1, at - 2)
    target = target_of(substr(text, RSTART + at + 1, RLENGTH - at - 2))
    if (target !~ /:\/\//) gsub(/`/, "", label)
    out = out substr(text, 1, RSTART - 1) (target == "" ? label : "[" label "](" target ")")
    text = substr(text, RSTART + RLENGTH)
  }
  text = out text
  while (match(text, /(^|\n)\*`[^*]*\*/)) {
    at = index(substr(text, RSTART, 2), "*")
    text = substr(text, 1, RSTART + at - 2) "<em>" substr(text, RSTART + at, RLENGTH - at - 1) "</em>" substr(text, RSTART + RLENGTH)
  }
  n = split(text, parts, "`")
  for (i = 1; i <= n; ++i) printf "%s%s", parts[i], i == n ? "" : parts[i + i % 2] ~ /\047/ ? "``" : "`"
  text = ""
}

# A comment such as <!-- playground: sepia --> stays: docs/reference/live shows the effect there, once the playground is built.
/^<!-- playground: [a-z0-9_]+ -->$/ {
  flush()
  print "\n@htmlonly\n" $0 "\n@endhtmlonly\n"
  next
}
/^ *```/ { flush(); fenced = !fenced; print; next }
fenced { print; next }
/^##+ / {
  heading = $0
  sub(/^#+ /, "", heading)
  $0 = $0 " {#" name_of(FILENAME, slug(heading)) "}"
}
/^# / { $0 = ($0 == "# ninebit" ? "# Overview" : $0) " {#" name_of(FILENAME) "}\n\n[TOC]" }
{ text = text $0 "\n" }
END { flush() }
