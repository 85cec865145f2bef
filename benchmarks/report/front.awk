# What nothing else in a scene is better than at both: awk -F, -v scene=… -f front.awk FILE; lines 'time,error' by time.
$1 == scene { time[++n] = $6; error[n] = $8 }
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
