# How numbers are written.

# 0.123, 1.23, 12.3, 123
function digits(x) { return sprintf(x < 1 ? "%.2f" : x < 10 ? "%.1f" : "%.0f", x) }

# 4·10⁻⁵
function power(x,  text, part, exponent) {
  text = sprintf("%.0e", x)
  split(text, part, "e")
  split("⁰ ¹ ² ³ ⁴ ⁵ ⁶ ⁷ ⁸ ⁹", superscript, " ")
  exponent = part[2] + 0
  text = exponent < 0 ? "⁻" : ""
  if (exponent < 0) exponent = -exponent
  if (exponent >= 10) text = text superscript[int(exponent / 10) + 1]
  return (part[1] == 1 ? "" : part[1] "·") "10" text superscript[exponent % 10 + 1]
}

# 0.3 %, 12 %; below a thousandth as a power of ten
function percent(x) {
  if (x == "") return "–"
  if (x < 0.000995) return power(x)
  return sprintf(x < 0.00995 ? "%.1f %%" : "%.0f %%", 100 * x)
}

# [ns]
function time(ns) { return ns < 1e6 ? digits(ns / 1e3) " µs" : digits(ns / 1e6) " ms" }

# [bytes]
function size(bytes) { return bytes < 1e6 ? digits(bytes / 1e3) " kB" : digits(bytes / 1e6) " MB" }

function written(x, how) {
  if (how == "time") return time(x)
  if (how == "µs") return digits(x) " µs"
  if (how == "ms") return digits(x) " ms"
  if (how == "percent") return percent(x)
  if (how == "size") return size(x)
  if (how == "digits") return digits(x)
  print "no such way to write a number: " how >"/dev/stderr"
  exit 1
}
