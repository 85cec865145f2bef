"""Force and shape of slender beams and rods that a hand presses.

    import hapbeam as hb

    ruler = hb.Beam(0.3, hb.Section.rectangle(0.025, 0.001), hb.Material(210e9),
                    hb.Support.clamped, hb.Support.free)
    model = hb.FemModel(ruler, 8, hb.Element.Corotational)
    touch = hb.Touch(model, 0.005)
    print(touch.tick((0.25, 0.0)).force)

Names, units (SI) and errors are those of the C++ library.
"""

from . import _core
from ._core import __version__

__all__ = [name for name in vars(_core) if not name.startswith("_")]
globals().update((name, getattr(_core, name)) for name in __all__)
for _name in __all__:
    if hasattr(globals()[_name], "__module__"):
        globals()[_name].__module__ = __name__
del _name
