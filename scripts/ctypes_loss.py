# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 scripts/ctypes_loss.py [LIBRARY]: libfret from Python, without anything to compile.

The energy that fretting cycles dissipate, for many amplitudes at once: a steel sphere, R = 10 mm, pressed on a steel flat
with 100 N, mu = 0.4. The arrays may as well be numpy's: array.ctypes.data_as(POINTER(c_double))."""
import ctypes
import os
import sys
from ctypes import POINTER, Structure, byref, c_bool, c_char_p, c_double, c_int, c_longdouble, c_size_t, c_void_p


class Status(Structure):
    _fields_ = [("code", c_int), ("quantity", c_char_p), ("value", c_double), ("limit", c_double)]


class Body(Structure):
    _fields_ = [("E0", c_double), ("nu", c_double), ("rigid", c_bool)]


class Material(Structure):
    _fields_ = [("body", Body * 2), ("k", c_double), ("c0", c_double)]


class Power(Structure):
    _fields_ = [("n", c_double), ("h", c_double), ("r0", c_double)]


class Gap(Structure):
    _fields_ = [("kind", c_int), ("terms", c_int), ("power", Power * 16), ("b", c_double), ("R", c_double),
                ("slope", c_double), ("table", c_void_p)]


class Press(Structure):
    _fields_ = [("F", c_longdouble), ("dz", c_longdouble), ("a", c_longdouble), ("F_rest", c_double),
                ("dz_rest", c_double)]


class Contact(Structure):
    _fields_ = [("normal", c_void_p), ("mu", c_double), ("press", Press)]


def load(path):
    fret = ctypes.CDLL(path)
    for name, arguments in {
            "fret_normal_make": [POINTER(Material), POINTER(Gap), c_void_p, c_void_p, POINTER(c_void_p)],
            "fret_press_by_force": [c_void_p, c_double, POINTER(Press)],
            "fret_arrays_loss": [POINTER(Contact), POINTER(c_double), POINTER(c_double), c_size_t]}.items():
        function = getattr(fret, name)
        function.argtypes, function.restype = arguments, Status
    fret.fret_normal_free.argtypes, fret.fret_normal_free.restype = [c_void_p], None
    fret.fret_status_rule.argtypes, fret.fret_status_rule.restype = [c_int], c_char_p
    return fret


def check(fret, status):
    if status.code:
        raise ValueError("%s = %g %s" % ((status.quantity or b"").decode(), status.value,
                                         fret.fret_status_rule(status.code).decode()))


def losses(fret, amplitudes, FN=100.0, mu=0.4, R=10e-3, E0=210e9, nu=0.3):
    """Energies [J] of cycles with these amplitudes [N]."""
    material = Material(body=(Body(E0, nu, False), Body(E0, nu, False)), k=0, c0=1)
    gap = Gap(kind=0, terms=1)  # a power: h (r/r0)^n
    gap.power[0] = Power(2, 1 / (2 * R), 1)
    normal = c_void_p()
    check(fret, fret.fret_normal_make(byref(material), byref(gap), None, None, byref(normal)))
    try:
        contact = Contact(normal=normal, mu=mu)
        check(fret, fret.fret_press_by_force(normal, FN, byref(contact.press)))
        count = len(amplitudes)
        FA, loss = (c_double * count)(*amplitudes), (c_double * count)()
        check(fret, fret.fret_arrays_loss(byref(contact), FA, loss, count))
        return list(loss)
    finally:
        fret.fret_normal_free(normal)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    built = os.path.join(here, "../build/libfret.so")
    fret = load(sys.argv[1] if len(sys.argv) > 1 else built if os.path.exists(built) else "libfret.so.0")
    amplitudes = [5.0 * i for i in range(1, 9)]
    print("  FA [N]     dW [uJ]")
    for FA, loss in zip(amplitudes, losses(fret, amplitudes)):
        print("%8g  %10.6g" % (FA, 1e6 * loss))


if __name__ == "__main__":
    main()
