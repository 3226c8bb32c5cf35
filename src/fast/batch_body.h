/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed forms of a power law for each width: included by number/lanes.h alone. */

/* Each quantity comes in two steps with this between them: an array goes through the first, then through the
 * second, since a processor overlaps the groups of a short loop better than those of a long one. */
typedef struct NAMED(part) {
    V L, low;     /* L = -log(1-t), or log(F/Fref), and where needed what L leaves */
    V t, s, sign; /* t = |F|/(mu F_N), s = 1-t */
} NAMED(part);

/* t and s of |F|, each as a pair, and f, low and e of -L for the logarithms. */
FRET_INLINE void NAMED(fraction)(const fret_sweep *w, const V *F, NAMED(part) * p, V *f, V *low, V *e) {
    V size = VALUE(BITS(*F) & 0x7fffffffffffffffu), ih = (V){0} + w->inverse[0], h, l;
    NAMED(product)(&size, &ih, &h, &l);
    l += size * w->inverse[1];
    V t = h + l, tl = (h - t) + l;
    V s = 1.0 - h, rest = ((1.0 - s) - h) - l;
    p->t = t;
    p->s = s + rest;
    V sl = (s - p->s) + rest, m, factor;
    NAMED(reduce)(&p->s, &m, e, &factor);
    /* 1-t near 1 has lost digits of t */
    *f = SELECT(*e == 0.0, -t, m - 1.0);
    *low = SELECT(*e == 0.0, -tl, sl * factor);
}

/* The first step of loss and displacement. */
FRET_INLINE void NAMED(depth)(const fret_sweep *w, const V *F, NAMED(part) * p) {
    V f, low, e, log;
    NAMED(fraction)(w, F, p, &f, &low, &e);
    NAMED(log_of)(&f, &low, &e, &log);
    p->L = -log;
    p->sign = *F;
}

/* w(t) mu F_N delta_x,max. With alpha = (1+q)L/2 and b = (1-q)L/2,
 *   w = 4 r L e^-alpha [sinh(alpha)/alpha - sinh(b)/b]:
 * for L < 3.5 as 4 q r L^3 e^-alpha times a series of positive terms in alpha^2; else
 *   w/4 = (1+rho s)(1-e^-qL) - sigma t          where q < 1/3,
 *       = rho t (1+s) - (1+rho s) s (e^rL-1)    else: the difference that cancels less. */
FRET_INLINE void NAMED(loss)(const fret_sweep *w, const NAMED(part) * p, V *out) {
    V L = p->L, small = (V){0}, large = (V){0}, zero = (V){0};
    M shallow = L < 3.5, deep = L >= 3.5;
    if (ANY(shallow)) {
        V alpha = w->alpha * L, x = alpha * alpha, x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, k, e, f;
        const double *c = w->series;
        V sum =
            (((c[0] + x * c[1]) + x2 * (c[2] + x * c[3])) +
             x4 * ((c[4] + x * c[5]) + x2 * (c[6] + x * c[7]))) +
            x8 * (((c[8] + x * c[9]) + x2 * (c[10] + x * c[11])) + x4 * ((c[12] + x * c[13]) + x2 * c[14]));
        /* e^-alpha = s e^b: the smaller exponent loses less */
        V power = w->shallow * L;
        NAMED(exp_of)(&power, &zero, &k, &e);
        NAMED(two_to)(&k, &f);
        e = (1.0 + e) * f;
        if (w->shallow > 0)
            e = e * p->s;
        small = (((w->cubic * L) * L) * L) * (e * sum);
    }
    if (ANY(deep)) {
        V slope = 1.0 + w->rho * p->s, x = w->deep * L, y;
        NAMED(expm1)(&x, &y);
        if (w->shallow < 0)
            large = -slope * y - w->sigma * p->t;
        else
            large = w->rho * (p->t + p->t * p->s) - slope * (p->s * y);
        large = w->scale * large;
    }
    V partial = SELECT(shallow, small, large), nan = (V){0} + (double)NAN;
    V inside = SELECT(p->s > DBL_EPSILON, partial, (V){0} + w->gross);
    inside = SELECT(p->sign >= 0.0, inside, nan);
    *out = SELECT(p->s >= -DBL_EPSILON, inside, nan);
}

/* delta_x = delta_x,max (1 - e^-qL) */
FRET_INLINE void NAMED(displacement)(const fret_sweep *w, const NAMED(part) * p, V *out) {
    V x = -w->q * p->L, y;
    NAMED(expm1)(&x, &y);
    V inside = SELECT(p->s > DBL_EPSILON, -w->slip * y, (V){0} + w->slip);
    inside = VALUE(BITS(inside) | (BITS(p->sign) & 0x8000000000000000u));
    *out = SELECT(p->s >= -DBL_EPSILON, inside, (V){0} + (double)NAN);
}

/* The first step of the stick radius: the exponent magnifies the error of L. */
FRET_INLINE void NAMED(depth_pair)(const fret_sweep *w, const V *F, NAMED(part) * p) {
    V f, low, e;
    NAMED(fraction)(w, F, p, &f, &low, &e);
    NAMED(log_pair)(&f, &low, &e, &p->L, &p->low);
}

/* c = a s^(1/(n+k+1)) */
FRET_INLINE void NAMED(radius)(const fret_sweep *w, const NAMED(part) * p, V *out) {
    V c;
    NAMED(power)(&p->L, &p->low, w->radius, w->a, &c);
    V inside = SELECT(p->s > DBL_EPSILON, c, (V){0});
    *out = SELECT(p->s >= -DBL_EPSILON, inside, (V){0} + (double)NAN);
}

/* The first step of radius and depth by load: log(F/Fref). */
FRET_INLINE void NAMED(load)(const fret_press_law *w, const V *F, NAMED(part) * p) {
    V m, e, more, factor, z, zl, f, ih = (V){0} + w->inverse[0];
    NAMED(reduce)(F, &m, &e, &factor);
    NAMED(product)(&m, &ih, &z, &zl);
    zl += m * w->inverse[1];
    NAMED(reduce)(&z, &m, &more, &factor);
    f = m - 1.0;
    zl = zl * factor;
    e = e + (more - w->exponent);
    NAMED(log_pair)(&f, &zl, &e, &p->L, &p->low);
    p->t = *F;
}

/* at_ref (F/Fref)^exponent; NaN where the scalar function is to decide. */
FRET_INLINE void NAMED(press)(const NAMED(part) * p, const double exponent[2], double at_ref, V *out) {
    V F = p->t, x, nan = (V){0} + (double)NAN;
    NAMED(power)(&p->L, &p->low, exponent, at_ref, &x);
    /* one by one: some compilers take a conjunction of masks apart, number by number */
    x = SELECT(x >= DBL_MIN, x, nan);
    x = SELECT(x <= DBL_MAX, x, nan);
    x = SELECT(F >= DBL_MIN, x, nan);
    x = SELECT(F <= DBL_MAX, x, nan);
    *out = SELECT(F == 0.0, (V){0}, x);
}

FRET_INLINE void NAMED(press_radius)(const fret_press_law *w, const NAMED(part) * p, V *out) {
    NAMED(press)(p, w->radius, w->r0, out);
}

FRET_INLINE void NAMED(press_depth)(const fret_press_law *w, const NAMED(part) * p, V *out) {
    NAMED(press)(p, w->depth, w->dref, out);
}
