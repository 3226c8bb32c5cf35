# SPDX-License-Identifier: GPL-3.0-or-later
"""A contact with a memory, over the one door of the library (fret/contact.h). SI units throughout."""
import ctypes
from collections import namedtuple
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple, Union

import numpy

from . import _library as lib
from ._library import library

#: What takes one number, or an array of any shape; what comes of it has that shape.
Array = Union[float, Sequence[float], numpy.ndarray]
Values = Union[float, numpy.ndarray]


@dataclass(frozen=True)
class Body:
    """A half-space of modulus E0 [Pa] > 0 and Poisson's ratio -1 < nu <= 1/2. Contact raises Error where they are not."""
    E0: float
    nu: float


#: The second body, where it does not give way.
rigid = Body(float("inf"), 0.0)


@dataclass(frozen=True)
class Material:
    """Two bodies with E(z) = E0 (z/c0)^k, -1 < k < 1, c0 [m] > 0; k and c0 are shared (1). The second body is as the first,
    or a Body, or `rigid`. Bodies that are not elastically similar are computed as if normal and tangential contact were
    uncoupled, an approximation. Contact raises Error where a constant is out of range."""
    E0: float
    nu: float
    k: float = 0.0
    c0: float = 1e-3
    second: Optional[Body] = None

    def _struct(self) -> lib.Material:
        second = self.second or Body(self.E0, self.nu)
        stiff = second == rigid
        return lib.Material((lib.Body(self.E0, self.nu, False), lib.Body(0 if stiff else second.E0, second.nu, stiff)),
                            self.k, self.c0)


class Shape:
    """The initial gap f(r) between the bodies, with rotational symmetry. Made by the functions of this module: sphere, cone,
    power, ... Lengths, slopes and exponents are > 0, else Contact raises Error."""

    def __init__(self, kind: int, powers: Sequence[Tuple[float, float, float]] = (), b: float = 0.0, R: float = 0.0,
                 slope: float = 0.0, rows: Optional[Tuple[Array, Array]] = None):
        self._gap = lib.Gap(kind=kind, terms=len(powers), b=b, R=R, slope=slope)
        if len(powers) > lib.TERMS:
            raise lib.Error("a sum has %d powers at most" % lib.TERMS)
        for i, power in enumerate(powers):
            self._gap.power[i] = lib.Power(*power)
        self._table = None
        self._made_of = (kind, tuple(powers), b, R, slope, rows)
        if rows is not None:
            (r, at_r), (f, at_f) = map(lib.numbers, rows)
            if r.shape != f.shape or r.ndim != 1:
                raise lib.Error("a table has as many radii as gaps")
            self._table = lib.Handle("fret_table_make", "fret_table_free", at_r, at_f, len(r), None)
            self._gap.table = self._table.pointer

    def __reduce__(self):
        return Shape, self._made_of


def sphere(R: float) -> Shape:
    """f = r^2/(2R), R [m] > 0, Hertz: two curved bodies have 1/R = 1/R1 + 1/R2."""
    return Shape(0, [(2, 0.5 / R, 1)])


def cone(slope: float) -> Shape:
    """f = slope r, slope [1] > 0: the tangent of the angle between flank and base plane."""
    return Shape(0, [(1, slope, 1)])


def power(n: float, h: float, r0: float = 1.0) -> Shape:
    """f = h (r/r0)^n, n from 1e-6 to 1e6; h [m] > 0 is the gap at r0 [m] > 0 (6)."""
    return Shape(0, [(n, h, r0)])


def powers(terms: Sequence[Tuple[float, float, float]]) -> Shape:
    """A sum of up to 16 such powers, each (n, h, r0); raises Error where there are more."""
    return Shape(1, list(terms))


def flat_cone(b: float, slope: float) -> Shape:
    """f = slope (r - b) for r > b [m], else 0: a truncated cone."""
    return Shape(2, b=b, slope=slope)


def flat_paraboloid(b: float, R: float) -> Shape:
    """f = (r^2 - b^2)/(2R) for r > b [m], else 0: a truncated sphere."""
    return Shape(3, b=b, R=R)


def flat_rounded(b: float, R: float) -> Shape:
    """f = (r - b)^2/(2R) for r > b [m], else 0: the usual fretting pad."""
    return Shape(4, b=b, R=R)


