# A tick of one hand on many beams: how it grows with beams that are touched, and with those that are only there.
load folder . '/style.gp'
w = 860
h = 620
rows(model, contacts) = sprintf("< awk -F, '!/^#/ && $1 == \"%s\" && $3 == %d' %s/many_beams.csv | sort -t, -k2g", model, contacts, data)
note(n, text, x, y, colour) = sprintf("set label %d '%s' at graph %g, %g textcolor rgb '%s' font ',17'", n, text, x, y, colour)
array touched[3] = [0, 10, 100]
array words[3] = ['none touched', '10 touched', '100 touched']

set logscale xy
unset mxtics
unset mytics
set lmargin at screen 0.14
set rmargin at screen 0.78
set tmargin at screen 0.86
set bmargin at screen 0.14
set xtics ('100' 100, '1000' 1000, '10 000' 1e4, '100 000' 1e5)
set ytics ('10 ns' 0.01, '0.1 µs' 0.1, '1 µs' 1, '10 µs' 10, '100 µs' 100)
set xrange [80:125000]
set yrange [0.008:200]
set xlabel 'beams'
set ylabel 'a tick'

do for [format in 'svg png'] {
  eval begin('many_beams', format)
  set label 1 'Many beams: what is not touched costs next to nothing' at screen 0.5, 0.95 center font ',20'
  eval note(2, 'FemModel, 8 elements', 0.04, 0.46, vermilion)
  eval note(3, 'PodModel', 0.04, 0.39, green)
  plot for [i = 1:3] rows('fem', touched[i]) using 2:4 with linespoints lc rgb vermilion lw 2.5 pt 7, \
    for [i = 1:3] rows('pod', touched[i]) using 2:4 with linespoints lc rgb green lw 2.5 pt 6, \
    for [i = 1:3] rows('fem', touched[i]) . ' | tail -n 1' using 2:4:(words[i]) with labels left offset 1, 0 \
      textcolor rgb black font ',17'
  unset label
  set output
}
