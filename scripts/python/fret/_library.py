# SPDX-License-Identifier: GPL-3.0-or-later
"""libfret by ctypes: where it is, its structures as the headers of include/fret declare them, its errors as exceptions.
Knows no contact mechanics; _contact.py does."""
import ctypes
import os
from ctypes import POINTER, Structure, c_bool, c_char_p, c_double, c_int, c_longdouble, c_size_t, c_void_p
from typing import Optional

import numpy


class Status(Structure):
    _fields_ = [("code", c_int), ("quantity", c_char_p), ("value", c_double), ("limit", c_double)]


class Body(Structure):
    _fields_ = [("E0", c_double), ("nu", c_double), ("rigid", c_bool)]


class Material(Structure):
    _fields_ = [("body", Body * 2), ("k", c_double), ("c0", c_double)]


class Power(Structure):
    _fields_ = [("n", c_double), ("h", c_double), ("r0", c_double)]


TERMS = 16


class Gap(Structure):
    _fields_ = [("kind", c_int), ("terms", c_int), ("power", Power * TERMS), ("b", c_double), ("R", c_double),
                ("slope", c_double), ("table", c_void_p)]


class Press(Structure):
    _fields_ = [("F", c_longdouble), ("dz", c_longdouble), ("a", c_longdouble), ("F_rest", c_double),
                ("dz_rest", c_double)]


class Pressed(Structure):
    _fields_ = [("normal", c_void_p), ("mu", c_double), ("press", Press)]


class Step(Structure):
    _fields_ = [("normal_by", c_int), ("tangential_by", c_int), ("normal", c_double), ("tangential", c_double)]


class Sine(Structure):
    _fields_ = [("FA", c_double), ("FNA", c_double), ("phase", c_double), ("FN", c_longdouble)]


class State(Structure):
    _fields_ = [(name, c_longdouble) for name in "FN dz a Fx dx c W U kn kt".split()] + [("slices", c_size_t)]


class Stress(Structure):
    _fields_ = [(name, c_double) for name in "xx yy zz xy xz yz".split()]


class Foundation(Structure):
    _fields_ = [("k", c_longdouble), ("c0", c_longdouble), ("cN0", c_longdouble), ("cT0", c_longdouble),
                ("eta", c_longdouble), ("hN", c_longdouble * 2), ("hT", c_longdouble * 2), ("beta", c_longdouble * 2),
                ("mismatch", c_longdouble), ("similar", c_bool)]


class Error(ValueError):
    """What the library refuses. `code` is that of fret_code in fret/status.h, `quantity` the argument to blame, `value` and
    `limit` are in SI units."""
    __module__ = "fret"

    def __init__(self, text: str, code: int = 0, quantity: Optional[str] = None, value: Optional[float] = None,
                 limit: Optional[float] = None):
        super().__init__(text)
        self.code, self.quantity, self.value, self.limit = code, quantity, value, limit


class GrossSlip(Error):
    """A tangential force beyond mu F_N, which `limit` is: step by displacement to slide."""
    __module__ = "fret"


_CLASSES = {7: GrossSlip}
_NO_MEMORY = 14

