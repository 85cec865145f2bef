# What sizes cost: the thesis' Figures 3.8 to 3.11, modes, snapshots, beams, memory.
load folder . '/style.gp'
w = 860
h = 860
# Lines of a CSV file whose first columns are these, * for any.
rows(name, first, second, fourth) = sprintf("< awk -F, -v a='%s' -v b='%s' -v d='%s' '!/^#/ && $1 == a && $2 == b && (d == \"*\" || $4 == d)' %s/%s.csv | sort -t, -k3g", first, second, fourth, data, name)
figure(n, what) = rows('thesis_figures', n, 'pinned', what)
cost(what, model) = rows('costs', what, model, '*')

elements = "set xtics ('4' 4, '16' 16, '64' 64, '256' 256, '1024' 1024)"
times = "set ytics ('0.1 µs' 0.1, '1 µs' 1, '10 µs' 10, '100 µs' 100, '1 ms' 1e3, '10 ms' 1e4, '100 ms' 1e5, '1 s' 1e6)"
errors = "set ytics ('100 %%' 1, '10 %%' 0.1, '1 %%' 0.01, '0.1 %%' 1e-3, '10^{-4}' 1e-4, '10^{-5}' 1e-5, '10^{-6}' 1e-6, '10^{-7}' 1e-7, '10^{-8}' 1e-8, '10^{-9}' 1e-9)"
upper = "set tmargin at screen 0.86; set bmargin at screen 0.53; unset xlabel; set format x ''; set ylabel 'time' offset 0.5; " . times
lower = "set tmargin at screen 0.45; set bmargin at screen 0.12; set format x; set ylabel 'largest error' offset 0.5; " . errors
whole = "set tmargin at screen 0.86; set bmargin at screen 0.14; set format x"
head(text) = "set label 1 '" . text . "' at screen 0.5, 0.95 center font ',20'"
note(n, text, x, y, colour) = sprintf("set label %d '%s' at graph %g, %g textcolor rgb '%s' font ',17'", n, text, x, y, colour)

kinds = 'fem_64 fem_8 galerkin pod'
tints = orange . ' ' . vermilion . ' ' . black . ' ' . green
marks = '6 7 13 7'
lifts = '0 -0.5 0.5 0'
array titles[4] = ['64 elements', '8 elements', 'GalerkinModel', 'PodModel']

set logscale xy
unset mxtics
unset mytics
set lmargin at screen 0.16
set rmargin at screen 0.96

