# A page with what it quotes from docs/data filled in anew: awk -v data=FOLDER -v report=FOLDER -f numbers.awk -f fill.awk PAGE
#
#   <!-- from docs/data/NAME.csv: TABLE -->        the lines up to <!-- end --> are the table of that name in tables.awk
#   <!-- = NAME KEY=VALUE … COLUMN HOW -->1.2 µs<!-- = -->
#                          the text between is the number in that column of the first row of NAME.csv where each column KEY has
#                          that value (blanks are written _), as numbers.awk writes it;  COLUMN/KEY=VALUE … divides by the
#                          same column of another row, which differs in the keys that follow the stroke

function fail(why) {
  print FILENAME ":" FNR ": " why >"/dev/stderr"
  failed = 1
  exit 1
}

function read(name,  line, n, k, part, file) {
  if (name in rows) return
  file = data "/" name ".csv"
  rows[name] = 0
  while ((getline line < file) > 0) {
    if (line ~ /^#/) continue
    n = split(line, part, ",")
    if (!(name in columns)) {
      for (k = 1; k <= n; ++k) column[name, part[k]] = k
      columns[name] = n
      continue
    }
    ++rows[name]
    for (k = 1; k <= n; ++k) value[name, rows[name], k] = part[k]
  }
  close(file)
  if (!rows[name]) fail("no " file)
}

# The number that WANTED, an array of keys, asks for.
function look_up(name, wanted, result,  row, key, cell, found) {
  for (row = 1; row <= rows[name]; ++row) {
    found = 1
    for (key in wanted) {
      if (!((name, key) in column)) fail(name ".csv has no column " key)
      cell = value[name, row, column[name, key]]
      gsub(/ /, "_", cell)
      if (cell != wanted[key]) found = 0
    }
    if (found) return value[name, row, column[name, result]]
  }
  fail(name ".csv has no such row")
}

function number(mark,  part, n, k, wanted, other, key, result, divides, x) {
  n = split(mark, part, " ")
  read(part[1])
  for (k = 2; k < n; ++k) {
    if (part[k] ~ /\//) {
      key = part[k]
      result = substr(key, 1, index(key, "/") - 1)
      part[k] = substr(key, index(key, "/") + 1)
      divides = 1
      for (key in wanted) other[key] = wanted[key]
    }
    if (part[k] !~ /=/) { result = part[k]; continue }
    key = substr(part[k], 1, index(part[k], "=") - 1)
    if (divides) other[key] = substr(part[k], index(part[k], "=") + 1)
    else wanted[key] = substr(part[k], index(part[k], "=") + 1)
  }
  if (!((part[1], result) in column)) fail(part[1] ".csv has no column " result)
  x = look_up(part[1], wanted, result)
  if (divides) x /= look_up(part[1], other, result)
  return written(x, part[n])
}

/^<!-- end -->/ { skips = 0 }
skips { next }

/^<!-- from docs\/data\// {
  print
  match($0, /data\/[a-z_0-9]+\.csv/)
  file = data substr($0, RSTART + 4, RLENGTH - 4)
  table = $0
  sub(/^.*: /, "", table)
  sub(/ -->.*$/, "", table)
  command = "awk -F, -v table=" table " -f '" report "/numbers.awk' -f '" report "/tables.awk' '" file "'"
  print ""
  lines = 0
  while ((command | getline line) > 0) { print line; ++lines }
  if (close(command) != 0 || !lines) fail("no table " table " from " file)
  print ""
  skips = 1
  next
}

{
  done = ""
  rest = $0
  while ((at = index(rest, "<!-- = ")) > 0) {
    mark = substr(rest, at + 7)
    end = index(mark, " -->")
    after = index(mark, "<!-- = -->")
    if (!end || after < end) fail("<!-- = … --> without its <!-- = -->")
    done = done substr(rest, 1, at + 6 + end + 3) number(substr(mark, 1, end - 1)) "<!-- = -->"
    rest = substr(mark, after + 10)
  }
  print done rest
}

END { if (!failed && skips) fail("a table without its <!-- end -->") }
