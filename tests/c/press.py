"""The C interface, from Python: python3 press.py LIBRARY [PROGRAM...]; each program prints the force that it feels."""

import ctypes
import subprocess
import sys


class Beam(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in
                ("length", "axial_stiffness", "bending_stiffness", "thickness", "transverse_load", "axial_load")]
    _fields_ += [("left", ctypes.c_int), ("right", ctypes.c_int)]


class Contact(ctypes.Structure):
    _fields_ = [("force", ctypes.c_double * 2), ("friction", ctypes.c_double * 2), ("s", ctypes.c_double),
                ("d", ctypes.c_double), ("dissipated", ctypes.c_double), ("pressing", ctypes.c_int),
                ("sliding", ctypes.c_int), ("status", ctypes.c_int)]


VON_KARMAN, PINNED = 1, 2
library = ctypes.CDLL(sys.argv[1])
library.hapbeam_rectangle.restype = Beam
library.hapbeam_rectangle.argtypes = [ctypes.c_double] * 4 + [ctypes.c_int] * 2
library.hapbeam_touch_create.restype = ctypes.c_void_p
library.hapbeam_touch_create.argtypes = [ctypes.POINTER(Beam), ctypes.c_int, ctypes.c_int, ctypes.c_double, ctypes.c_void_p,
                                         ctypes.c_char_p]
library.hapbeam_touch_ticks.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_double), ctypes.c_int, ctypes.POINTER(Contact)]
library.hapbeam_touch_destroy.argtypes = [ctypes.c_void_p]

bar = library.hapbeam_rectangle(2.54, 0.0254, 0.0254, 206.84e9, PINNED, PINNED)
message = ctypes.create_string_buffer(512)
touch = library.hapbeam_touch_create(ctypes.byref(bar), VON_KARMAN, 16, 0.01, None, message)
assert touch, message.value.decode()
path = [x_or_w for i in range(1000) for x_or_w in (1.27, 0.03 - 1.73e-5 * i)]
contacts = (Contact * 1000)()
assert library.hapbeam_touch_ticks(touch, (ctypes.c_double * 2000)(*path), 1000, contacts) == 1000
felt = contacts[-1]
library.hapbeam_touch_destroy(touch)
assert felt.pressing == 1 and felt.status == 0
print(f"{felt.force[1]:.3f} N")
for program in sys.argv[2:]:
    force = float(subprocess.run([program], capture_output=True, check=True).stdout)
    assert force == felt.force[1], (program, force, felt.force[1])
