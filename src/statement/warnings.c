/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings of what the theory leaves out: elastically dissimilar bodies, contacts too wide or too steep for
 * half-spaces, bulk stress, yield. Each is given once, and again after its condition has ceased to hold. */
#include <math.h>

#include "scene/functions.h"
#include "statement/shell.h"

/* Bits of shell.warned. */
enum { DISSIMILAR = 1, WIDE = 2, STEEP = 4, BULK = 8, YIELDS = 16 }; /* 32: yield of the second body */

/* Updates the bit of a warning; true if its condition holds and the warning has not been given yet. */
static bool is_new(shell *sh, unsigned what, bool holds) {
    const bool said = sh->warned & what;
    sh->warned = holds ? sh->warned | what : sh->warned & ~what;
    return holds && !said;
}

/* By how many per cent full stick stiffens the normal contact, the most that friction can: artanh(beta)/beta
 * - 1 for any shape, k = 0 (Spence, Proc. R. Soc. A 305, 1968). */
static double stiffening(const fret_foundation *f) {
    return 100 * (double)(atanhl(f->mismatch) / f->mismatch - 1);
}

/* The theory leaves out the coupling of normal and tangential contact. That is exact for a normal load
 * without friction, so the warning waits for a tangential load or question. */
void shell_warn_dissimilar(shell *sh) {
    scene *s = &sh->calc.scene;
    const fret_normal *normal;
    const load_reach *reach;
    if (!scene_normal(s, &normal, error_quiet()))
        return;
    const fret_foundation *f = fret_normal_foundation(normal);
    const bool tangential =
        s->used & ASKED_TANGENTIAL || (scene_reach(s, &reach, error_quiet()) && reach->by);
    if (is_new(sh, DISSIMILAR, !f->similar && (sh->warned & DISSIMILAR || tangential))) {
        char size[80] = "; for k other than 0 its effect is not known";
        if (f->k == 0)
            snprintf(size, sizeof size, "; kn is up to %.2g %% too small (dW: help limits)", stiffening(f));
        shell_warning(sh,
                      "the bodies are elastically dissimilar (mismatch %.3g): the coupling of normal and "
                      "tangential contact is neglected%s",
                      (double)f->mismatch, size);
    }
}

/* Limits of the half-space approximation: of a/R, and of the slope (tan 20 deg). */
static const double most_radius = 0.3, most_slope = 0.36397023426620236;

/* The press of the widest contact: the present one, or the largest of the cycle that ends now (within). */
static bool find_wide(scene *s, fret_press *wide, bool *within) {
    const fret_press *now;
    const fret_normal *normal;
    fret_press top;
    *within = false;
    if (!scene_press(s, &now, error_quiet()) || !scene_normal(s, &normal, error_quiet()))
        return false;
    *wide = *now;
    if (program_last_cycle(s->program, s->end) + 1 != s->end.steps)
        return true;
    long double FNA = 0, phase = 0;
    scene_get(s, IN_FNA, &FNA, error_quiet());
    scene_get(s, IN_PHASE, &phase, error_quiet());
    const fret_real most = now->F + fabsl(FNA) - FNA * cosl(phase); /* now is FN + FNA cos(phase) */
    if (most > now->F && !fret_press_by_force(normal, (double)most, &top).code) {
        *wide = top;
        *within = true;
    }
    return true;
}

/* The smallest radius of curvature of a body, infinite if there is none; *name: what it is called. The radii
 * of the bodies count, not the relative one, which is far larger where a ball lies in a socket. */
static long double least_radius(scene *s, const char **name) {
    const double *R = s->in.radii;
    long double of_both = INFINITY;
    *name = "R";
    if (!inputs_take(&s->in, IN_RADIUS) || !scene_get(s, IN_RADIUS, &of_both, error_quiet()) || R[0] == 0)
        return of_both;
    *name = fabs(R[0]) <= fabs(R[1]) ? "R1" : "R2";
    return fmin(fabs(R[0]), fabs(R[1]));
}

static void warn_half_space(shell *sh) {
    scene *s = &sh->calc.scene;
    fret_press press = {.a = 0};
    bool within = false;
    const char *name;
    long double slope = 0;
    const long double R = least_radius(s, &name);
    const bool wide = R < INFINITY && find_wide(s, &press, &within) && press.a > most_radius * R;
    if (inputs_take(&s->in, IN_SLOPE))
        scene_get(s, IN_SLOPE, &slope, error_quiet());
    if (is_new(sh, WIDE, wide))
        shell_warning(sh,
                      "a/%s = %.3g%s: beyond 0.3 the bodies are no half-spaces, and these results are "
                      "an approximation",
                      name, (double)(press.a / R), within ? " within the cycle" : "");
    if (is_new(sh, STEEP, slope > most_slope))
        shell_warning(sh,
                      "slope = %.3g: flanks steeper than 20 deg leave the half-space, and these "
                      "results are an "
                      "approximation",
                      (double)slope);
}

/* ---- stress ------------------------------------------------------------------------------------ */

static void warn_bulk(shell *sh) {
    long double sB = 0;
    scene_get(&sh->calc.scene, IN_SB, &sB, error_quiet());
    if (is_new(sh, BULK, sB != 0))
        shell_warning(sh, "a bulk stress shifts the stick zone, which is neglected: in the plane case by "
                          "a*sB/(4*mu*p0) (Nowell, Hills 1987)");
}

/* Notes that the stress exceeds the yield stress, where the bodies would deform plastically. again: bodies of
 * which this has been noted are checked, too. */
static void note_yield(shell *sh, bool again) {
    scene *s = &sh->calc.scene;
    const fret_press *press;
    const unsigned used = s->used;
    long double yield, most, at[2];
    char text[4][CALC_VALUE_TEXT];
    for (int body = 0; body < 2; body++) {
        const input in = body ? IN_YIELD_2 : IN_YIELD;
        const unsigned yields = (unsigned)YIELDS << body;
        if (!again && sh->warned & yields)
            continue;
        const bool may = (s->in.set[in] || s->in.bound[in]) && !(body && s->in.second == SECOND_RIGID) &&
                         scene_get(s, in, &yield, error_quiet()) && scene_press(s, &press, error_quiet()) &&
                         press->a > 0;
        if (!is_new(sh, yields, may && scene_hardest(s, press->a, body ? -1 : 1, at, &most) && most > yield))
            continue;
        calc_value_text((dim){1, -2, 0, 0}, (double)most, text[0]);
        calc_value_text((dim){1, -2, 0, 0}, (double)yield, text[1]);
        for (int i = 0; i < 2; i++)
            calc_amount(DIM_LENGTH, fabsl(at[i]) < 1e-4L * press->a ? 0 : at[i], 3, text[2 + i],
                        sizeof text[2 + i]);
        shell_note(sh,
                   "mises = %s exceeds %s = %s at x = %s, z = %s: the body yields there, which is neglected",
                   text[0], quantity_of_input(in)->name, text[1], text[2], text[3]);
    }
    s->used = used;
}

void shell_warn_load(shell *sh, const load_step *step) {
    if (step->tangential && !(sh->warned & DISSIMILAR))
        shell_warn_dissimilar(sh);
    note_yield(sh, false);
    if (step->normal != BY_NONE && !(sh->warned & (WIDE | STEEP)))
        warn_half_space(sh);
}

void shell_warn(shell *sh) {
    warn_bulk(sh);
    if (!sh->calc.scene.end.steps) {
        sh->warned &= BULK;
        return;
    }
    shell_warn_dissimilar(sh);
    warn_half_space(sh);
    note_yield(sh, true);
}
