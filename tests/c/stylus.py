"""A stylus on a rod, from Python: python3 stylus.py LIBRARY [PROGRAM...]; each program prints the wrenches that it feels."""

import ctypes
import math
import subprocess
import sys

Double3, Double9 = ctypes.c_double * 3, ctypes.c_double * 9


class Rod(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in
                ("length", "axial_stiffness", "bending_stiffness1", "bending_stiffness2", "torsional_stiffness", "thickness")]
    _fields_ += [("area", ctypes.c_double), ("density", ctypes.c_double), ("gravity", Double3), ("load", Double3)]
    _fields_ += [(name, ctypes.c_int) for name in ("left", "right", "part_count", "arc_count")]
    _fields_ += [("parts", ctypes.c_void_p), ("arcs", ctypes.c_void_p)]


class Placement(ctypes.Structure):
    _fields_ = [("rotation", Double9), ("origin", Double3), ("scale", ctypes.c_double)]


class Wrench(ctypes.Structure):
    _fields_ = [("force", Double3), ("torque", Double3), ("friction", Double3), ("s", ctypes.c_double),
                ("dissipated", ctypes.c_double), ("pressing", ctypes.c_int), ("sliding", ctypes.c_int),
                ("status", ctypes.c_int)]


FREE, CLAMPED = 0, 1
ROUND_ROD, TWISTED_ROD = 0, 1
library = ctypes.CDLL(sys.argv[1])
library.hapbeam_wire.restype = Rod
library.hapbeam_wire.argtypes = [ctypes.c_double] * 4 + [ctypes.c_int] * 2
library.hapbeam_stylus_create.restype = ctypes.c_void_p
library.hapbeam_stylus_create.argtypes = [ctypes.POINTER(Rod), ctypes.c_int, ctypes.c_int] + [ctypes.c_double] * 3 + [
    ctypes.c_void_p, ctypes.POINTER(Placement), ctypes.c_char_p]
library.hapbeam_stylus_tick.restype = Wrench
library.hapbeam_stylus_tick.argtypes = [ctypes.c_void_p, Double3, Double9]
library.hapbeam_stylus_destroy.argtypes = [ctypes.c_void_p]

wire = library.hapbeam_wire(0.2, 0.002, 200e9, 77e9, CLAMPED, FREE)
world = Placement(Double9(0, 1, 0, 0, 0, 1, 1, 0, 0), Double3(0.15, 0, 0), 1)  # x toward the user, y right, z up
c, s = math.cos(0.1), math.sin(0.1)
across = Double9(0, -s, c, 0, c, s, -1, 0, 0)  # the stylus points across the wire
wrenches = []
for kinematics in ROUND_ROD, TWISTED_ROD:
    message = ctypes.create_string_buffer(512)
    stylus = library.hapbeam_stylus_create(ctypes.byref(wire), kinematics, 8, 0.003, 0.2, 0.12, None, ctypes.byref(world),
                                           message)
    assert stylus, message.value.decode()
    for i in range(400):
        felt = library.hapbeam_stylus_tick(stylus, Double3(0.03, 1e-5 * i, 0.005 - 1e-5 * i), across)
    library.hapbeam_stylus_destroy(stylus)
    assert felt.pressing == 1 and felt.status == 0
    print(f"{felt.force[2]:.3f} N, {1e3 * felt.torque[1]:.1f} mN m")
    wrenches.append([*felt.force, *felt.torque])
for program in sys.argv[2:]:
    lines = subprocess.run([program], capture_output=True, check=True, text=True).stdout.splitlines()
    assert [[float(number) for number in line.split()] for line in lines] == wrenches, (program, lines, wrenches)
