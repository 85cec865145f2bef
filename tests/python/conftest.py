"""What the tests share: references of tests/data, and the beams that they are of."""

import csv
import math
import os
from pathlib import Path

import pytest

import hapbeam as hb

DATA = Path(__file__).resolve().parent.parent / "data"
INCH = 0.0254
THESIS_YOUNG = 30e6 * 4.4482216152605 / INCH**2


def rows(name):
    """The rows of a table of tests/data, numbers where they are some."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text

    with open(DATA / name, encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(lines)]


def bar(left=hb.Support.pinned, right=hb.Support.pinned):
    """100 in of square steel bar, 1 in thick."""
    return hb.Beam(100 * INCH, hb.Section.rectangle(INCH, INCH), hb.Material(THESIS_YOUNG),
                   left, right)


def ruler():
    """The ruler of finger.csv and contacts.csv."""
    return hb.Beam(0.3, hb.Section.rectangle(0.025, 0.001), hb.Material(200e9),
                   hb.Support.clamped, hb.Support.free)


def pressed_rod(name):
    """A rod of rods_in_space.csv, where it is pressed and along what, and its turns."""
    steel, support = hb.RodMaterial(200e9, 77e9), hb.RodSupport
    if name == "wire_under_load":
        wire = hb.Rod(0.2, hb.RodSection.circle(0.001), steel, support.clamped, support.free)
        return wire.load((0, -1.2, 0)), 0.14, (0, 0, 1), 1
    if name == "bar_two_ways":
        rod = hb.Rod(1, hb.RodSection.circle(0.006), steel, support.cardan, support.hinged)
        return rod.load((0, -20, 0)), 0.3, (0, 0, 1), 1
    if name == "strip_askew":
        strip = hb.Rod(0.2, hb.RodSection.rectangle(0.010, 0.0005), steel, support.clamped,
                       support.free)
        return strip, 0.16, (0, math.sqrt(0.5), math.sqrt(0.5)), 1
    if name == "hook":
        length = math.pi * 0.05
        hook = hb.Rod(length, hb.RodSection.circle(0.002), steel, support.clamped, support.free)
        return hook.naturally([(length, 0, 20, 0)]), length, (0, 0, 1), 1
    assert name == "spring"
    radius, rise = 0.01, 0.006 / (2 * math.pi)
    square = radius**2 + rise**2
    length = 6 * math.pi * math.sqrt(square)
    spring = hb.Rod(length, hb.RodSection.circle(0.001), steel, support.clamped, support.free)
    spring.naturally([(length, 0, radius / square, rise / square)])
    spring.place_left(hb.RodPose((radius, 0, 0), (0, radius, rise), (-1, 0, 0)))
    return spring, length, (0, 0, -1), 3


@pytest.fixture
def programs():
    """Programs that print what C++ computes, by name; ctest names their folder."""
    folder = os.environ.get("HAPBEAM_REFERENCES")
    if not folder:
        pytest.skip("HAPBEAM_REFERENCES names no folder of reference programs")
    return Path(folder)
