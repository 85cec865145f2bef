# One chart a scene: the time of a tick against the largest error of the force.
load folder . '/style.gp'
w = 860
h = 960
file = data . '/speed_accuracy.csv'
rows(scene, model) = sprintf("< awk -F, -v scene='%s' -v model='%s' -f %s/series.awk %s %s | sort -t, -k6g", \
  scene, model, folder, file, file)
front(scene) = sprintf("< awk -F, -v scene='%s' -f %s/front.awk %s %s", scene, folder, file, file)
# The row of that number, or the last; 0: the one that is most wrong.
row(scene, model, n) = rows(scene, model) . \
  (n eq '0' ? ' | sort -t, -k8gr | head -n 1' : sprintf(" | awk -v n=%s '{ line = $0 } NR == n { exit } END { print line }'", n))

array models[19] = ['Linear', 'VonKarman<FullIntegration>', 'VonKarman<ReducedIntegration>', 'Corotational<Linear>', \
  'mass-spring', 'Newton + SparseLU', 'Newton + dense LDLT', 'Newton + SimplicialLDLT', 'PodModel<EquispacedNodes>', \
  'PodModel<ChebyshevNodes>', 'GalerkinModel', 'closed form', 'VonKarman<AssumedStrain>', \
  'Corotational<VonKarman<StabilityFunctions>>', 'RoundRod', 'TwistedRod', 'MuJoCo', 'CrisfieldRod', 'VonKarman<StabilityFunctions>']
array colours[19] = [grey, orange, orange, sky, purple, grey, grey, grey, green, green, black, black, orange, blue, vermilion, blue, orange, sky, vermilion]
array shapes[19] = [2, 4, 6, 8, 12, 1, 2, 3, 6, 7, 13, 9, 8, 5, 7, 5, 4, 8, 7]
array names[19] = ['Linear', 'full integration', 'reduced integration', 'textbook corotational', 'masses and springs', \
  'sparse LU', 'dense', 'sparse LDLT', 'equispaced', 'POD', 'Galerkin', 'closed form', 'assumed strain', 'Corotational', 'RoundRod', 'TwistedRod', 'MuJoCo, capsules', 'textbook corotational', 'VonKarman']
name(scene, i) = scene eq 'ruler' && (i == 2 || i == 3 || i == 19) ? '' : scene eq 'ruler' && i == 13 ? 'VonKarman, any membrane' : names[i]
# Where a name stands: at which point of its series, from there aside and up by so many characters, and which side of it.
array places[19] = ['9 0.8 0.5 l', '9 0.8 0.5 l', '9 0.8 0.3 l', '9 0.8 0.4 l', '3 0.8 0.6 l', '9 0.8 0 l', '9 -0.8 -0.6 r', \
  '9 0.8 -0.4 l', '9 0.9 0.4 l', '0 -1 0 r', '0 -1 0.3 r', '1 -0.9 -0.7 r', '9 0.8 -0.4 l', '3 -2.5 -0.2 r', '2 -2.6 -0.2 r', '2 1 0.5 l', '1 1.2 0.5 l', '9 0.2 -0.9 l', '9 0.8 -0.4 l']
array exceptions[7]
exceptions[1] = '02=9 0.6 -0.9 l;04=9 0.8 0.6 l;07=2 0.8 0.4 l;08=3 0.8 0.4 l;06=9 0.8 0.6 l;19=9 -1 -0.8 r;14=9 0.8 -0.4 l;'
exceptions[2] = '07=2 0.4 0.6 l;08=2 -0.8 -0.7 r;12=1 -4.2 -0.7 r;09=9 0.6 0.2 l;02=9 0.8 0.9 l;03=5 2.2 -0.8 l;14=9 0.8 -0.7 l;19=9 -1 -0.6 r;'
exceptions[3] = '01=1 0 0.7 l;02=9 0.9 0 l;03=9 1.4 -1.9 l;04=9 0.8 -0.5 l;05=1 -0.9 -0.1 r;06=1 0.9 0.4 l;07=1 -0.6 1 l;08=1 -0.8 0.6 r;09=9 0.4 0.35 l;10=0 -1 0.3 r;11=3 1 0.4 l;12=1 -3.2 -0.3 r;13=9 0.6 -0.9 l;14=9 0.8 0.6 l;19=9 -0.3 -1.1 r;'
exceptions[4] = '01=1 0 0.7 l;04=5 0.8 0.6 l;05=1 0.8 0.8 l;06=2 0.8 0.4 l;08=9 0.9 0.5 l;13=9 -6 -0.9 l;'
exceptions[5] = '04=5 0.8 0.4 l;05=1 0.8 0.6 l;07=9 0.8 0 l;'
exceptions[6] = '05=2 -0.8 -0.5 r;16=4 1 0.7 l;'
exceptions[7] = '16=2 -2.6 -0.2 r;17=2 0.8 0.6 l;18=2 1.8 0.5 l;'
at(k, i) = strstrt(exceptions[k], sprintf('%02d=', i))
place(k, i) = at(k, i) ? substr(exceptions[k], at(k, i) + 3, at(k, i) + 1 + strstrt(substr(exceptions[k], at(k, i), 999), ';') - 3) : places[i]
anchor(i, side) = word(place(k, i), 4) eq side && there[i] ? row(scene, models[i], word(place(k, i), 1)) : '/dev/null'