do for [format in 'svg png'] {
  # Figures 3.8 and 3.9.
  do for [n in '3_8 3_9'] {
    eval begin('figure_' . n, format)
    eval head(n eq '3_8' ? 'Finite elements: twice as many take twice the time' : 'Training with 14 snapshots, once for all')
    eval elements
    set xrange [3.5:1170]
    set multiplot
    eval upper
    set yrange [n eq '3_8' ? 0.2 : 20 : n eq '3_8' ? 300 : 30000]
    plot figure('figure_' . n, '*') using 3:5 with linespoints lc rgb vermilion lw 2.5 pt 7
    unset label
    eval lower
    set xlabel 'number of elements'
    set yrange [1e-10:0.3]
    plot figure('figure_' . n, '*') using 3:6 with linespoints lc rgb vermilion lw 2.5 pt 7
    unset multiplot
    set output
  }

  # Figures 3.10 and 3.11.
  do for [n in '3_10 3_11'] {
    eval begin('figure_' . n, format)
    eval head(n eq '3_10' ? 'Trained: elements cost nothing in the loop' : 'Trained: what costs is snapshots, and 20 are enough')
    if (n eq '3_10') { eval elements; set xrange [3.5:1170] } else {
      set xtics ('4' 4, '6' 6, '10' 10, '20' 20, '40' 40, '64' 64)
      set xrange [3.7:70]
    }
    set multiplot
    eval upper
    unset logscale y
    set ytics ('0' 0, '0.1 µs' 0.1, '0.2 µs' 0.2, '0.3 µs' 0.3, '0.4 µs' 0.4)
    set yrange [0:0.4]
    eval note(2, 'force and shape', 0.04, n eq '3_10' ? 0.82 : 0.72, green)
    eval note(3, 'force alone', 0.04, n eq '3_10' ? 0.32 : 0.3, sky)
    plot figure('figure_' . n, 'shape') using 3:5 with linespoints lc rgb green lw 2.5 pt 7, \
      figure('figure_' . n, 'force') using 3:5 with linespoints lc rgb sky lw 2.5 pt 6
    unset label
    set logscale y
    eval lower
    set xlabel n eq '3_10' ? 'number of elements that it was trained with' : 'number of snapshots, at mid-span'
    set yrange [1e-10:1]
    plot figure('figure_' . n, 'force') using 3:6 with linespoints lc rgb green lw 2.5 pt 7
    unset multiplot
    set output
  }

  # Modes: their shape, for they have no bearing on the force.
  eval begin('modes', format)
  eval head('Modes are for the shape: the force does without')
  set xtics ('1' 1, '2' 2, '4' 4, '8' 8, '16' 16, '32' 32)
  set xrange [0.9:37]
  set multiplot
  eval upper
  set yrange [0.1:2]
  set ytics ('0.1 µs' 0.1, '0.2' 0.2, '0.5' 0.5, '1 µs' 1, '2' 2)
  plot cost('modes', 'pod') using 3:4 with linespoints lc rgb green lw 2.5 pt 7
  unset label
  eval lower
  set xlabel 'number of modes'
  set yrange [3e-7:2]
  eval note(2, 'shape', 0.68, 0.85, green)
  eval note(3, 'force', 0.6, 0.22, grey)
  plot cost('modes', 'pod') using 3:7 with linespoints lc rgb green lw 2.5 pt 7, \
    cost('modes', 'pod') using 3:6 with linespoints lc rgb grey lw 2 pt 6
  unset label
  unset multiplot
  set output

  # Snapshots, anywhere on the beam.
  eval begin('snapshots', format)
  eval head('Trained anywhere on the beam: some 200 presses do')
  set xtics ('50' 50, '100' 100, '200' 200, '500' 500, '1000' 1000, '3000' 3000)
  set xrange [43:3500]
  set multiplot
  eval upper
  set yrange [0.1:3e6]
  set ytics ('1 µs' 1, '1 ms' 1e3, '1 s' 1e6)
  eval note(2, 'training', 0.04, 0.88, black)
  eval note(3, 'a tick', 0.04, 0.3, black)
  plot cost('snapshots', 'pod') using 3:4 with linespoints lc rgb green lw 2.5 pt 7, \
    cost('snapshots', 'galerkin') using 3:4 with linespoints lc rgb black lw 2.5 pt 13, \
    cost('snapshots', 'pod') using 3:($5 * 1e3) with linespoints lc rgb green lw 2.5 pt 7, \
    cost('snapshots', 'galerkin') using 3:($5 * 1e3) with linespoints lc rgb black lw 2.5 pt 13
  unset label
  eval lower
  set xlabel 'number of snapshots'
  set yrange [1e-8:0.3]
  eval note(2, 'PodModel', 0.75, 0.05, green)
  eval note(3, 'GalerkinModel', 0.68, 0.32, black)
  plot cost('snapshots', 'pod') using 3:6 with linespoints lc rgb green lw 2.5 pt 7, \
    cost('snapshots', 'galerkin') using 3:6 with linespoints lc rgb black lw 2.5 pt 13
  unset label
  unset multiplot
  set output

  # Beams.
  eval begin('beams', format)
  eval head('Many beams, pressed in turn')
  eval whole
  set xtics ('1' 1, '4' 4, '16' 16, '64' 64, '256' 256, '1024' 1024)
  set xrange [0.85:1250]
  set yrange [0.1:2]
  set xlabel 'number of beams, ticked in turn'
  set ylabel 'a tick of one of them'
  eval times
  set rmargin at screen 0.74
  beams(kind) = cost('beams', kind)
  plot for [i = 1:4] beams(word(kinds, i)) using 3:4 with linespoints lc rgb word(tints, i) lw 2.5 pt int(word(marks, i)), \
    for [i = 1:4] beams(word(kinds, i)) . ' | tail -n 1' using 3:4:(titles[i]) with labels left offset 0.8, real(word(lifts, i)) \
      textcolor rgb word(tints, i) font ',17'
  set rmargin at screen 0.96
  unset label
  set output

  # Memory.
  eval begin('memory', format)
  eval head('Memory of one model')
  eval whole
  set xtics ('4' 4, '16' 16, '64' 64, '256' 256, '1024' 1024, '3072' 3072)
  set xrange [3.5:3600]
  set yrange [1e3:3e6]
  set xlabel 'number of elements or snapshots'
  set ylabel 'one model'
  set ytics ('1 kB' 1e3, '10 kB' 1e4, '100 kB' 1e5, '1 MB' 1e6)
  eval note(2, 'FemModel, elements', 0.2, 0.1, vermilion)
  eval note(3, 'GalerkinModel, snapshots', 0.15, 0.75, black)
  eval note(4, 'PodModel, snapshots', 0.15, 0.68, green)
  plot cost('elements', 'fem') using 3:8 with linespoints lc rgb vermilion lw 2.5 pt 7, \
    cost('snapshots', 'galerkin') using 3:8 with linespoints lc rgb black lw 2.5 pt 13, \
    cost('snapshots', 'pod') using 3:8 with linespoints lc rgb green lw 2.5 pt 7
  unset label
  set output
}
