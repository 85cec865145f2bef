# What nothing else in a scene is better than at both: awk -F, -v scene=… -f front.awk FILE FILE, the same file twice; lines
# 'time,error' by time.  Of a trained model with several numbers of modes, the one with the most, as in series.awk.
$1 != scene { next }
FNR == NR { if (!(($2, $5) in most) || $4 > most[$2, $5]) most[$2, $5] = $4; next }
$4 == most[$2, $5] { time[++n] = $6; error[n] = $8 }
END {
  for (;;) {
    best = 0
    for (k = 1; k <= n; ++k)
      if ((last == "" || error[k] < last) &&
          (!best || time[k] < time[best] || (time[k] == time[best] && error[k] < error[best])))
        best = k
    if (!best) break
    last = error[best]
    print time[best] "," last
  }
  print "1e9," last
}
