# One chart a scene: the time of a tick against the largest error of the force.
load folder . '/style.gp'
w = 860
h = 960
file = data . '/speed_accuracy.csv'
rows(scene, model) = sprintf("< awk -F, -v scene='%s' -v model='%s' -f %s/series.awk %s %s | sort -t, -k6g", \
  scene, model, folder, file, file)
front(scene) = sprintf("< awk -F, -v scene='%s' -f %s/front.awk %s", scene, folder, file)

# What a series is called, its colour and point, and its label: at its fastest or slowest point, aside by so many characters.
array models[14] = ['Linear', 'VonKarman<FullIntegration>', 'VonKarman<ReducedIntegration>', 'Corotational<Linear>', \
  'mass-spring', 'Newton + SparseLU', 'Newton + dense LDLT', 'Newton + SimplicialLDLT', 'PodModel<EquispacedNodes>', \
  'PodModel<ChebyshevNodes>', 'GalerkinModel', 'closed form', 'VonKarman<AssumedStrain>', \
  'Corotational<VonKarman<AssumedStrain>>']
array names[14] = ['Linear', 'full integration', 'reduced integration', "textbook\ncorotational", \
  "masses and\nsprings", "Newton,\nSparseLU", "Newton,\ndense", "Newton,\nSimplicialLDLT", 'equispaced', \
  'PodModel', 'GalerkinModel', 'closed form', 'VonKarman', 'Corotational']
array colours[14] = [grey, orange, orange, sky, purple, grey, grey, grey, green, green, black, black, vermilion, blue]
array shapes[14] = [2, 4, 6, 8, 12, 1, 2, 3, 6, 7, 13, 9, 7, 5]
array places[14] = ['tail 1 0.7', 'tail 0.7 0.7', 'tail 0.7 0.7', 'tail 0.7 0.7', 'tail 0.7 0.7', 'tail -1 -1', \
  'tail -1 -1', 'tail -1 -1', 'tail 0.9 0', 'head -1 0', 'head -3 0.8', 'head -1 -0.9', 'tail 1 -0.2', 'tail 1 -0.2']
place(scene, i) = places[i]

array titles[5] = ['Steel bar of 2.54 m between hinges, pressed up to 5 mm', \
  'Steel bar of 2.54 m between hinges, pressed up to 50 mm', \
  'Steel strip between hinges, pressed up to ten times its thickness', \
  'Ruler, clamped at one end, bent to 0.8 of its length', \
  'Arch, pressed on its way to snap through']
scenes = 'bar_5mm bar_50mm strip ruler arch'

set logscale xy
unset mxtics
unset mytics
set xrange [200:3e6]
set yrange [4e-9:3]
set xtics ('1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6)
set ytics ('100 %%' 1, '10 %%' 0.1, '1 %%' 0.01, '0.1 %%' 1e-3, '10^{-4}' 1e-4, '10^{-5}' 1e-5, '10^{-6}' 1e-6, \
  '10^{-7}' 1e-7, '10^{-8}' 1e-8)
set tmargin 5.5
set rmargin 2
set xlabel 'time of a servo tick, from position to force'
set ylabel 'largest error of the force' offset 0.5
set arrow 1 from 1e6, graph 0 to 1e6, graph 1 nohead lc rgb grey dt (8, 5)
set arrow 2 from graph 0, first 0.07 to graph 1, first 0.07 nohead lc rgb grey dt (8, 5)
set label 1 'budget' at 1.1e6, graph 0.02 left textcolor rgb grey font ',16'
set label 2 'just felt: 7 %%' at graph 0.01, first 0.1 left textcolor rgb grey font ',16'
set label 3 'down and left is better; yellow: nothing is better at both' at screen 0.5, 0.915 center textcolor rgb grey font ',17'

do for [format in 'svg png'] {
  do for [k = 1:words(scenes)] {
    scene = word(scenes, k)
    # A warning is all that gnuplot says of a method that a scene has not.
    array there[14]
    do for [i = 1:14] { there[i] = int(system(sprintf("grep -cF '%s,%s,' %s", scene, models[i], file))) > 0 }
    eval begin('speed_accuracy_' . scene, format)
    set label 4 titles[k] at screen 0.5, 0.96 center font ',20'
    plot front(scene) using 1:2 with steps lc rgb '#ffe08a' lw 9, \
      for [i = 1:14] (there[i] ? rows(scene, models[i]) : '/dev/null') using 6:8 with lines lc rgb colours[i] lw (i > 9 ? 2.5 : 1.8), \
      for [i = 1:14] (there[i] ? rows(scene, models[i]) : '/dev/null') using 6:8:6:7 with xerrorbars lc rgb colours[i] pt shapes[i] ps 0.9 lw 1, \
      for [i = 1:14] (there[i] ? rows(scene, models[i]) . ' | ' . word(place(scene, i), 1) . ' -n 1' : '/dev/null') \
        using 6:8:(names[i]) with labels left textcolor rgb colours[i] font ',17' \
        offset real(word(place(scene, i), 2)), real(word(place(scene, i), 3))
    set output
  }
}
