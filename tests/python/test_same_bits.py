"""Forces equal those of a program in C++ to the last bit."""

import subprocess

import numpy as np

import hapbeam as hb
from conftest import ruler


def test_forces_are_those_of_cpp(programs):
    output = subprocess.run([programs / "python_reference"], capture_output=True, check=True,
                            text=True).stdout
    expected = [(line.split()[0], [float(number) for number in line.split()[1:]])
                for line in output.splitlines()]
    got = []
    steps = np.arange(400)
    for name, element in (("linear", hb.Element.Linear), ("von_karman", hb.Element.VonKarman),
                          ("corotational", hb.Element.Corotational)):
        model = hb.FemModel(ruler(), 8, element)
        curve = hb.Touch(model, 0.005).ticks(
            np.column_stack([0.2 + 1e-4 * steps, 0.006 - 5e-5 * steps]))
        got += [(name, curve.force[-1].tolist()), ("shape", model.shape([0.15])[0].tolist())]
    wire = hb.Rod(0.2, hb.RodSection.circle(0.001), hb.RodMaterial(200e9, 77e9),
                  hb.RodSupport.clamped, hb.RodSupport.free)
    tips = np.column_stack([np.full(400, 0.15), 0.004 - 2e-5 * steps, np.full(400, 0.02)])
    curve = hb.Touch(hb.FemModel(wire, 8), 0.003).ticks(tips, np.tile((0, 0, -0.05), (400, 1)))
    got.append(("rod", curve.force[-1].tolist()))
    device = hb.VirtualPhantom(hb.HandPath((0, 0.006)).press(0.02, 0.3))
    servo = hb.Servo(hb.FemModel(ruler(), 8, hb.Element.Corotational), device.info,
                     hb.Placement.in_plane((0.25, 0)))
    got.append(("loop", device.run(servo, 0.4)["force"][-1].tolist()))
    assert len(got) == 8 and all(np.abs(force).max() > 0 for name, force in got)
    assert got == expected
