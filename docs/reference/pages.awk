# Doxygen's input filter for the pages: headings get the names that links on GitHub have for them, as Doxygen before 1.10
# has others. A name is that of the file, then that of the heading: lower case, without punctuation, spaces as hyphens.

function name_of(page, heading) {
  sub(/.*\//, "", page)
  sub(/\.md$/, "", page)
  return "page_" page "_" heading
}

function slug(text) {
  gsub(/\]\([^)]*\)/, "", text)
  text = tolower(text)
  gsub(/[^a-z0-9 _-]/, "", text)
  gsub(/ /, "-", text)
  return text
}

/^```/ { fenced = !fenced; print; next }
fenced { print; next }
/^##+ / {
  heading = $0
  sub(/^#+ /, "", heading)
  print $0 " {#" name_of(FILENAME, slug(heading)) "}"
  next
}
{
  line = $0
  out = ""
  while (match(line, /\]\([^)#:]*#[^)]*\)/)) {
    link = substr(line, RSTART + 2, RLENGTH - 3)
    out = out substr(line, 1, RSTART) "(@ref " name_of(index(link, "#") > 1 ? substr(link, 1, index(link, "#") - 1) : FILENAME,
                                                       substr(link, index(link, "#") + 1)) ")"
    line = substr(line, RSTART + RLENGTH)
  }
  print out line
}
