# Draws what where_methods_fail.sh has found.  Needs `data`, the folder of the series, and `charts`, where the charts go.
set encoding utf8
set datafile separator ','

fails = '#c4500c'
worse = '#e08a00'
library = '#0072b2'
other = '#1b9e5a'
grey = '#777777'

# Where panel `column`, `row` (from the top) of a chart of 2 columns and `rows` rows lies.
left(column) = column == 1 ? 0.105 : 0.605
top(row) = rows == 1 ? 0.84 : row == 1 ? 0.925 : 0.435
panel = "set lmargin at screen left(column); set rmargin at screen left(column) + 0.375; \
  set tmargin at screen top(row); set bmargin at screen top(row) - (rows == 1 ? 0.66 : 0.345); \
  unset logscale; unset label; unset arrow; unset object; set format '%g'; set xtics auto; set ytics auto; \
  set key default; set key top left Left reverse samplen 1.6 spacing 1.1 font key_font textcolor rgb '#222222'; \
  unset mxtics; unset mytics; set xrange [*:*]; set yrange [*:*]"
next_panel = "if (column == 2) { column = 1; row = row + 1 } else { column = 2 }; eval panel"
powers_x = "set logscale x; unset mxtics; set format x '10^{%L}'"
powers_y = "set logscale y; unset mytics; set format y '10^{%L}'"
plain_y = "set logscale y; unset mytics; set format y '%g'"
doubling = "set logscale x 2; set xtics ('2' 2, '4' 4, '8' 8, '16' 16, '32' 32, '64' 64, '128' 128, '256' 256, '1024' 1024, '4096' 4096, '16384' 16384)"
file(name) = data . '/fail_' . name . '.csv'
above(name) = charts . '/fail_' . name . '.' . format

