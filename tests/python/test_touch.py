"""Avatars on beams and rods: references, laws, and curves without Python's lock."""

import threading

import numpy as np
import pytest

import hapbeam as hb
from conftest import pressed_rod, rows, ruler


def led(touch, start, end, ticks):
    """A hand led along a straight way, and what it feels at its end."""
    way = np.linspace(start, end, ticks + 1)[1:]
    return touch.ticks(way)


def test_a_finger_slides_along_a_ruler_as_the_elastica_with_friction_says():
    table = rows("finger.csv") + rows("finger_with_friction.csv")
    cases = sorted({(row["mu"], row["x_c"]) for row in table})
    assert len(cases) >= 6
    for mu, x in cases:
        touch = hb.Touch(hb.FemModel(ruler(), 16, hb.Element.Corotational), 0.005, mu)
        y = 0.0056
        for row in (r for r in table if (r["mu"], r["x_c"]) == (mu, x)):
            curve = led(touch, (x, y), (x, row["y_c"]), 40)
            y = row["y_c"]
            assert (curve.status == hb.Status.ok).all()
            force = np.array([row["force_x"], row["force_y"]])
            assert np.linalg.norm(curve.force[-1] - force) <= 1e-5 * np.linalg.norm(force)


def test_a_curve_is_its_ticks_to_the_last_bit():
    hands = np.column_stack([np.linspace(0.1, 0.28, 300),
                             0.006 - 0.03 * np.sin(np.arange(300) / 40)])
    for element in (hb.Element.VonKarman, hb.Element.Corotational):
        curve = hb.Touch(hb.FemModel(ruler(), 8, element), 0.005).ticks(hands)
        touch = hb.Touch(hb.FemModel(ruler(), 8, element), 0.005)
        felt = [touch.tick(hand) for hand in hands]
        assert (curve.force == [f.force for f in felt]).all()
        assert (curve.status == [f.status for f in felt]).all()
        assert (curve.pressing == [f.pressing for f in felt]).all()
        assert curve.pressing.any() and not curve.pressing.all()
        assert curve.force.shape == (300, 2) and curve.status.dtype == np.int8


def test_friction_stays_within_its_cone():
    touch = hb.Touch(hb.FemModel(ruler(), 8, hb.Element.Corotational), 0.005, hb.Friction(0.6, 0.4))
    touch.soften(500)
    hands = np.column_stack([0.2 + 0.02 * np.sin(np.arange(400) / 50), np.full(400, -0.01)])
    led(touch, (0.2, 0.006), hands[0], 100)
    curve = touch.ticks(hands)
    normal = np.linalg.norm(curve.force - curve.friction, axis=1)
    share = np.linalg.norm(curve.friction, axis=1) / normal
    assert share.max() <= 0.6 + 1e-6
    assert share.max() >= 0.3
    assert touch.tick(hands[-1]).dissipated > 0


def test_a_ball_feels_the_same_from_every_side_of_a_round_wire():
    wire = hb.Rod(0.2, hb.RodSection.circle(0.002), hb.RodMaterial(200e9, 77e9),
                  hb.RodSupport.clamped, hb.RodSupport.free)
    sizes = []
    for angle in (0, 1, 2.5, 4):
        side = np.array([0, np.cos(angle), np.sin(angle)])
        touch = hb.Touch(hb.FemModel(wire, 8, hb.Element.RoundRod), 0.005)
        way = np.array([0.15, 0, 0]) + np.linspace(0.007, 0.002, 50)[:, None] * side
        curve = touch.ticks(way)
        assert (curve.status == hb.Status.ok).all()
        sizes.append(np.dot(curve.force[-1], side))
        assert sizes[-1] > 0.1
    assert sizes == pytest.approx([sizes[0]] * 4, rel=1e-6)


def test_a_shaft_is_felt_where_its_sphere_is_not():
    rod = pressed_rod("strip_askew")[0]
    touch = hb.Touch(hb.FemModel(rod, 8), 0.003)
    tip, shaft = (0.15, 0.003, 0.05), (0, 0, -0.1)
    assert not touch.tick(tip).pressing
    touch.reset()
    felt = touch.ticks([(0.15, y, 0.05) for y in np.linspace(0.006, 0.001, 20)], [shaft] * 20)
    assert felt.pressing[-1] and felt.force[-1, 1] > 0
    with pytest.raises(ValueError):
        touch.ticks([tip], [shaft, shaft])
    with pytest.raises(TypeError):
        hb.Touch(hb.FemModel(ruler(), 8), 0.005).tick((0.1, 0), (0, 0, 1))


