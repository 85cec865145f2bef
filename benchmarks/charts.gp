# Draws what charts.sh has measured.  Needs `data`, the folder of the series, and `images`, where the charts go.
set encoding utf8
set terminal svg size 820,500 enhanced font 'sans-serif,15' background '#ffffff'

time = '#0072b2'
time_2 = '#56b4e9'
error = '#c4500c'
grey = '#555555'

# Time at the left in blue, error at the right in vermilion.
set style line 1 lc rgb time lw 2.5 pt 7 ps 0.7
set style line 2 lc rgb time_2 lw 2.5 pt 5 ps 0.7
set style line 3 lc rgb error lw 2 dt (6, 4) pt 9 ps 0.9
set border 11 lc rgb grey
set grid ytics lc rgb '#dddddd' lw 1 dt solid
set tics nomirror textcolor rgb '#222222'
set lmargin 10
set rmargin 11
set bmargin 4
set tmargin 6
set title font ',17' offset 0, 1.4
unset key
set errorbars small
set ytics textcolor rgb time
set y2tics textcolor rgb error
set y2label 'largest relative error of the force' textcolor rgb error offset 0.5
set logscale y2
unset my2tics
set format y2 '10^{%L}'
set y2range [1e-10:1]

set xlabel 'number of elements'
set logscale x 2
set xtics ('4' 4, '8' 8, '16' 16, '32' 32, '64' 64, '128' 128, '256' 256, '512' 512, '1024' 1024)
set xrange [3.5:1170]

set label 1 'time' at graph 0.33, 1.08 point ls 1 offset 1, -0.3
set label 3 'error (right)' at graph 0.55, 1.08 point ls 3 offset 1, -0.3

set output images . '/figure_3_8.svg'
set title "The full model: twice the elements take nearly twice the time\nand leave about a sixteenth of the error, down to round-off"
set ylabel 'time of a tick, µs' textcolor rgb time
set logscale y
unset mytics
set yrange [0.1:1000]
set ytics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '1000' 1000)
plot data . '/3_8' using 1:2:3:4 with yerrorlines ls 1, \
     '' using 1:5 axes x1y2 with linespoints ls 3

set output images . '/figure_3_9.svg'
set title "Training takes milliseconds, once: the trained model then has\nthe error of the elements it was trained with, down to its own"
set ylabel 'training with 14 snapshots, ms' textcolor rgb time
set yrange [0.01:100]
set ytics ('0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100)
plot data . '/3_9' using 1:($2 / 1000):($3 / 1000):($4 / 1000) with yerrorlines ls 1, \
     '' using 1:5 axes x1y2 with linespoints ls 3

set label 1 'time, force alone' at graph 0.04, 1.08 point ls 1 offset 1, -0.3
set label 2 'time, force and shape' at graph 0.38, 1.08 point ls 2 offset 1, -0.3
set label 3 'error (right)' at graph 0.78, 1.08 point ls 3 offset 1, -0.3

set output images . '/figure_3_10.svg'
set title "However many elements the trained model was trained with,\nit answers in the same time"
set ylabel 'time of a tick, µs' textcolor rgb time
unset logscale y
set yrange [0:0.4]
set ytics 0.1
plot data . '/3_10_force' using 1:2:3:4 with yerrorlines ls 1, \
     data . '/3_10_shape' using 1:2:3:4 with yerrorlines ls 2, \
     data . '/3_10_force' using 1:5 axes x1y2 with linespoints ls 3

set output images . '/figure_3_11.svg'
set title "Some 20 snapshots are enough:\nmore of them make the trained model slower and no better"
set xlabel 'number of snapshots'
set xtics ('4' 4, '6' 6, '8' 8, '10' 10, '14' 14, '20' 20, '28' 28, '40' 40, '64' 64)
set xrange [3.7:70]
plot data . '/3_11_force' using 1:2:3:4 with yerrorlines ls 1, \
     data . '/3_11_shape' using 1:2:3:4 with yerrorlines ls 2, \
     data . '/3_11_force' using 1:5 axes x1y2 with linespoints ls 3

# Accuracy against speed: a bar from the median to the largest error.
reset
set terminal svg size 1000,600 enhanced font 'sans-serif,15' background '#ffffff'
set output images . '/models.svg'
pod = '#0072b2'
galerkin = '#1b9e5a'
fem = '#c4500c'
set border 3 lc rgb grey
set grid lc rgb '#dddddd' lw 1 dt solid
set tics nomirror
set logscale xy
unset mytics
set format y '10^{%L}'
set xrange [0.05:50]
set yrange [2e-10:0.5]
set xtics ('0.1' 0.1, '1' 1, '10' 10)
set xlabel 'time of a tick, µs' offset 0, 0.4
set bmargin at screen 0.24
set tmargin at screen 0.82
unset key
set multiplot
set label 1 'Down and left is better: trained models have the accuracy of dozens of elements in the time of a few' \
  at screen 0.5, 0.95 center font ',17'

set label 2 'PodModel, force alone' at screen 0.07, 0.085 point lc rgb pod lw 2.5 pt 6 ps 1 offset 1, -0.3
set label 3 'PodModel, force and shape' at screen 0.07, 0.035 point lc rgb pod lw 2.5 pt 7 ps 1 offset 1, -0.3
set label 4 'GalerkinModel, force alone' at screen 0.35, 0.085 point lc rgb galerkin lw 2.5 pt 4 ps 1 offset 1, -0.3
set label 5 'GalerkinModel, force and shape' at screen 0.35, 0.035 point lc rgb galerkin lw 2.5 pt 5 ps 1 offset 1, -0.3
set label 6 'FemModel, by number of elements' at screen 0.67, 0.085 point lc rgb fem pt 7 ps 0.6 offset 1, -0.3

f(panel, model, what) = sprintf('%s/%s_%s_%d_%s', data, panel == 1 ? 'press' : 'slide', model, panel, what)
do for [panel = 1:2] {
  elements = data . (panel == 1 ? '/press_fem' : '/slide_fem')
  set lmargin at screen (panel == 1 ? 0.09 : 0.57)
  set rmargin at screen (panel == 1 ? 0.50 : 0.98)
  set title panel == 1 ? 'Pressed at mid-span' : 'Pressed anywhere from 5 to 95 % of the span' font ',16'
  set ylabel panel == 1 ? 'relative error of the force, median to largest' : ''
  plot elements using ($1 > 256 ? 1/0 : $2):5:6 with filledcurves lc rgb '#f6ddd0', \
       f(panel, 'pod', 'force') using 1:2:2:3 with yerrorbars lc rgb pod lw 2.5 pt 6 ps 1, \
       f(panel, 'pod', 'shape') using 1:2:2:3 with yerrorbars lc rgb pod lw 2.5 pt 7 ps 1, \
       f(panel, 'galerkin', 'force') using 1:2:2:3 with yerrorbars lc rgb galerkin lw 2.5 pt 4 ps 1, \
       f(panel, 'galerkin', 'shape') using 1:2:2:3 with yerrorbars lc rgb galerkin lw 2.5 pt 5 ps 1, \
       elements using ($1 > 256 ? 1/0 : $2):6 with linespoints lc rgb fem lw 2 pt 7 ps 0.6, \
       '' using ($1 > 256 ? 1/0 : $2):6:(sprintf('%d', $1)) with labels offset 1.8, 0.6 textcolor rgb fem
  unset label
}
unset multiplot