do for [format in 'svg png'] {
  if (format eq 'svg') {
    wide = "set terminal svg size 1000,480 enhanced font 'sans-serif,17' background '#ffffff'"
    tall = "set terminal svg size 1000,900 enhanced font 'sans-serif,17' background '#ffffff'"
    key_font = ',15'
    title_font = ',17'
  } else {
    wide = "set terminal pngcairo size 1000,480 enhanced font 'sans-serif,12.5' background '#ffffff'"
    tall = "set terminal pngcairo size 1000,900 enhanced font 'sans-serif,12.5' background '#ffffff'"
    key_font = ',11'
    title_font = ',12.5'
  }
  set terminal unknown
  set style line 1 lc rgb fails lw 2.5 pt 7 ps 0.6
  set style line 2 lc rgb worse lw 2 pt 5 ps 0.6
  set style line 3 lc rgb library lw 2.5 pt 7 ps 0.6
  set style line 4 lc rgb other lw 2 pt 9 ps 0.6
  set style line 5 lc rgb grey lw 1.5 dt (6, 4)
  set border 3 lc rgb '#555555'
  set tics nomirror textcolor rgb '#222222'
  set grid lc rgb '#e2e2e2' lw 1 dt solid

  # Elements
  eval wide
  set output above('elements')
  rows = 1; row = 1; column = 1
  set multiplot
  eval panel
  set title "A bar that slides at its ends is bent by 5 heights:\nfull integration stretches it" font title_font
  set xlabel 'number of elements'
  set ylabel 'relative error of the deflection'
  eval doubling
  eval powers_y
  set yrange [1e-17:100]
  set xrange [1.8:290]
  set key at graph 0.98, 0.62 right
  plot file('locking') every ::1 using 1:2 with linespoints ls 1 title 'full integration', \
       '' every ::1 using 1:($3 > 1e-16 ? $3 : 1e-16) with linespoints ls 3 title 'assumed strain: round-off'
  eval next_panel
  set title "A cantilever under a tip load:\nmoderate rotation does not limit the deflection" font title_font
  set xlabel 'PL²/EI'
  set ylabel 'deflection of the tip, lengths'
  set yrange [0:2]
  set key bottom right
  plot file('rotation') every ::1 using 1:3 with lines ls 1 title 'VonKarman', \
       '' every ::1 using 1:2 with lines lw 5 lc rgb '#bbbbbb' title 'elastica', \
       '' every ::1 using 1:4 with lines ls 3 title 'Corotational, 8 elements'
  unset multiplot

  # Newton
  eval tall
  set output above('newton')
  rows = 2; row = 1; column = 1
  set multiplot
  eval panel
  set title "Solves from rest to a deflection of 0.81 lengths:\nplain Newton depends on the mesh" font title_font
  set xlabel 'number of elements'
  set ylabel 'linear solves'
  eval doubling
  set xtics add ('512' 512)
  eval plain_y
  set yrange [10:3000]
  set xrange [7:1150]
  plot file('newton_far') every ::1 using 1:3 with linespoints ls 1 title 'plain Newton, fewest load steps', \
       '' every ::1 using 1:4 with linespoints ls 3 title 'chain laid'
  eval next_panel
  set title "A shallow arch: load control fails\nbetween its limit points" font title_font
  set xlabel 'middle pressed down, rises'
  set ylabel 'load, EI/L²'
  set xrange [0:2.5]
  set yrange [0:3.6]
  plot file('limit_path') every ::1 using 1:2 with lines lw 5 lc rgb '#cccccc' title 'by arc length', \
       file('limit_load') every ::1 using 1:2 with linespoints ls 1 dt (3, 3) title 'load raised step by step', \
       file('limit_press') every ::1 using 1:2 with points ls 3 title 'press'
  eval next_panel
  set title "Ends moved together: solved from straight,\na beam stays straight" font title_font
  set xlabel "shortening, of what Euler's load takes"
  set ylabel 'middle aside, lengths'
  set yrange [-0.0005:0.009]
  set xrange [0:10]
  plot file('buckling') every ::1 using 1:2 with lines ls 1 title 'from straight', \
       '' every ::1 using 1:3 with linespoints ls 3 title 'FemModel'
  eval next_panel
  set title "… and its stiffness is negative" font title_font
  set ylabel 'stiffness of a press, EI/L³'
  set yrange [-300:700]
  set xrange [0:6]
  plot file('buckling') every ::1 using 1:4 with lines ls 1 title 'from straight', \
       '' every ::1 using 1:5 with linespoints ls 3 title 'FemModel', 0 with lines ls 5 notitle
  unset multiplot

  # Snapshots
  set output above('snapshots')
  rows = 2; row = 1; column = 1
  set multiplot
  eval panel
  set title 'More equidistant snapshots make it worse' font title_font
  set xlabel 'number of snapshots'
  set ylabel 'largest relative error of the force'
  eval powers_y
  set yrange [1e-16:1e14]
  set xrange [0:66]
  plot file('interpolation') every ::1 using 1:3 with linespoints ls 1 title 'equidistant, 10^{-10} of noise', \
       '' every ::1 using 1:2 with linespoints ls 2 title 'equidistant, exact', \
       '' every ::1 using 1:4 with linespoints ls 3 title "Chebyshev's, 10^{-10} of noise"
  eval next_panel
  set title 'Noise grows by 10^{12}, or not at all' font title_font
  set xlabel 'relative noise of the snapshots'
  eval powers_x
  eval powers_y
  set xtics 1e-15, 1e3
  set yrange [1e-16:1e19]
  plot file('noise') every ::1 using 1:2 with linespoints ls 1 title '50 equidistant', \
       '' every ::1 using 1:3 with linespoints ls 3 title "50 of Chebyshev's", \
       '' every ::1 using 1:4 with linespoints ls 4 title "14 of Chebyshev's"
  eval next_panel
  set title 'Deeper than trained, a polynomial diverges' font title_font
  set xlabel 'depth / trained depth'
  set ylabel 'relative error of the force'
  eval powers_y
  set yrange [1e-11:1e16]
  set xrange [0.8:3]
  plot file('extrapolation') every ::1 using 1:2 with lines ls 2 title '50 equidistant', \
       '' every ::1 using 1:3 with lines ls 1 title "14 of Chebyshev's", \
       '' every ::1 using 1:4 with lines ls 5 lc rgb library dt solid title 'PodModel: tangent', \
       '' every ::1 using 1:6 with lines ls 3 title 'Guarded: finite elements', \
       '' every ::1 using 1:5 with lines ls 4 title 'GalerkinModel: solves'
  eval next_panel
  set title 'Interpolated forces do work on a closed path' font title_font
  set xlabel 'rounds'
  set ylabel 'work of the hand / stored energy'
  set xrange [0:5]
  set yrange [*:*]
  plot file('potential') every ::1 using 1:2 with lines ls 1 title 'table of forces', \
       '' every ::1 using 1:3 with lines ls 3 title 'derivative of a work'
  unset multiplot

  # Modes and digits
  set output above('modes')
  rows = 2; row = 1; column = 1
  set multiplot
  eval panel
  set title "The jump of w''' moves with the contact:\nglobal modes converge slowly" font title_font
  set xlabel 'number of modes'
  set ylabel 'relative error of the force'
  eval powers_x
  set format x '%g'
  eval powers_y
  set yrange [1e-7:100]
  set xrange [1:100]
  set key top right
  plot file('modes') every ::1 using 1:2 with lines ls 1 title 'global modes', \
       '' every ::1 using 1:3 with lines ls 3 title 'one that moves with it'
  eval next_panel
  set title 'Units decide which modes are kept' font title_font
  set ylabel 'largest error of u, w or θ'
  eval powers_y
  set yrange [1e-5:100]
  set xrange [0:80]
  set key top right
  plot file('units') every ::1 using 1:2 with lines ls 1 title 'in m and rad', \
       '' every ::1 using 1:3 with lines ls 2 title 'in mm and rad', \
       '' every ::1 using 1:4 with lines ls 3 title 'dimensionless'
  eval next_panel
  set title 'Squares lose half of the digits' font title_font
  set xlabel 'mode'
  set ylabel 'singular value / the first'
  eval powers_y
  set yrange [1e-14:10]
  set xrange [0:100]
  set key top right
  plot file('spectrum') every ::1 using 1:($3 > 0 ? $3 : NaN) with lines ls 1 title 'eigenvalues of XXᵀ', \
       '' every ::1 using 1:($2 > 0 ? $2 : NaN) with lines ls 3 title 'SVD'
  eval next_panel
  set title 'The residual of fine meshes loses digits' font title_font
  set xlabel 'number of elements'
  set ylabel 'relative'
  eval doubling
  set xtics ('4' 4, '16' 16, '64' 64, '256' 256, '1024' 1024, '4096' 4096, '16384' 16384)
  eval powers_y
  set yrange [1e-16:1e6]
  set xrange [3.5:19000]
  plot file('round_off') every ::1 using 1:4 with linespoints ls 1 title 'least residual', \
       1e-8 with lines ls 5 title 'tolerance', \
       '' every ::1 using 1:3 with linespoints ls 4 title 'force, float', \
       '' every ::1 using 1:2 with linespoints ls 3 title 'force, double'
  unset multiplot

  # Contact
  set output above('contact')
  rows = 2; row = 1; column = 1
  set multiplot
  eval panel
  set title '8 linear elements: a node must follow' font title_font
  set xlabel 'where, of the span'
  set ylabel 'relative error of the force'
  eval powers_y
  set yrange [1e-16:1e6]
  set xrange [0:0.5]
  plot file('inside') every ::1 using 1:2 with lines ls 2 title 'at the nearest node', \
       '' every ::1 using 1:($3 > 1e-14 ? $3 : NaN) with lines ls 1 title 'inside the element', \
       '' every ::1 using 1:($4 > 1e-16 ? $4 : 1e-16) with lines ls 3 title 'at a node that follows'
  eval next_panel
  set title 'Near a support float loses its digits' font title_font
  set xlabel 'distance, lengths'
  eval powers_x
  eval powers_y
  set yrange [1e-16:1e8]
  set xrange [1e-9:0.2]
  set key top right
  set arrow from 1e-3, 1e-16 to 1e-3, 1e-2 nohead lc rgb library lw 1.5 dt (6, 4)
  set arrow from 0.0345, 1e-16 to 0.0345, 1e-2 nohead lc rgb other lw 1.5 dt (6, 4)
  plot file('support') every ::1 using 1:3 with linespoints ls 4 title 'float', \
       '' every ::1 using 1:2 with linespoints ls 3 title 'double', \
       NaN with lines ls 5 title 'where range() ends'
  eval next_panel
  set title 'Off the end of a ruler, 10 mm down' font title_font
  set xlabel 'past the end, mm'
  set ylabel 'force on the hand, N'
  set xrange [-20:30]
  set yrange [0:4]
  plot file('past_end') every ::1 using 1:2 with lines ls 1 title 'held to its end', \
       '' every ::1 using 1:3 with lines ls 3 title 'Touch, across', \
       '' every ::1 using 1:(abs($4)) with lines ls 4 title 'Touch, along'
  eval next_panel
  set title 'A point falls onto a ruler, 1 kHz' font title_font
  set xlabel 'speed, m/s'
  set ylabel 'of 200 falls, %'
  set logscale x
  set xrange [0.1:21]
  set xtics ('0.1' 0.1, '1' 1, '10' 10)
  set yrange [-3:140]
  set ytics 0, 20, 100
  plot file('tunnelling') every ::1 using 1:3 with lines ls 1 title 'not found', \
       '' every ::1 using 1:2 with lines ls 2 title 'found on the wrong side', \
       '' every ::1 using 1:4 with lines ls 3 title 'either, with the side stored'
  unset multiplot

  # The loop
  set output above('loop')
  rows = 2; row = 1; column = 1
  set multiplot
  eval panel
  set title "The bar as masses and springs:\nexplicit steps have to be short" font title_font
  set xlabel 'number of masses'
  set ylabel 'step, µs'
  eval doubling
  eval plain_y
  set yrange [0.1:3000]
  set xrange [3.6:142]
  set key bottom left
  plot 1000 with lines ls 5 lc rgb library title 'a tick', \
       file('mass_spring') every ::1 using 1:2 with linespoints ls 1 title 'largest that is stable', \
       '' every ::1 using 1:3 with linespoints ls 2 title 'that K_c of eq. 2.2 allows'
  eval next_panel
  set title "A hand leans on the bar with 3 N:\nthe direct force oscillates" font title_font
  set xlabel 'time, s'
  set ylabel 'position of the hand, mm'
  set xrange [-0.1:0.7]
  set yrange [-5:28]
  set key top left
  plot file('traces') every ::1 using 1:3 with lines lc rgb worse lw 1.2 title 'mid-span, 2 ticks late', \
       '' every ::1 using 1:2 with lines lc rgb fails lw 1.2 title 'beside a support, in time', \
       '' every ::1 using 1:4 with lines ls 3 title 'beside a support, coupled', \
       '' every ::1 using 1:5 with lines ls 4 title 'mid-span, 2 ticks late, coupled'
  eval next_panel
  set title "Coarse encoders require a softer coupling" font title_font
  set xlabel 'step of the encoders, µm'
  set ylabel 'speed that should be 0, mm/s'
  set logscale x
  set xrange [4:1100]
  set xtics ('10' 10, '100' 100, '1000' 1000)
  set yrange [-3:90]
  set arrow from 40, 0 to 40, 60 nohead lc rgb grey lw 1.5 dt (6, 4)
  set label '2f/K' at 43, 45 textcolor rgb grey
  plot file('quantisation') every ::1 using 1:2 with linespoints ls 1 title '10 kN/m', \
       '' every ::1 using 1:3 with linespoints ls 3 title 'default for this step'
  eval next_panel
  set title "Missed ticks are delay" font title_font
  set xlabel 'of 30 ticks missed, in a row'
  set yrange [-20:600]
  plot file('missed') every ::1 using 1:2 with linespoints ls 1 title 'directly, mid-span', \
       '' every ::1 using 1:3 with linespoints ls 2 title 'default, beside a support', \
       '' every ::1 using 1:4 with linespoints ls 3 title 'the same, gap as delay'
  unset multiplot

  # Steps of time
  eval wide
  set output above('steps')
  rows = 1; row = 1; column = 1
  set multiplot
  course(rule, what) = sprintf("< awk -F, '$1 == %d' %s | cut -d, -f2,%d", rule, file('steps'), what)
  eval panel
  set title "A ruler let go 170 mm aside, steps of 1 ms:\nwhat becomes of its energy" font title_font
  set xlabel 'time, ms'
  set ylabel 'energy, over that of the beginning'
  set yrange [0:3]
  set xrange [0:500]
  set key top right
  plot course(1, 3) using 1:2 with lines ls 1 title 'trapezoidal rule', \
       course(2, 3) using 1:2 with lines ls 2 title 'backward Euler', \
       course(3, 3) using 1:2 with lines ls 3 title 'TR-BDF2'
  eval next_panel
  set title 'Its tip' font title_font
  set xlabel 'time, ms'
  set ylabel 'aside, mm'
  set xrange [0:500]
  set yrange [-200:330]
  set key top right
  plot course(1, 4) using 1:2 with lines ls 1 title 'trapezoidal rule', \
       course(2, 4) using 1:2 with lines ls 2 title 'backward Euler', \
       course(3, 4) using 1:2 with lines ls 3 title 'TR-BDF2'
  unset multiplot
  set output
}