scenes = 'bar_5mm bar_50mm strip ruler arch wire hook'
# Whose sizes are written, and where.
array owner[7] = [19, 19, 19, 14, 14, 15, 16]
# The errors of 8 and 16 are those of 4 where they are the contact's.
few(k) = k < 4 ? " | awk -F, '$3 != 8 && $3 != 16'" : ''
array titles[7] = ['Steel bar between hinges, pressed up to 5 mm', 'Steel bar between hinges, pressed up to 50 mm', \
  'Steel strip, pressed up to ten times its thickness', 'Ruler, clamped, bent to 0.8 of its length', \
  'Arch, pressed on its way to snap through', 'Wire that hangs by its weight, pressed across it', \
  'Hook, pressed out of its plane']
array lowest[7] = [3e-9, 6e-6, 1e-5, 8e-9, 3e-10, 1e-9, 1e-8]

set logscale xy
unset mxtics
unset mytics
set xrange [20:4e6]
set xtics ('0.1 µs' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6)
set ytics ('100 %%' 1, '10 %%' 0.1, '1 %%' 0.01, '0.1 %%' 1e-3, '10^{-4}' 1e-4, '10^{-5}' 1e-5, '10^{-6}' 1e-6, \
  '10^{-7}' 1e-7, '10^{-8}' 1e-8)
set tmargin 5.5
set rmargin 2
set xlabel 'time of a servo tick, from position to force'
set ylabel 'largest error of the force' offset 0.5
set arrow 1 from 1e6, graph 0 to 1e6, graph 1 nohead lc rgb grey dt (8, 5)
set arrow 2 from graph 0, first 0.07 to graph 1, first 0.07 nohead lc rgb grey dt (8, 5)
set label 1 '1 kHz' at 8.5e5, graph 0.97 right textcolor rgb grey font ',17'
set label 2 'just noticeable' at graph 0.01, first 0.095 left textcolor rgb grey font ',17'
set label 3 'down and left is better; yellow: Pareto front' at screen 0.5, 0.915 center textcolor rgb grey font ',17'

do for [format in 'svg png'] {
  do for [k = 1:words(scenes)] {
    scene = word(scenes, k)
    # Measured before there was that scene.
    if (int(system(sprintf("grep -c '^%s,' %s", scene, file))) == 0) { continue }
    # A warning is all that gnuplot says of a method that a scene has not.
    array there[19]
    do for [i = 1:19] { there[i] = int(system(sprintf("grep -cF '%s,%s,' %s", scene, models[i], file))) > 0 }
    eval begin('speed_accuracy_' . scene, format)
    set yrange [lowest[k]:3]
    set label 4 titles[k] at screen 0.5, 0.96 center font ',21'
    plot front(scene) using 1:2 with steps lc rgb '#ffe08a' lw 9, \
      for [i = 1:19] (there[i] ? rows(scene, models[i]) : '/dev/null') using 6:8 with lines lc rgb colours[i] lw ((i > 9 && i < 17 && i != 13) || i == 19 ? 3 : 1.8), \
      for [i = 1:19] (there[i] ? rows(scene, models[i]) : '/dev/null') using 6:8:6:7 with xerrorbars lc rgb colours[i] pt shapes[i] ps 0.9 lw 1, \
      rows(scene, models[owner[k]]) . few(k) using 6:8:3 with labels textcolor rgb colours[owner[k]] font ',14' \
        offset k < 4 ? 1.2 : -1.4, k < 4 ? 0.4 : -0.2, \
      for [i = 1:19] anchor(i, 'l') using 6:8:(name(scene, i)) with labels left textcolor rgb colours[i] font ',18' \
        offset real(word(place(k, i), 2)), real(word(place(k, i), 3)), \
      for [i = 1:19] anchor(i, 'r') using 6:8:(name(scene, i)) with labels right textcolor rgb colours[i] font ',18' \
        offset real(word(place(k, i), 2)), real(word(place(k, i), 3)), \
      for [i = 1:19] anchor(i, 'c') using 6:8:(name(scene, i)) with labels center textcolor rgb colours[i] font ',18' \
        offset real(word(place(k, i), 2)), real(word(place(k, i), 3))
    set output
  }
}
