"""Models against closed forms and the references of tests/data."""

import gc

import numpy as np
import pytest

import hapbeam as hb
from conftest import bar, pressed_rod, rows, ruler


def test_presses_of_a_bar_are_those_of_the_closed_form():
    """The table has twelve digits, and a press the solver's tolerance."""
    model = hb.FemModel(bar(), 8)
    table = rows("von_karman_press_pinned.csv")
    assert len(table) == 35
    for row in table:
        for side in (1, -1):
            model.reset()
            answer = model.press(row["position_over_length"] * model.length,
                                 side * 1e-3 * row["depth_mm"])
            assert answer.status == hb.Status.ok
            assert answer.force == pytest.approx(side * row["force_N"], rel=1e-9)


def test_cubic_elements_come_to_the_closed_form_with_the_fourth_power():
    row = [r for r in rows("von_karman_press_pinned.csv")
           if r["position_over_length"] == 0.5 and r["depth_mm"] == 50][0]
    error = [abs(hb.FemModel(bar(), n, hb.Element.AssumedStrain).press(1.27, 0.05).force
                 / row["force_N"] - 1) for n in (32, 64)]
    assert error[0] <= 1e-4
    assert np.log2(error[0] / error[1]) >= 3.8


def test_a_linear_beam_is_that_of_the_textbook():
    """k = 192 EI/L³ at the middle between clamps, at any depth."""
    beam = bar(hb.Support.clamped, hb.Support.clamped)
    model = hb.FemModel(beam, 8, hb.Element.Linear)
    stiffness = 192 * beam.bending_stiffness / beam.length**3
    forces, statuses = model.presses(beam.length / 2, np.array([1e-3, 0.1]))
    assert forces == pytest.approx(stiffness * np.array([1e-3, 0.1]), rel=1e-9)
    assert (statuses == hb.Status.ok).all()


def test_the_tip_of_a_cantilever_is_that_of_the_elastica():
    for row in rows("elastica_cantilever_tip_load.csv"):
        beam = hb.Beam(1, 1e8, 1, 0.01, hb.Support.clamped, hb.Support.free)
        beam.add(1, transverse=row["alpha"])
        model = hb.FemModel(beam, 8, hb.Element.Corotational)
        tip, bound = model.nodes()[-1], 2e-5 if row["alpha"] <= 5 else 5e-5
        assert tip["w"] == pytest.approx(row["transverse_over_length"], rel=bound)
        assert -tip["u"] == pytest.approx(row["shortening_over_length"], rel=bound)
        assert -tip["theta"] == pytest.approx(row["tip_slope_rad"], rel=bound)


@pytest.mark.parametrize("name, element, elements, bound", [
    ("wire_under_load", hb.Element.RoundRod, 16, 1e-5),
    ("wire_under_load", hb.Element.TwistedRod, 16, 1e-5),
    ("bar_two_ways", hb.Element.RoundRod, 32, 2.5e-4),
    ("strip_askew", hb.Element.TwistedRod, 16, 1e-4),
    ("hook", hb.Element.TwistedRod, 16, 1e-5),
])
def test_rods_give_the_forces_of_kirchhoffs(name, element, elements, bound):
    rod, s, normal, turns = pressed_rod(name)
    model = hb.FemModel(rod, elements * turns, element)
    home = np.dot(model.shape([s])[0], normal)
    found = 0
    for row in rows("rods_in_space.csv"):
        if row["case"] != name:
            continue
        found += 1
        answer = model.push(s, home + row["depth"], normal)
        assert answer.status == hb.Status.ok
        assert answer.force == pytest.approx(row["force"], rel=bound)
    assert found >= 5