def test_two_contacts_take_the_forces_of_the_reference():
    place = {"bar_same_side": (0.3, 0.6), "bar_opposite": (0.35, 0.5), "bar_close": (0.48, 0.52),
             "ruler_s_bend": (0.15, 0.28)}
    straight = hb.Beam(1, hb.Section.rectangle(0.02, 0.01), hb.Material(200e9), hb.Support.pinned,
                       hb.Support.pinned)
    for row in rows("contacts.csv"):
        beam = ruler() if row["case"] == "ruler_s_bend" else straight
        depths = (row["depth1"], row["depth2"])
        held = [hb.Prop.support(s, d, (0, 1)) for s, d in zip(place[row["case"]], depths)]
        touch = hb.TouchSeveral(hb.FemModel(beam, 32, hb.Element.Corotational, 2), [], held)
        felt = touch.tick(np.zeros((0, 2)))
        assert felt.status == hb.Status.ok
        for body in (0, 1):
            assert felt.force(body)[1] == pytest.approx(-row[f"force{body + 1}"], rel=5e-6)


def test_several_avatars_and_a_peg_are_in_equilibrium():
    """The clamp carries what all others do not: its shear force is their sum."""
    model = hb.FemModel(ruler(), 16, hb.Element.Corotational, 3)
    touch = hb.TouchSeveral(model, [0.005, hb.RoundAvatar(0.005)],
                            [hb.Prop.peg((0.15, -0.006), 0.005)])
    for k in range(200):
        felt = touch.tick([(0.08, 0.006 - 1e-5 * k), (0.25, 0.006 - 5e-5 * k)])
        assert felt.status == hb.Status.ok
    total = sum(felt.force(body) for body in range(3))
    cut = model.internal_forces(0.0)
    assert [p.touching for p in felt.places] == [True, True, True]
    assert np.hypot(cut["normal"], cut["shear"]) == pytest.approx(np.linalg.norm(total), rel=1e-6)
    with pytest.raises(ValueError, match="places: must be at most 4"):
        hb.TouchSeveral(model, [0.005] * 5)
    assert touch.tick([(0.1, 0.1)]).status == hb.Status.invalid_request


def test_an_array_feels_the_sum_of_its_beams():
    bristle = hb.Beam(0.05, hb.Section.circle(0.0006), hb.Material(3e9), hb.Support.clamped,
                      hb.Support.free)
    places = [(0.004 * i, 0, -np.pi / 2) for i in range(20)]
    array = hb.BeamArray([hb.FemModel(bristle, 8, hb.Element.Corotational)], places)
    assert len(array) == 20
    brush = hb.ArrayTouch(array, 0.006)
    alone = [hb.Touch(hb.FemModel(bristle, 8, hb.Element.Corotational), 0.006) for _ in places]
    most = 0
    for x in np.linspace(-0.02, 0.09, 400):
        hand = np.array([x, -0.045])
        felt = brush.tick(hand)
        total = np.zeros(2)
        for (x0, y0, angle), touch in zip(places, alone):
            c, s = np.cos(angle), np.sin(angle)
            d = hand - (x0, y0)
            f = touch.tick((c * d[0] + s * d[1], c * d[1] - s * d[0])).force
            total += (c * f[0] - s * f[1], s * f[0] + c * f[1])
        assert felt.force == pytest.approx(total, abs=1e-9)
        touches = brush.touches()
        assert felt.force == pytest.approx(sum((f for _, f in touches), np.zeros(2)), abs=1e-12)
        most = max(most, len(touches))
    assert most >= 2
    assert brush.shape(3, 9)[0] == pytest.approx((0.012, 0), abs=1e-12)
    with pytest.raises(ValueError):
        brush.shape(20)
    with pytest.raises(ValueError):
        hb.BeamArray([], places)


def test_a_long_curve_lets_other_threads_run():
    """While it runs another thread counts; with Python's lock held it would not."""
    touch = hb.Touch(hb.FemModel(ruler(), 256, hb.Element.Corotational), 0.005)
    hands = np.column_stack([np.full(4000, 0.2), 0.006 - 0.02 * np.sin(np.arange(4000) / 300)**2])
    done, counted = threading.Event(), []

    def work():
        touch.ticks(hands)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted.append(1)
    thread.join()
    assert len(counted) > 1000


def test_threads_that_share_a_model_take_turns():
    model = hb.FemModel(ruler(), 32, hb.Element.Corotational)
    touch = hb.Touch(model, 0.005)
    hands = np.column_stack([np.full(500, 0.2), np.linspace(0.006, -0.01, 500)])
    threads = [threading.Thread(target=touch.ticks, args=(hands,)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for _ in range(100):
        assert np.isfinite(model.shape()).all()
    for thread in threads:
        thread.join()
    assert touch.tick(hands[-1]).status == hb.Status.ok


def test_positions_of_another_shape_are_rejected():
    touch = hb.Touch(hb.FemModel(ruler(), 8), 0.005)
    for positions in ([0.1, 0.2], [(0.1, 0.2, 0.3)], np.zeros((2, 2, 2))):
        with pytest.raises(ValueError, match=r"positions of shape"):
            touch.ticks(positions)
    with pytest.raises(ValueError, match=r"position of shape \(3\): must be 2 numbers"):
        touch.tick((0, 0, 0))
    with pytest.raises(ValueError, match="avatar_radius = -1 m: must be 0 to 300 m"):
        hb.Touch(hb.FemModel(ruler(), 8), -1)
