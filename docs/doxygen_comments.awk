# Doxygen's input filter for the headers, whose comments are plain `//` lines. What stands directly above a declaration,
# or behind one on its line, documents it. A comment above several declarations without an empty line between them
# documents all of them.

# A comment's text with the characters that Doxygen takes for commands or HTML made plain; what stands between
# backquotes is left alone.
function plain(text,    parts, n, i, out) {
  n = split(text, parts, "`")
  for (i = 1; i <= n; ++i) {
    if (i % 2) gsub(/[\\@<>#&%]/, "\\\\&", parts[i])
    out = out (i > 1 ? "`" : "") parts[i]
  }
  return out
}

# Prints the comment block that has been read, as documentation of what follows.
function document(    i) {
  for (i = 1; i <= lines; ++i) print "/// " block[i]
}

FNR == 1 { lines = held = 0; top = 1; depth = 0 }

# The file's own comment, at its top.
top && /^\/\// { print (FNR == 1 ? "/// @file\n" : "") "/// " plain(substr($0, 4)); next }
{ top = 0 }

/^ *\/\/ clang-format/ { print ""; next }
/^ *\/\// {
  if (held) { lines = held = 0 }
  text = $0
  sub(/^ *\/\/ ?/, "", text)
  block[++lines] = plain(text)
  print ""
  next
}
/^ *$/ { lines = held = 0; print; next }
{
  held = 1
  print
}
