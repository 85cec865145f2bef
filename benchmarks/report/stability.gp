# Draws where the loop is stable.
set encoding utf8
set datafile separator ','

colour(n) = n == 0 ? 0x0072b2 : n == 1 ? 0x1b9e5a : n == 2 ? 0xc4500c : 0x7a4fa3
grey = '#555555'

do for [format in 'svg png'] {
  if (format eq 'svg') { set terminal svg size 1100,640 enhanced font 'sans-serif,15' background '#ffffff' } \
  else { set terminal pngcairo size 1100,640 enhanced font 'sans-serif,11' background '#ffffff' }
  title = format eq 'svg' ? 15 : 12
  small = sprintf(',%d', format eq 'svg' ? 13 : 10)
  set output charts . '/stability.' . format
  set multiplot
  unset label
  unset object
  set border 3 lc rgb grey
  set tics nomirror
  set grid lc rgb '#e2e2e2' lw 1 dt solid
  unset key
  set logscale xy
  unset mxtics
  unset mytics
  set tmargin at screen 0.82
  set bmargin at screen 0.2

  set label 1 'The default coupling stays below every bound; what is stable reaches beyond them' at screen 0.5, 0.96 center font sprintf(',%d', title + 3)
  do for [n = 0:3] {
    set label 10 + n sprintf(n == 1 ? '%d tick late' : '%d ticks late', n) at screen 0.07 + 0.105 * n, 0.045 point pt 7 ps 1 lc rgb colour(n) offset 1, -0.3
  }
  set label 20 'the default' at screen 0.49, 0.045 point pt 6 ps 1.1 lc rgb grey offset 1, -0.3
  set label 21 'filled: the largest that is stable with four hands' at screen 0.63, 0.045
  # Left: the coupling's stiffness.
  set lmargin at screen 0.095
  set rmargin at screen 0.58
  set title "Bar pressed at a tenth of its span (163 N/mm), through the coupling:\nstable stiffness, for arms of 1 to 20 N·s/m and periods of 0.5 to 2 ms" font sprintf(',%d', title) offset 0, -0.2
  set xlabel 'damping of the arm b / (period · (½ + delay)), N/m' offset 0, 0.3
  set ylabel 'stiffness of the coupling, N/m' offset 1
  set xrange [100:1e5]
  set yrange [40:2e6]
  set xtics ('100' 100, '1 000' 1e3, '10 000' 1e4, '100 000' 1e5)
  set ytics ('100' 100, '1 000' 1e3, '10 000' 1e4, '100 000' 1e5, '1 000 000' 1e6)
  set label 2 'Colgate and Schenkel' at 14000, 9000 rotate by 23 textcolor rgb '#000000' font small
  set label 3 'K = 2f/Δ, Abbott and Okamura, Δ = 7 µm' at 115, 78000 textcolor rgb grey font small
  set label 4 'the same, Δ = 30 µm' at 115, 18000 textcolor rgb grey font small
  set label 5 '3 500 N/m, the maker''s' at 115, 4800 textcolor rgb grey font small
  plot x lw 2 lc rgb '#000000', 2 * 0.2 / 7e-6 lw 1.5 dt (6, 4) lc rgb grey, \
       2 * 0.2 / 30e-6 lw 1.5 dt (6, 4) lc rgb grey, 3500 lw 1.5 dt (2, 3) lc rgb grey, \
       data . '/stability_border.csv' every ::1 using 4:5:(colour($3)) with points pt 7 ps 0.8 lc rgb variable, \
       '' every ::1 using 4:6:(colour($3)) with points pt 6 ps 0.9 lc rgb variable
  unset label
  # Right: no coupling.
  set lmargin at screen 0.7
  set rmargin at screen 0.98
  set title "At mid-span (21 N/mm), without:\nstable above the line" font sprintf(',%d', title) offset 0, -0.2
  set xlabel 'delay, ticks'
  set ylabel 'damping that the arm must have, N·s/m' offset 0.5
  unset logscale x
  set xrange [-0.2:3.5]
  set yrange [0.1:300]
  set xtics ('0' 0, '1' 1, '2' 2, '3' 3)
  set ytics ('≤ 0.1' 0.1, '1' 1, '10' 10, '100' 100)
  set label 6 "the Phantom's 5 N·s/m" at 1.6, 3.6 textcolor rgb grey font small
  shade(T) = T == 0.5 ? 0x56b4e9 : T == 1 ? 0x0072b2 : 0x00304d
  set label 30 '2 ms' at 3.08, 106 textcolor rgb shade(2)
  set label 31 '1 ms' at 3.08, 57 textcolor rgb shade(1)
  set label 32 '0.5 ms' at 3.08, 26 textcolor rgb shade(0.5)
  plot 5 lw 1.5 dt (2, 3) lc rgb grey, \
       for [T in '0.5 1 2'] data . '/stability_direct.csv' every ::1 using ($2 == 3 && $3 == real(T) ? $4 : NaN):5 \
         with linespoints lw 2 pt 7 ps 0.8 lc rgb shade(real(T))
  unset label
  unset multiplot
  set output
}
