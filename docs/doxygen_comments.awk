# Doxygen's input filter for the headers, whose comments are plain `//` lines. What stands directly above a declaration,
# or behind one on its line, documents it. A comment above declarations that follow each other without an empty line
# documents all of them.

# A comment with the characters that Doxygen takes for commands or HTML made plain; what stands between backquotes is
# left alone.
function plain(text,    parts, n, i, out) {
  n = split(text, parts, "`")
  for (i = 1; i <= n; ++i) {
    if (i % 2) gsub(/[\\@<>#&%]/, "\\\\&", parts[i])
    out = out (i > 1 ? "`" : "") parts[i]
  }
  return out
}

function indent(text) {
  match(text, /^ */)
  return RLENGTH
}

FNR == 1 { top = 1; shown = 0; block = ""; level = -1 }

# The file's own comment.
top && /^\/\// { print "/// " (FNR == 1 ? "@file\n/// " : "") plain(substr($0, 4)); next }
{ top = 0 }

/^ *\/\/ clang-format/ { next }
/^ *\/\// {
  if (!open) { block = ""; level = indent($0) }
  open = 1
  text = $0
  sub(/^ *\/\/ ?/, "", text)
  block = block "/// " plain(text) "\n"
  next
}
/^ *$/ { open = 0; block = ""; level = -1; print; next }
{
  # A statement of its own at the comment's depth; one that goes on from the line above ends it.
  if (block != "" && indent($0) == level && fresh($0)) printf "%s", block
  open = 0
  print trailing($0)
}

function fresh(text) { return text !~ /^ *[})&|?:+*\/<>=]/ && text !~ /^ *#/ && text !~ /^ *(public|private|protected):/ }

# `code  // text` as `code  ///< text`.
function trailing(text,    at) {
  at = match(text, /[;,({}A-Za-z0-9_] +\/\/ /)
  if (!at) return text
  return substr(text, 1, RSTART) "  ///< " plain(substr(text, RSTART + RLENGTH))
}