def exact_sphere(R: float) -> Shape:
    """f = R - sqrt(R^2 - r^2), R [m] > 0; loads that lead beyond r = 0.95 R raise Error."""
    return Shape(5, R=R)


def table(r: Array, f: Array) -> Shape:
    """A sampled gap, a monotone piecewise cubic: r[0] = 0 < r[1] < ..., f[0] = 0 [m], as many radii as gaps, else Error.
    Loads that lead beyond the last row, or to where g(x) falls so that the contact is no disc, raise Error."""
    return Shape(6, rows=(r, f))


def flat(b: float) -> Shape:
    """A rigid flat punch, f = 0 for r < b [m] and nothing beyond: a = b under any load, and p is infinite at the edge.

    >>> import fret
    >>> punch = fret.Contact(fret.Material(E0=210e9, nu=0.3, second=fret.rigid), fret.flat(b=1e-3), mu=0.4).press(FN=100)
    >>> print("%.12g" % (punch.p(0) / (100 / (2 * 3.141592653589793 * 1e-3**2))))
    1
    """
    return Shape(7, b=b)


State = namedtuple("State", "FN dz a Fx dx c W U kn kt")
State.__doc__ = """What a contact is now: normal force FN [N], indentation depth dz [m], contact radius a [m]; tangential force
Fx [N], displacement dx [m], stick radius c [m]; energy dissipated so far W [J], stored tangential energy U [J]; stiffnesses
kn = dFN/ddz and kt = dFx/ddx going on in the direction of the last step [N/m]."""


class Stress(namedtuple("Stress", "xx yy zz xy xz yz")):
    """Stress [Pa], tension positive: each component a number, or an array of the shape of the places.

    >>> import fret
    >>> float(fret.Stress(3e6, 1e6, 0, 0, 0, 0).tresca)
    3000000.0
    """
    __slots__ = ()

    @property
    def mises(self) -> Values:
        """Von Mises' equivalent stress [Pa]."""
        return self._each(library.fret_stress_mises)

    @property
    def tresca(self) -> Values:
        """Tresca's equivalent stress [Pa]: the largest principal stress less the smallest."""
        return self._each(library.fret_stress_tresca)

    @property
    def principal(self) -> numpy.ndarray:
        """The principal stresses [Pa], the largest first, along a last axis of 3; to 1e-8 of it where two are equal."""
        def of(stress):
            out, address = lib.numbers(numpy.empty(3))
            library.fret_stress_principal(stress, address)
            return out
        return self._each(of)

    def _each(self, of) -> Values:
        parts = numpy.broadcast_arrays(*self)
        found = numpy.array([of(ctypes.byref(lib.Stress(*at))) for at in zip(*(part.flat for part in parts))])
        return found.reshape(parts[0].shape + found.shape[1:])[()]


def _one_of(what: str, **given) -> Tuple[str, float]:
    """The name and value of the one argument that is given."""
    named = [(name, value) for name, value in given.items() if value is not None]
    if len(named) != 1:
        raise TypeError("%s takes one of %s" % (what, ", ".join(given)))
    return named[0]