_numbers = POINTER(c_double)
_SIGNATURES = {
    "fret_status_text": (c_int, POINTER(Status), c_char_p, c_size_t),
    "fret_foundation_make": (Status, POINTER(Material), POINTER(Foundation)),
    "fret_table_make": (Status, _numbers, _numbers, c_size_t, c_void_p, POINTER(c_void_p)),
    "fret_table_free": (None, c_void_p),
    "fret_normal_make": (Status, POINTER(Material), POINTER(Gap), c_void_p, c_void_p, POINTER(c_void_p)),
    "fret_normal_free": (None, c_void_p),
    "fret_normal_swings": (c_bool, c_void_p),
    "fret_press_by_force": (Status, c_void_p, c_double, POINTER(Press)),
    "fret_press_by_depth": (Status, c_void_p, c_double, POINTER(Press)),
    "fret_press_by_radius": (Status, c_void_p, c_double, POINTER(Press)),
    "fret_gross_slip": (c_longdouble, POINTER(Pressed)),
    "fret_cycle_loss_by_displacement": (Status, POINTER(Pressed), c_double, POINTER(c_longdouble)),
    "fret_arrays_loss": (Status, POINTER(Pressed), _numbers, _numbers, c_size_t),
    "fret_arrays_loading": (Status, POINTER(Pressed), _numbers, _numbers, _numbers, c_size_t),
    "fret_arrays_press": (Status, c_void_p, _numbers, _numbers, _numbers, c_size_t),
    "fret_contact_make": (Status, c_void_p, c_double, c_int, POINTER(c_void_p)),
    "fret_contact_free": (None, c_void_p),
    "fret_contact_copy": (Status, c_void_p, c_void_p),
    "fret_contact_reset": (None, c_void_p),
    "fret_contact_step": (Status, c_void_p, POINTER(Step)),
    "fret_contact_swing": (Status, c_void_p, POINTER(Sine), c_double, c_double),
    "fret_contact_state": (None, c_void_p, POINTER(State)),
    "fret_contact_forces": (None, c_void_p, POINTER(State)),
    "fret_contact_last_loss": (c_longdouble, c_void_p),
    "fret_contact_displacement": (c_longdouble, c_void_p, c_longdouble),
    "fret_contact_pack": (Status, c_void_p, _numbers, c_size_t, POINTER(c_size_t)),
    "fret_contact_unpack": (Status, c_void_p, _numbers, c_size_t),
    "fret_field_make": (Status, c_void_p, POINTER(c_void_p)),
    "fret_field_free": (None, c_void_p),
    "fret_field_pressure": (Status, c_void_p, c_longdouble, POINTER(c_longdouble)),
    "fret_field_surface": (Status, c_void_p, c_longdouble, POINTER(c_longdouble)),
    "fret_field_traction": (Status, c_void_p, c_longdouble, POINTER(c_longdouble)),
    "fret_field_surface_x": (Status, c_void_p, c_longdouble, POINTER(c_longdouble)),
    "fret_field_slip": (Status, c_void_p, c_longdouble, POINTER(c_longdouble)),
    "fret_field_stress": (Status, c_void_p, c_double, c_double, c_double, c_double, POINTER(Stress)),
    "fret_stress_mises": (c_double, POINTER(Stress)),
    "fret_stress_tresca": (c_double, POINTER(Stress)),
    "fret_stress_principal": (None, POINTER(Stress), POINTER(c_double)),
    "fret_slips_make": (Status, POINTER(c_void_p)),
    "fret_slips_free": (None, c_void_p),
    "fret_slips_clear": (None, c_void_p),
    "fret_slips_count": (c_size_t, c_void_p),
    "fret_contact_watch": (Status, c_void_p, c_void_p),
    "fret_work_make": (Status, c_void_p, c_double, c_void_p, c_size_t, c_size_t, POINTER(c_void_p)),
    "fret_work_free": (None, c_void_p),
    "fret_work_at": (Status, c_void_p, c_longdouble, POINTER(c_longdouble)),
}


def _find() -> ctypes.CDLL:
    """The library: FRET_LIBRARY, the one that `make` leaves in this checkout, or the system's."""
    built = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../build/libfret.so")
    named = os.environ.get("FRET_LIBRARY")
    for path in [named] if named else [built, "libfret.so.1", "libfret.so"]:
        try:
            return ctypes.CDLL(path)
        except OSError as error:
            why = error
    raise ImportError("no libfret: build it with `make`, install it, or name it in FRET_LIBRARY (%s)" % why)


def _declared(library: ctypes.CDLL) -> ctypes.CDLL:
    """The same, with the types of what is called. Raises AttributeError where the library lacks a function: it is older."""
    for name, (result, *arguments) in _SIGNATURES.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library


library = _declared(_find())


def check(status: Status) -> None:
    """Raises what a status tells: Error, GrossSlip or MemoryError."""
    if not status.code:
        return
    if status.code == _NO_MEMORY:
        raise MemoryError
    text = ctypes.create_string_buffer(200)
    library.fret_status_text(status, text, len(text))
    raise _CLASSES.get(status.code, Error)(text.value.decode(), status.code, (status.quantity or b"").decode() or None,
                                           status.value, status.limit)


def numbers(values) -> tuple:
    """An array of doubles in one piece, and its address for C."""
    array = numpy.asarray(values, dtype=float, order="C")
    return array, array.ctypes.data_as(_numbers)


class Handle:
    """An object of the library, freed with the last reference to it."""

    def __init__(self, make: str, free: str, *arguments):
        self.free = None
        self.pointer = c_void_p()
        check(getattr(library, make)(*arguments, ctypes.byref(self.pointer)))
        self.free = getattr(library, free)

    def __del__(self):
        if self.free:
            self.free(self.pointer)
