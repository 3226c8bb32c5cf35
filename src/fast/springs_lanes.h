/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops over springs for vectors of LANES doubles; included once a width, with NAME(x) to tell the
 * functions apart and TARGET the instructions they may use. At every width sum l takes the springs i with
 * i % SUMS == l in their order, so that all widths give the same bits. */

typedef double NAME(vec) __attribute__((vector_size(8 * LANES), may_alias));
typedef long long NAME(mask) __attribute__((vector_size(8 * LANES), may_alias));

enum { NAME(PARTS) = SUMS / LANES };

/* compilers keep the sums in registers only when this loop is gone */
#define EACH_PART _Pragma("GCC unroll 4") for (int k = 0; k < NAME(PARTS); k++)
#define AT(array) (*(NAME(vec) *)((array) + i + k * LANES))

TARGET static inline NAME(vec) NAME(choose)(NAME(mask) which, NAME(vec) a, NAME(vec) b) {
    return (NAME(vec))(((NAME(mask))a & which) | ((NAME(mask))b & ~which));
}

#ifndef LEAST /* instructions that compilers do not find by themselves */
TARGET static inline NAME(vec) NAME(least)(NAME(vec) a, NAME(vec) b) {
    return NAME(choose)(a < b, a, b);
}

TARGET static inline NAME(vec) NAME(most)(NAME(vec) a, NAME(vec) b) {
    return NAME(choose)(a > b, a, b);
}
#define LEAST NAME(least)
#define MOST NAME(most)
#define ANY(mask) fret_any(&(mask), LANES)
#endif

/* Adds x to sum + rest without rounding (two-sum). */
TARGET static inline void NAME(add)(double *sum, double *rest, NAME(vec) x) {
    NAME(vec) old = *(NAME(vec) *)sum, now = old + x, part = now - old;
    *(NAME(vec) *)rest += (old - (now - part)) + (x - part);
    *(NAME(vec) *)sum = now;
}

TARGET static inline void NAME(clear)(partial_sums *out) {
    double *const sums[] = {out->force, out->force_rest, out->loss, out->loss_rest};
    for (int i = 0; i < 4; i++)
        EACH_PART *(NAME(vec) *)(sums[i] + k * LANES) = (NAME(vec)){0};
}

/* At constant bounds a spring that slips dissipates w |v| |trial-v|, and |v| is its bound. */
TARGET static void NAME(shift)(const cells *c, size_t end, double ddx, partial_sums *out) {
    const NAME(vec) zero = {0};
    double *restrict const w_ = c->w, *restrict const b_ = c->b, *restrict const u_ = c->u;
    NAME(clear)(out);
    for (size_t from = 0; from < end; from += STRIDE) {
        NAME(vec) force[NAME(PARTS)], loss[NAME(PARTS)];
        const size_t to = end - from > STRIDE ? from + STRIDE : end;
        EACH_PART force[k] = loss[k] = zero;
        for (size_t i = from; i < to; i += SUMS) {
            EACH_PART {
                NAME(vec) w = AT(w_), b = AT(b_), trial = AT(u_) + ddx;
                NAME(vec) v = MOST(LEAST(trial, b), -b), pull = w * v, excess = trial - v;
                force[k] += pull;
                loss[k] += pull * excess;
                AT(u_) = v;
            }
        }
        EACH_PART {
            NAME(add)(out->force + k * LANES, out->force_rest + k * LANES, force[k]);
            NAME(add)(out->loss + k * LANES, out->loss_rest + k * LANES, loss[k]);
        }
    }
}

/* On a straight path a spring that has begun to slip goes on to the end, so the bound at both ends decides.
 * touched: the part of the step during which a spring is in contact. */
TARGET static void NAME(deform)(const cells *c, size_t end, const straight *p, partial_sums *out) {
    const NAME(vec) zero = {0}, one = zero + 1, tiny = zero + DBL_MIN;
    double *restrict const g_ = c->g, *restrict const w_ = c->w, *restrict const b_ = c->b,
                           *restrict const u_ = c->u;
    NAME(clear)(out);
    for (size_t from = 0; from < end; from += STRIDE) {
        NAME(vec) force[NAME(PARTS)], loss[NAME(PARTS)];
        const size_t to = end - from > STRIDE ? from + STRIDE : end;
        EACH_PART force[k] = loss[k] = zero;
        for (size_t i = from; i < to; i += SUMS) {
            EACH_PART {
                NAME(vec) g = AT(g_), w = AT(w_), b0 = AT(b_);
                NAME(vec) b1 = MOST(c->mu_eta * (p->z1 - g), zero);
                NAME(vec) touched = MOST(LEAST((p->hi - g) * p->inverse, one), zero);
                NAME(vec) moved = touched * p->ddx, trial = AT(u_) + moved;
                NAME(vec) v = MOST(LEAST(trial, b1), -b1), excess = trial - v;
                force[k] += w * v;
                AT(u_) = v;
                AT(b_) = b1;
                NAME(mask) slips = excess != zero;
                if (!ANY(slips)) /* most stick, and a division takes as long as all the rest */
                    continue;
                NAME(vec)
                slip = MOST(excess, -excess), along = NAME(choose)(excess < zero, -moved, moved);
                /* slip at a steady rate since its onset, while the bound went linearly to b1 */
                NAME(vec) whole = MOST(MOST(along + (b0 - b1), slip), tiny);
                NAME(vec) bound = b1 + 0.5 * (b0 - b1) * (slip / whole);
                loss[k] += w * bound * slip;
            }
        }
        EACH_PART {
            NAME(add)(out->force + k * LANES, out->force_rest + k * LANES, force[k]);
            NAME(add)(out->loss + k * LANES, out->loss_rest + k * LANES, loss[k]);
        }
    }
}

#undef EACH_PART
#undef AT
#undef LEAST
#undef MOST
#undef ANY
#undef NAME
#undef LANES
#undef TARGET