class Contact:
    """Two bodies in contact: any history of both forces, or both displacements, exactly.

    Coulomb's friction mu > 0, slip along the force. `exact` steps in long double, all digits of a double; without it power
    laws step five times as fast, to 3e-14 of mu FN (fret/contact.h tells the bounds), and have no fields, no swing and no work
    by place. Raises Error where a constant of the material, a length of the shape or mu is out of range, or, with exact=False, the
    shape is no power.

    >>> import fret
    >>> ball = fret.Contact(fret.Material(E0=210e9, nu=0.3), fret.sphere(R=10e-3), mu=0.4)
    >>> now = ball.press(FN=100).step(Fx=20).state
    >>> print("a = %.6g m, c = %.6g m, dx = %.6g m" % (now.a, now.c, now.dx))
    a = 0.000186626 m, c = 0.000148125 m, dx = 6.25995e-07 m
    >>> print("%.6g J" % ball.cycle(FA=20))
    1.90646e-06 J
    >>> ball.step(Fx=50)
    Traceback (most recent call last):
        ...
    fret.GrossSlip: Fx = 50 exceeds the friction limit: gross slip
    """

    def __init__(self, material: Material, shape: Shape, mu: float, exact: bool = True):
        self._made_of = (material, shape, mu, exact)
        self._law = lib.Handle("fret_normal_make", "fret_normal_free", ctypes.byref(material._struct()),
                               ctypes.byref(shape._gap), None, None)
        self._contact = lib.Handle("fret_contact_make", "fret_contact_free", self._law.pointer, mu, 0 if exact else 1)
        self._slips: Optional[lib.Handle] = None

    # ---- loads ----------------------------------------------------------------------------------

    def press(self, FN: Optional[float] = None, dz: Optional[float] = None, a: Optional[float] = None) -> "Contact":
        """Presses the open bodies anew: to a force FN [N] >= 0, an indentation depth dz [m] (< 0: a gap) or a contact radius
        a [m] >= 0 (10)-(13). Returns the contact, as the other loads do that have no result. Raises Error where the number
        is negative, no number, or beyond the end of the gap; the contact is then as before."""
        name, value = _one_of("press", FN=FN, dz=dz, a=a)
        if name == "a":
            name, value = "dz", float(self._pressed("radius", value).dz)
        anew = self.copy()
        library.fret_contact_reset(anew._contact.pointer)
        lib.check(library.fret_contact_copy(self._contact.pointer, anew.step(**{name: value})._contact.pointer))
        self._forget()
        return self

    def step(self, FN: Optional[float] = None, dz: Optional[float] = None, Fx: Optional[float] = None,
             dx: Optional[float] = None) -> "Contact":
        """One straight step to a force or a displacement, normal (FN [N] or dz [m]), tangential (Fx [N] or dx [m]) or both:
        straight in (FN, Fx) where Fx is given, else in (dz, dx) (fret/contact.h has the memory diagram, by which no step is
        discretised). What is not given is kept: FN, and with a normal step dx. Raises GrossSlip where |Fx| > mu FN, Error
        where FN < 0 or a number is not finite; the contact is then as before."""
        step = lib.Step(0, 0, 0, 0)
        if FN is not None or dz is not None:
            name, step.normal = _one_of("the normal part of a step", FN=FN, dz=dz)
            step.normal_by = 1 if name == "FN" else 2
        if Fx is not None or dx is not None:
            name, step.tangential = _one_of("the tangential part of a step", Fx=Fx, dx=dx)
            step.tangential_by = 2 if name == "Fx" else 1
        lib.check(library.fret_contact_step(self._contact.pointer, ctypes.byref(step)))
        return self

    def cycle(self, FA: Optional[float] = None, dxA: Optional[float] = None, times: int = 1, FNA: float = 0.0,
              phase: float = 0.0) -> float:
        """Closed cycles Fx = -FA .. FA [N], or dx = -dxA .. dxA [m]; with FNA > 0 [N] the normal force swings too,
        Fx = FA cos s, FN + FNA cos(s + phase), phase in rad. Returns the energy that the last of them dissipates [J] (26),
        (27). Raises GrossSlip where FA > mu FN, Error where times < 1 or a swinging load opens the contact or slides."""
        name, amplitude = _one_of("cycle", FA=FA, dxA=dxA)
        if times < 1:
            raise lib.Error("times = %s must be 1 or more" % times)
        if FNA:
            if name == "dxA":
                raise lib.Error("a normal force swings with Fx: give FA")
            FN = self.forces.FN
            self.step(FN=FN + FNA * numpy.cos(phase), Fx=amplitude)
            for _ in range(times):
                loss = self.swing(amplitude, FNA, phase, FN)
            return loss
        name = "Fx" if name == "FA" else "dx"
        self.step(**{name: amplitude})
        for _ in range(times):
            loss = 0.0
            for end in (-amplitude, amplitude):
                self.step(**{name: end})
                loss += library.fret_contact_last_loss(self._contact.pointer)
        return loss

    def swing(self, FA: float, FNA: float, phase: float, FN: float, start: float = 0.0, end: float = 1.0) -> float:
        """The part start .. end of a period of Fx = FA cos s, FN + FNA cos(s + phase): the sine itself, no chords. The load
        must be where the part begins, 0 <= start < end <= 1. Returns what it dissipates [J], to 1e-15 of a power law, 1e-13
        of other shapes. Raises Error with exact=False, of a table, and for a load that opens the contact, slides, or begins
        elsewhere."""
        lib.check(library.fret_contact_swing(self._contact.pointer, ctypes.byref(lib.Sine(FA, FNA, phase, FN)), start, end))
        return library.fret_contact_last_loss(self._contact.pointer)

    # ---- what it is now -------------------------------------------------------------------------

    @property
    def state(self) -> State:
        """Everything: see State."""
        return self._state(library.fret_contact_state)

    @property
    def forces(self) -> State:
        """Forces, displacements and W alone, for an inner loop; a, c, U, kn, kt may be 0."""
        return self._state(library.fret_contact_forces)

    def _state(self, ask) -> State:
        now = lib.State()
        ask(self._contact.pointer, ctypes.byref(now))
        return State(*(getattr(now, name) for name in State._fields))

    def p(self, r: Array) -> Values:
        """Pressure p(r) [Pa] at radii r >= 0 [m], a number or an array; 0 outside (fret/field.h has the transform). To 1e-14
        of itself, after swinging 1e-13 of the largest value; 2 us each. Raises Error where r < 0, the field is infinite (at a
        sharp edge with k <= 0, at a tip with n + k <= 1), and with exact=False; so do those below.

        >>> import fret
        >>> steel = fret.Material(E0=210e9, nu=0.3)
        >>> round(float(fret.Contact(steel, fret.sphere(R=10e-3), mu=0.4).press(FN=100).p(0)) / 1e6, 3)
        1370.879
        """
        return self._field("pressure", r)

    def qx(self, r: Array) -> Values:
        """Tangential traction q_x(r) [Pa] at radii r >= 0 [m]; ranges and errors as of p."""
        return self._field("traction", r)

    def uz(self, r: Array) -> Values:
        """Normal displacement of the surfaces u_z(r) [m], both bodies together, at r >= 0 [m]; errors as of p."""
        return self._field("surface", r)

    def ux(self, r: Array) -> Values:
        """Tangential displacement u_x(r) [m], both bodies together, the mean over the angle, at r >= 0 [m]; errors as of p."""
        return self._field("surface_x", r)

    def slip(self, r: Array) -> Values:
        """Local slip delta_x - u_x(r) [m], on which friction works, at r >= 0 [m]: exactly 0 where all springs within r
        stick; accuracy as of u_x, of delta_x; errors as of p. Of first loading it is mu eta (f + u_z - dz) of the contact
        that ends at c, in closed form of a ball:

        >>> import fret, numpy
        >>> ball = fret.Contact(fret.Material(E0=210e9, nu=0.3), fret.sphere(R=10e-3), mu=0.4).press(FN=100).step(Fx=20)
        >>> c, r = ball.state.c, numpy.linspace(0.8, 1, 5) * ball.state.a
        >>> t = numpy.arcsin(c / r)
        >>> s = c**2 / 10e-3 * (r**2 / c**2 / 2 - 1 + ((2 - r**2 / c**2) * t + 1 / numpy.tan(t)) / numpy.pi)
        >>> bool(numpy.allclose(ball.slip(r), ball.dxmax / ball.state.dz * s, rtol=1e-11)), float(ball.slip(c / 2))
        (True, 0.0)
        """
        return self._field("slip", r)

    def stress(self, x: Array, y: Array, z: Array) -> Stress:
        """Stress inside homogeneous bodies (k = 0) at places x, y, z [m], x along Fx, z >= 0 into the first body, z < 0 into
        the second; numbers or arrays that broadcast. By line loads on the imaginary axis (fret/field.h), to 1e-12 of the
        largest pressure, 5 us each. Raises Error of graded bodies, in a rigid one, with exact=False, after swinging, and where
        p is infinite. Beneath Hertz's ball, nu = 0.3, the largest shear stress is 0.310 p0 at 0.48 a (Johnson 1985, 4.2):

        >>> import fret, numpy
        >>> ball = fret.Contact(fret.Material(E0=210e9, nu=0.3), fret.sphere(R=10e-3), mu=0.4).press(FN=100)
        >>> z = numpy.linspace(0.4, 0.6, 2001) * ball.state.a
        >>> shear = ball.stress(0, 0, z).tresca / 2 / ball.p(0)
        >>> "%.3f p0 at %.3f a" % (shear.max(), z[shear.argmax()] / ball.state.a)
        '0.310 p0 at 0.481 a'
        """
        field = self._present()
        material = self._made_of[0]
        places = numpy.broadcast_arrays(*(numpy.asarray(at, dtype=float) for at in (x, y, z)))
        found = numpy.empty((6,) + places[0].shape)
        stress = lib.Stress()
        for at in numpy.ndindex(places[0].shape):
            body = material.second if material.second and places[2][at] < 0 else material
            if body == rigid:
                raise lib.Error("z < 0 is in the second body, which is rigid: it has no stress")
            lib.check(library.fret_field_stress(field.pointer, body.nu, *(place[at] for place in places), ctypes.byref(stress)))
            found[(slice(None),) + at] = [getattr(stress, name) for name in Stress._fields]
        return Stress(*(part[()] for part in found))

    def _present(self) -> lib.Handle:
        return lib.Handle("fret_field_make", "fret_field_free", self._contact.pointer)

    def _field(self, kind: str, r: Array) -> Values:
        return self._at("fret_field_" + kind, self._present(), r)

    def _at(self, kind: str, of: lib.Handle, r: Array) -> Values:
        ask = getattr(library, kind)
        radii = numpy.asarray(r, dtype=float)
        values = numpy.empty(radii.size)
        value = ctypes.c_longdouble()
        for i, radius in enumerate(radii.flat):
            lib.check(ask(of.pointer, radius, ctypes.byref(value)))
            values[i] = value.value
        return values.reshape(radii.shape)[()]

    # ---- what friction has done, by place ---------------------------------------------------------

    def watch(self) -> "Contact":
        """From here on what slips is kept, phase by phase (150 bytes each), so that `work` can tell where; pressing anew
        begins anew. Returns the contact. Raises Error with exact=False.

        >>> import fret, numpy
        >>> ball = fret.Contact(fret.Material(E0=210e9, nu=0.3), fret.sphere(R=10e-3), mu=0.4).watch()
        >>> before = ball.press(FN=100).step(Fx=20).phases
        >>> dW = ball.cycle(FA=20)
        >>> x, weight = numpy.polynomial.legendre.leggauss(60)  # of r = a sin(t), t = 0 .. pi/2: 2 pi int w r dr = W
        >>> t, a = numpy.pi / 4 * (x + 1), ball.state.a
        >>> ring = numpy.pi / 4 * weight * 2 * numpy.pi * a**2 * numpy.sin(t) * numpy.cos(t)
        >>> "%.3f" % (numpy.sum(ring * ball.work(a * numpy.sin(t))) / ball.state.W)
        '1.000'
        >>> "%.3f" % (numpy.sum(ring * ball.work(a * numpy.sin(t), since=before)) / dW)
        '1.000'
        >>> r, s = 0.9 * a, ball.slip(0.9 * a)  # of a closed cycle 4 mu p s at its end
        >>> "%.10f" % (ball.work(r, since=before) / (4 * 0.4 * ball.p(r) * s))
        '1.0000000000'
        """
        slips = lib.Handle("fret_slips_make", "fret_slips_free")
        lib.check(library.fret_contact_watch(self._contact.pointer, slips.pointer))
        self._slips = slips
        return self

    @property
    def phases(self) -> int:
        """How many phases of slip there have been since the contact is watched; 0 where it is not."""
        return library.fret_slips_count(self._slips.pointer) if self._slips else 0

    def work(self, r: Array, since: int = 0) -> Values:
        """Work of friction w(r) [J/m^2] >= 0 at radii r >= 0 [m], of what has slipped while the contact was watched; since: of
        the phases from that number on, as `phases` was before a cycle. In closed form at constant FN, else integrated
        (fret/work.h); a wear law makes a depth alpha w(r) of it. Raises Error where nobody watches, r < 0, since is no such
        number, and where pressure is infinite and it slips."""
        if not self._slips:
            raise lib.Error("the work of friction is that of a contact that is watched: watch() before it slips")
        if not 0 <= since <= self.phases:
            raise lib.Error("since = %s must lie in 0 .. %d, the phases so far" % (since, self.phases))
        return self._at("fret_work_at", lib.Handle("fret_work_make", "fret_work_free", self._law.pointer, self._made_of[2],
                                                   self._slips.pointer, since, self.phases), r)

    def _forget(self) -> None:
        if self._slips:
            library.fret_slips_clear(self._slips.pointer)

    # ---- closed forms for arrays of loads -------------------------------------------------------

    def loss(self, FA: Optional[Array] = None, dxA: Optional[Array] = None) -> Values:
        """Energies [J] dissipated in closed cycles of amplitudes 0 <= FA <= mu FN [N], or dxA >= 0 [m] (beyond gross slip,
        too), at the normal force as it is: closed forms (26), (27), 10 ns each by force, to 2e-15 of a power law and 1e-14
        of other shapes. Raises GrossSlip, or Error, for the first amplitude that is out of range.

        >>> import fret
        >>> ball = fret.Contact(fret.Material(E0=210e9, nu=0.3), fret.sphere(R=10e-3), mu=0.4).press(FN=100)
        >>> [float("%.6g" % dW) for dW in ball.loss(FA=[10, 20, 30])]
        [1.88365e-07, 1.90646e-06, 9.01533e-06]
        """
        name, amplitudes = _one_of("loss", FA=FA, dxA=dxA)
        contact = self._loaded()
        if name == "FA":
            return self._many(amplitudes, 1, lambda at, to, n: library.fret_arrays_loss(contact, at, to[0], n))[0]

        def by_displacement(at, to, count):
            loss = ctypes.c_longdouble()
            for i in range(count):
                lib.check(library.fret_cycle_loss_by_displacement(contact, at[i], ctypes.byref(loss)))
                to[0][i] = loss.value
            return lib.Status()
        return self._many(amplitudes, 1, by_displacement)[0]

    def loading(self, Fx: Array) -> Tuple[Values, Values]:
        """Stick radii c and displacements dx [m] of first loading to |Fx| <= mu FN [N], at the normal force as it is (15)
        to (18), to 1e-15 of a power law. Raises GrossSlip for the first that is beyond."""
        contact = self._loaded()
        return self._many(Fx, 2, lambda at, to, n: library.fret_arrays_loading(contact, at, to[0], to[1], n))

    def pressing(self, FN: Array) -> Tuple[Values, Values]:
        """Contact radii a and indentation depths dz [m] under normal forces FN [N] >= 0 (10)-(13), to 1e-15 of a power law.
        Raises Error for the first that is negative or beyond the end of the gap."""
        return self._many(FN, 2,
                          lambda at, to, n: library.fret_arrays_press(self._law.pointer, at, to[0], to[1], n))

    @property
    def dxmax(self) -> float:
        """Displacement at which gross slip begins [m], mu eta dz, at the normal force as it is (17)."""
        return library.fret_gross_slip(self._loaded())

    def _many(self, loads: Array, count: int, ask) -> Tuple[Values, ...]:
        array, at = lib.numbers(loads)
        out = [lib.numbers(numpy.empty(array.shape)) for _ in range(count)]
        lib.check(ask(at, [address for _, address in out], array.size))
        return tuple(values[()] for values, _ in out)

    def _pressed(self, by: str, value: float) -> lib.Press:
        press = lib.Press()
        lib.check(getattr(library, "fret_press_by_" + by)(self._law.pointer, value, ctypes.byref(press)))
        return press

    def _loaded(self) -> lib.Pressed:
        return lib.Pressed(self._law.pointer, self._made_of[2], self._pressed("force", self.forces.FN))

    # ---- the history ----------------------------------------------------------------------------

    def copy(self) -> "Contact":
        """Another contact with the same history, over the same law; nobody watches it."""
        other = Contact.__new__(Contact)
        other._made_of, other._law, other._slips = self._made_of, self._law, None
        other._contact = lib.Handle("fret_contact_make", "fret_contact_free", self._law.pointer, self._made_of[2],
                                    0 if self._made_of[3] else 1)
        lib.check(library.fret_contact_copy(other._contact.pointer, self._contact.pointer))
        return other

    def pack(self) -> numpy.ndarray:
        """The history as an array of doubles; `unpack` of a contact of the same law, mu and exactness takes it back, bit for
        bit. What has swung is packed as its chords."""
        count = ctypes.c_size_t()
        library.fret_contact_pack(self._contact.pointer, None, 0, ctypes.byref(count))
        out, address = lib.numbers(numpy.empty(count.value))
        lib.check(library.fret_contact_pack(self._contact.pointer, address, len(out), ctypes.byref(count)))
        return out

    def unpack(self, history: Array) -> "Contact":
        """Takes a history that `pack` gave; what was watched before is forgotten. Raises Error where it is none of such a
        contact, which is then as before."""
        array, address = lib.numbers(history)
        lib.check(library.fret_contact_unpack(self._contact.pointer, address, array.size))
        self._forget()
        return self

    def __reduce__(self):
        return _restored, (self._made_of, self.pack())


def _restored(made_of: tuple, history: numpy.ndarray) -> Contact:
    return Contact(*made_of).unpack(history)
