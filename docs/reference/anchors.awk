# A page as GitHub reads it, for Doxygen: headings get the anchors that links use, with the page's name before, for they are one book there.
function slug(text) {
  text = tolower(text)
  gsub(/[^a-z0-9 _-]/, "", text)
  gsub(/ /, "-", text)
  return text
}
BEGIN {
  page = ARGV[1]
  sub(/.*\//, "", page)
  sub(/\.md$/, "", page)
}
/^```/ { fenced = !fenced }
!fenced && /^##+ / {
  text = $0
  sub(/^#+ /, "", text)
  $0 = $0 " {#" page "-" slug(text) "}"
}
!fenced {
  gsub(/\]\(#/, "](#" page "-")
  while (match($0, /\]\([A-Za-z0-9_.\/]+\.md#/)) {
    target = substr($0, RSTART + 2, RLENGTH - 6)
    sub(/.*\//, "", target)
    $0 = substr($0, 1, RSTART + 1) "#" target "-" substr($0, RSTART + RLENGTH)
  }
}
{ print }