def test_the_work_of_a_press_is_the_strain_energy():
    """∫ F dd by Simpson's rule, whose error falls with the fourth power of the step."""
    error = []
    for steps in (200, 400):
        model = hb.FemModel(ruler(), 8, hb.Element.Corotational)
        depth = np.linspace(0, 0.06, steps + 1)
        force, statuses = model.presses(0.2, depth)
        assert (statuses == hb.Status.ok).all()
        weight = np.array([1, *[4, 2] * (steps // 2 - 1), 4, 1]) * depth[1] / 3
        error.append(abs(np.dot(weight, force) / model.strain_energy() - 1))
    assert error[1] <= 1e-8
    assert np.log2(error[0] / error[1]) >= 3.8


def test_internal_forces_are_in_equilibrium():
    """A cantilever that is pressed has F beyond its clamp, and M = F (s_press - s)."""
    beam = hb.Beam(0.5, hb.Section.rectangle(0.02, 0.005), hb.Material(200e9), hb.Support.clamped,
                   hb.Support.free)
    model = hb.FemModel(beam, 10, hb.Element.Linear)
    force = model.press(0.4, 1e-4).force
    s = np.array([0.0, 0.1, 0.33, 0.45])
    cut = model.internal_forces(s)
    lever = np.maximum(0.4 - s, 0)
    assert cut.shape == (4,)
    assert np.abs(cut["moment"]) == pytest.approx(force * lever, abs=1e-9)
    assert np.abs(cut["shear"][:3]) == pytest.approx(force, rel=1e-9)
    peak = model.peak_strain()
    assert peak.s == 0
    assert peak.strain == pytest.approx(force * 0.4 * 0.0025 / beam.bending_stiffness, rel=1e-9)
    with pytest.raises(ValueError, match="s = 0.6 m: must be on the beam"):
        model.internal_forces(0.6)


def test_a_rod_that_is_twisted_has_the_torque_of_its_twist():
    """M = GJ φ/L for an end turned by φ about the rod."""
    section, steel = hb.RodSection.circle(0.002), hb.RodMaterial(200e9, 77e9)
    rod = hb.Rod(0.2, section, steel, hb.RodSupport.clamped, hb.RodSupport.clamped)
    model = hb.FemModel(rod, 8)
    angle = 0.3
    held = model.hold(hb.RodSide.right, hb.RodPose((0.2, 0, 0), (1, 0, 0),
                                                   (0, np.cos(angle), np.sin(angle))))
    torque = 77e9 * section.torsion * angle / 0.2
    assert held.status == hb.Status.ok
    assert held.moment == pytest.approx((torque, 0, 0), abs=1e-9 * torque)
    assert model.internal_forces(0.1)["torsion"] == pytest.approx(torque, rel=1e-9)


def test_moments_at_the_tip_of_a_rod_twist_it_and_bend_it_to_an_arc():
    """Torque T everywhere; an arc of curvature M/EI."""
    section, steel, length = hb.RodSection.circle(0.002), hb.RodMaterial(200e9, 77e9), 0.2
    bending, torque = 200e9 * section.inertia1, 0.05
    angle = 0.3

    def rod():
        return hb.Rod(length, section, steel, hb.RodSupport.clamped, hb.RodSupport.free)

    twisted = hb.FemModel(rod().add(length, moment=(torque, 0, 0)), 8)
    assert twisted.internal_forces(0.1)["torsion"] == pytest.approx(torque, rel=1e-9)
    bent = hb.FemModel(rod().add(length, moment=(0, 0, bending * angle / length)), 16)
    radius = length / angle
    tip = (radius * np.sin(angle), radius * (1 - np.cos(angle)), 0)
    assert bent.shape()[-1] == pytest.approx(tip, abs=1e-7 * length)


def test_nodes_are_the_memory_of_the_model_and_a_shape_is_a_copy():
    for model, press in (
            (hb.FemModel(ruler(), 8), lambda m: m.press(0.3, 0.01)),
            (hb.FemModel(pressed_rod("hook")[0], 8), lambda m: m.push(0.1, 0.01, (0, 0, 1)))):
        nodes, shape = model.nodes(), model.shape()
        assert not nodes.flags.owndata and not nodes.flags.writeable
        assert shape.shape == (len(nodes), model.dimension)
        before, was = nodes.copy(), shape.copy()
        press(model)
        assert (nodes != before).any()
        assert (shape == was).all()
        assert np.abs(model.shape() - was).max() >= 1e-3


def test_nodes_outlive_the_name_of_their_model():
    nodes = hb.FemModel(ruler(), 8).nodes()
    gc.collect()
    assert nodes["s"][0] == 0 and nodes["s"][-1] == 0.3
    assert nodes["w"].tolist() == [0] * len(nodes)


def test_a_shape_is_asked_for_by_number_or_by_place():
    model = hb.FemModel(ruler(), 8, hb.Element.Corotational)
    model.press(0.25, -0.05)
    many = model.shape(4)
    assert (many == model.shape(np.linspace(0, 0.3, 4))).all()
    assert (many == model.shape(np.int64(4))).all()
    assert model.shape([0.25])[0, 1] == pytest.approx(-0.05, rel=1e-9)
    for points in (1, [0.5], [float("nan")], [[0.1]]):
        with pytest.raises(ValueError):
            model.shape(points)


def test_a_model_says_what_it_does_not_offer():
    flat, rod = hb.FemModel(ruler(), 8), hb.FemModel(pressed_rod("hook")[0], 8)
    for call in (lambda: rod.press(0.1, 0.01), lambda: flat.push(0.1, 0.01, (0, 1)),
                 lambda: flat.hold(hb.RodSide.left, hb.RodPose()),
                 lambda: hb.FemModel(ruler(), 8, hb.Element.RoundRod),
                 lambda: hb.FemModel(ruler(), 8, hb.Element.VonKarman, 2),
                 lambda: hb.TouchSeveral(flat, [0.005]),
                 lambda: hb.Touch(hb.FemModel(ruler(), 8, hb.Element.Corotational, 2), 0.005),
                 lambda: hb.Grip(flat, hb.RodSide.left)):
        with pytest.raises(TypeError):
            call()


def test_a_request_that_makes_no_sense_has_a_status_and_no_exception():
    model = hb.FemModel(ruler(), 8)
    assert model.press(0.2, float("nan")).status == hb.Status.invalid_request
    assert model.press(-1, 0.01).status == hb.Status.invalid_request
    answer = model.press(0.2, 10)
    assert answer.status == hb.Status.out_of_range and np.isfinite(answer.force)
    assert hb.is_answer(answer.status) and not hb.is_answer(hb.Status.invalid_request)


def test_a_model_bounds_what_its_mesh_leaves_in_the_force():
    strip = hb.Beam(0.3, hb.Section.rectangle(0.02, 0.0005), hb.Material(140e9),
                    hb.Support.clamped, hb.Support.free)
    coarse, fine = (hb.FemModel(strip, n, hb.Element.Corotational) for n in (4, 256))
    forces = [model.press(0.2, 0.05).force for model in (coarse, fine)]
    error = abs(forces[0] - forces[1])
    assert error <= coarse.force_error() <= 30 * error
    exact = hb.FemModel(bar(), 8)
    exact.press(1.27, 0.05)
    assert exact.force_error() == 0


def test_elements_for_an_error():
    strip = hb.Beam(0.3, hb.Section.rectangle(0.02, 0.0005), hb.Material(140e9),
                    hb.Support.clamped, hb.Support.free)
    assert hb.elements_for(bar(), 0.05, 1e-6) == 4
    assert (hb.elements_for(strip, 0.06, 0.05, hb.Element.Corotational)
            < hb.elements_for(strip, 0.06, 1e-3, hb.Element.Corotational))
    with pytest.raises(ValueError, match="error = 0"):
        hb.elements_for(bar(), 0.05, 0)
