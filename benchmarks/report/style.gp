# What the charts share.  Colours: Okabe and Ito's, told apart by the colour-blind; what the library offers has the dark
# ones, what it is measured against the light ones.
set encoding utf8
set datafile separator ','
set datafile missing ''

black = '#000000'
grey = '#666666'
light = '#dddddd'
blue = '#0072b2'
sky = '#56b4e9'
green = '#009e73'
orange = '#e69f00'
vermilion = '#d55e00'
purple = '#cc79a7'

# begin(name, format): a picture of w by h, legible where it is shown half as large.
begin(name, format) = format eq 'svg' ? \
  sprintf("set terminal svg size %d,%d enhanced font 'DejaVu Sans,20' background '#ffffff'; set output '%s/%s.svg'", w, h, charts, name) : \
  sprintf("set terminal pngcairo size %d,%d enhanced font 'DejaVu Sans,15' fontscale 1.4 linewidth 1.4 pointscale 1.4 background '#ffffff'; set output '%s/%s.png'", 1.4 * w, 1.4 * h, charts, name)

set border 3 lc rgb grey
set tics nomirror textcolor rgb '#222222'
set grid lc rgb light lw 1 dt solid
unset key
