# How beams with mass are stepped: the share of a processor against the error of a swing.
load folder . '/style.gp'
w = 860
h = 700
rows(rule) = sprintf("< awk -F, '!/^#/ && $2 == \"%s\"' %s/swing.csv | sort -t, -k4g", rule, data)
note(n, text, x, y, colour) = sprintf("set label %d '%s' at %g, %g textcolor rgb '%s' font ',17'", n, text, x, y, colour)

set logscale xy
unset mxtics
unset mytics
set lmargin at screen 0.15
set rmargin at screen 0.95
set tmargin at screen 0.84
set bmargin at screen 0.13
set xrange [2.5e-3:2]
set yrange [3e-5:1]
set xtics ('0.5 %%' 0.005, '1 %%' 0.01, '2 %%' 0.02, '5 %%' 0.05, '20 %%' 0.2, '100 %%' 1)
set ytics ('10^{-4}' 1e-4, '10^{-3}' 1e-3, '1 %%' 0.01, '10 %%' 0.1, '100 %%' 1)
set xlabel 'share of a processor that the motion takes'
set ylabel 'largest error of the tip, of the length' offset 0.5
set arrow 1 from 1, graph 0 to 1, graph 1 nohead lc rgb grey dt (8, 5)

do for [format in 'svg png'] {
  eval begin('swing', format)
  set label 1 'A ruler that swings by 70 degrees to either side, for a period' at screen 0.5, 0.95 center font ',20'
  set label 2 'numbers: steps in a period of 0.11 s; masses' at screen 0.5, 0.9 center textcolor rgb grey font ',17'
  set label 3 'real time' at 0.93, graph 0.96 right textcolor rgb grey font ',17'
  eval note(4, 'TR-BDF2', 0.0029, 3.2e-4, blue)
  eval note(5, 'generalized α', 0.0125, 1.4e-3, green)
  eval note(6, 'trapezoidal rule', 0.0215, 3.4e-4, black)
  eval note(7, 'BDF2', 0.0072, 9e-3, orange)
  eval note(8, 'backward Euler', 0.0068, 0.15, vermilion)
  eval note(9, 'masses and springs', 0.08, 1.1e-2, purple)
  plot rows('backward Euler') using 5:6 with linespoints lc rgb vermilion lw 2 pt 4, \
    rows('BDF2') using 5:6 with linespoints lc rgb orange lw 2 pt 6, \
    rows('trapezoidal rule') using 5:6 with linespoints lc rgb black lw 1.5 pt 8, \
    rows('generalized alpha') using 5:6 with linespoints lc rgb green lw 2 pt 10, \
    rows('masses and springs') using 5:6 with linespoints lc rgb purple lw 2 pt 12, \
    rows('masses and springs') using 5:6:3 with labels left offset 0.8, 0.4 textcolor rgb purple font ',14', \
    rows('TR-BDF2') using 5:6 with linespoints lc rgb blue lw 3 pt 7, \
    rows('TR-BDF2') using 5:6:4 with labels right offset -0.8, -0.6 textcolor rgb blue font ',14'
  unset label
  set output
}
