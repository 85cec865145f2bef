import matplotlib.pyplot as plt
import numpy as np

import hapbeam as hb

strip = hb.Section.rectangle(0.01, 0.0005)
bow = hb.arch(0.2, 0.02, strip, hb.Material(200e9), hb.Support.pinned)  # span and rise [m]
model = hb.FemModel(bow, 16, hb.Element.Corotational)
touch = hb.Touch(model, 0.005)                                          # radius 5 mm

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")
down = np.linspace(0, 30e-3, 301)                                       # the hand's way [m]
hands = np.column_stack([np.full(301, 0.097), 0.026 - down])            # x along the beam, w up
left.plot(1e3 * down, touch.ticks(hands).force[:, 1], color="grey")     # 301 ticks in one call

touch.reset()
for part in np.split(np.arange(300), 5):
    felt = touch.ticks(hands[part])
    x, w = 1e3 * model.shape(101).T                                     # 101 points of the beam
    line, = right.plot(x, w)
    left.plot(1e3 * down[part[-1]], felt.force[-1, 1], "o", color=line.get_color())
left.set(xlabel="hand, down [mm]", ylabel="force on the hand [N]")
right.set(xlabel="x [mm]", ylabel="w [mm]")
figure.savefig("python.png", dpi=100)
