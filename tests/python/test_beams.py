"""Beams and rods: what they are, and what is rejected with the words of C++."""

import math

import numpy as np
import pytest

import hapbeam as hb

STEEL = hb.Material(200e9)
STRIP = hb.Section.rectangle(0.02, 0.001)


def cantilever():
    return hb.Beam(0.4, STRIP, STEEL, hb.Support.clamped, hb.Support.free)


def test_sections_have_the_areas_of_geometry():
    assert STRIP.area == 0.02 * 0.001
    assert STRIP.inertia == pytest.approx(0.02 * 0.001**3 / 12, rel=1e-15)
    tube = hb.Section.tube(0.02, 0.01)
    assert tube.area == pytest.approx(math.pi / 4 * (0.02**2 - 0.01**2), rel=1e-14)
    assert hb.RodSection.circle(0.01).torsion == pytest.approx(math.pi * 0.01**4 / 32, rel=1e-14)


@pytest.mark.parametrize("make, text", [
    (lambda: hb.Beam(-1, STRIP, STEEL, hb.Support.clamped, hb.Support.free),
     "length = -1 m: must be positive and finite"),
    (lambda: hb.Beam(1, STRIP, STEEL, hb.Support.free, hb.Support.pinned),
     "supports = free, pinned: the beam is a mechanism, it turns about its only hinge; hold theta"
     " or the other end"),
    (lambda: hb.Section.tube(0.01, 0.02),
     "section inner_diameter = 0.02 m: must be less than outer_diameter"),
    (lambda: cantilever().add(0.5), "point load s = 0.5 m: must be on the beam, 0 to its length"),
    (lambda: hb.FemModel(hb.Rod(1, hb.RodSection.circle(0.001), hb.RodMaterial(1e9, 1e9),
                                hb.RodSupport.free, hb.RodSupport.hinged), 8,
                            hb.Element.RoundRod),
     "supports = free, hinged: the rod is a mechanism, hold the direction of one end or the place"
     " of both"),
    (lambda: hb.RodMaterial.isotropic(1e9, 0.7),
     "poisson = 0.7: must be more than -1 and at most 0.5"),
    (lambda: hb.FemModel(cantilever(), 1), None),
    (lambda: cantilever().weight(7850, (0, 1, 2)), "gravity of shape (3): must be 2 numbers"),
])
def test_what_makes_no_sense_is_a_value_error_with_the_text_of_cpp(make, text):
    with pytest.raises(ValueError) as error:
        make()
    assert str(error.value)
    if text:
        assert str(error.value) == text


def test_a_weight_bends_a_cantilever_as_beam_theory_says():
    """w = q L⁴/8EI, while the tip turns by a thousandth."""
    beam = hb.Beam(0.1, hb.Section.rectangle(0.02, 0.005), STEEL, hb.Support.clamped,
                   hb.Support.free)
    load = 7850 * 0.02 * 0.005 * 9.81
    expected = -load * 0.1**4 / (8 * beam.bending_stiffness)
    tip = hb.FemModel(beam.weight(7850, (0, -9.81)), 8).shape()[-1]
    assert tip[1] == pytest.approx(expected, rel=1e-6)


def test_a_load_by_a_function_of_python_is_that_of_a_number():
    by_number = hb.FemModel(cantilever().transverse(-0.3), 8).shape()
    by_function = hb.FemModel(cantilever().transverse(lambda s: -0.3), 8).shape()
    assert np.abs(by_number - by_function).max() <= 1e-12
    half = hb.FemModel(cantilever().transverse(lambda s: -0.3 if s < 0.2 else 0), 8).shape()
    assert by_number[-1, 1] < half[-1, 1] < 0


def test_an_error_in_a_function_of_python_comes_back():
    def broken(s):
        raise KeyError("no such load")

    with pytest.raises(KeyError, match="no such load"):
        hb.FemModel(cantilever().transverse(broken), 8)


def test_an_arch_rises_and_is_at_rest_where_it_is_built():
    model = hb.FemModel(hb.arch(0.2, 0.02, STRIP, STEEL, hb.Support.pinned), 16,
                        hb.Element.Corotational)
    assert model.rest().status == hb.Status.ok
    top = model.shape(101)[50]
    assert top == pytest.approx((0.1, 0.02), abs=1e-6)
    assert model.strain_energy() <= 1e-12


def test_a_beam_goes_through_its_points():
    angle = np.linspace(0, 1.5, 7)
    points = 0.1 * np.column_stack([np.sin(angle), np.cos(angle) - 1])
    beam = hb.beam_through(points, STRIP, STEEL, hb.Support.clamped, hb.Support.free)
    assert beam.length == pytest.approx(0.15, rel=1e-12)
    shape = hb.FemModel(beam, 12, hb.Element.Corotational).shape(13)
    assert shape[::2] == pytest.approx(points, abs=1e-7)


def test_a_string_is_stretched_by_its_tension():
    slack = hb.Beam(0.65, hb.Section.circle(0.0005), STEEL, hb.Support.pinned, hb.Support.pinned)
    model = hb.FemModel(hb.tensioned(slack, 70), 8)
    assert model.internal_forces(0.3)["normal"] == pytest.approx(70, rel=1e-9)
    assert model.shape()[-1, 0] == pytest.approx(0.65 * (1 + 70 / slack.axial_stiffness), rel=1e-12)


def test_a_tapered_cantilever_gives_as_its_flexibility_says():
    """1/k = ∫ s²/EI(s) ds from the tip, for a height that falls to a half."""
    def height(s):
        return 0.004 * (1 - 0.5 * s / 0.3)

    beam = hb.Beam(0.3, hb.Section.rectangle(0.02, 0.004), STEEL, hb.Support.clamped,
                   hb.Support.free).section(lambda s: hb.Section.rectangle(0.02, height(s)))
    s = (np.arange(20000) + 0.5) * 0.3 / 20000
    flexibility = np.sum((0.3 - s)**2 / (200e9 * 0.02 * height(s)**3 / 12)) * 0.3 / 20000
    model = hb.FemModel(beam, 8, hb.Element.Corotational)
    assert model.press(0.3, 1e-5).force == pytest.approx(1e-5 / flexibility, rel=1e-5)
    with pytest.raises(ValueError):
        hb.FemModel(beam, 8, hb.Element.VonKarman)


def test_a_stocky_cantilever_shears():
    length, height = 0.1, 0.02
    shear = 5 / 6 * 77e9 * 0.02 * height
    beam = hb.Beam(length, hb.Section.rectangle(0.02, height), STEEL, hb.Support.clamped,
                   hb.Support.free).shear(shear)
    gives = length**3 / (3 * beam.bending_stiffness) + length / shear
    model = hb.FemModel(beam, 2, hb.Element.Corotational)
    assert model.press(length, 1e-6).force == pytest.approx(1e-6 / gives, rel=1e-6)


def test_a_rod_goes_through_points_in_space():
    turn = np.linspace(0, 4 * np.pi, 49)
    points = np.column_stack([0.01 * np.cos(turn), 0.01 * np.sin(turn), 0.001 * turn])
    spring = hb.rod_through(points, hb.RodSection.circle(0.001), hb.RodMaterial(200e9, 77e9),
                            hb.RodSupport.clamped, hb.RodSupport.free)
    model = hb.FemModel(spring, 48)
    assert model.shape()[[0, -1]] == pytest.approx(points[[0, -1]], abs=1e-7)
