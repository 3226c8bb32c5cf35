/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A blade on its friction damper: the frequency response of a mass on a spring and a contact, in two ways.
 *
 *        m x'' + k x + F_x = P cos(omega t),    F_N constant
 *
 * Harmonic balance, from a table of K'(d) and K''(d) as `export harmonic` writes it: x = d cos(omega t - psi)
 * has F_x = K' d cos - K'' d sin of that angle, and so
 *
 *        (k + K' - m omega^2)^2 + K''^2 = (P/d)^2,    tan psi = K''/(k + K' - m omega^2):
 *
 * each amplitude of the table is reached at two frequencies, or at none. Time integration by velocity Verlet,
 * two calls of the library a step, from there on until the motion has settled. The difference is what one
 * harmonic leaves out: 1 % at most, where the response is steep, below the resonance and close to gross slip,
 * and 0.3 % above it; a quarter of the time step moves it by 0.08 % at most.
 *
 *     fret -c 'material E0=114 GPa nu=0.34 k=0.2 c0=0.1 mm; geometry sphere R=20 mm; friction 0.35
 *              press FN=25 N; export harmonic to harmonic.csv for dxA = 0.2 um .. 0.98 um steps 13'
 *     cc -std=c11 -O2 -Iinclude -o oscillator scripts/oscillator.c build/libfret.a -lm
 *     ./oscillator harmonic.csv
 *
 * scripts/python/examples/oscillator.py is the same in Python. */
#include <fret/fret.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;
static const double mass = 1, stiffness = 10e6, force = 4; /* [kg], [N/m], [N] */
enum { STEPS = 200, PERIODS = 60 };

static void need(fret_status st) {
    char text[200];
    if (!st.code)
        return;
    fret_status_text(&st, text, sizeof text);
    fprintf(stderr, "oscillator: %s\n", text);
    exit(EXIT_FAILURE);
}

static double contact_force(fret_contact *contact, double x) {
    fret_state now;
    need(fret_contact_step(contact, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, x}));
    fret_contact_forces(contact, &now);
    return (double)now.Fx;
}

/* The first and the third harmonic of the motion in the last period. */
typedef struct motion {
    double first, third;
} motion;

/* From the peak x = d on; the force is psi ahead of the motion. */
static motion integrate(fret_contact *contact, double d, double omega, double psi) {
    const double dt = 2 * pi / omega / (double)STEPS;
    double x = d, v = 0, sum[2][2] = {{0, 0}, {0, 0}};
    fret_contact_reset(contact);
    need(fret_contact_step(contact, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 25, 0}));
    double acceleration = (force * cos(psi) - stiffness * x - contact_force(contact, x)) / mass;
    for (int i = 1; i <= PERIODS * STEPS; i++) {
        const double angle = 2 * pi * i / (double)STEPS;
        v += dt / 2 * acceleration;
        x += dt * v;
        acceleration = (force * cos(angle + psi) - stiffness * x - contact_force(contact, x)) / mass;
        v += dt / 2 * acceleration;
        for (int h = 0; h < 2 && i > (PERIODS - 1) * STEPS; h++) {
            sum[h][0] += 2 * x * cos((2 * h + 1) * angle) / (double)STEPS;
            sum[h][1] += 2 * x * sin((2 * h + 1) * angle) / (double)STEPS;
        }
    }
    return (motion){hypot(sum[0][0], sum[0][1]), hypot(sum[1][0], sum[1][1])};
}

/* On one side of the resonance, where the amplitude is reached there. */
static void respond(fret_contact *contact, double d, double Kp, double Kpp, int side) {
    const double rest = side * sqrt(force / d * (force / d) - Kpp * Kpp),
                 square = (stiffness + Kp + rest) / mass;
    if (!(square > 0))
        return;
    const motion m = integrate(contact, d, sqrt(square), atan2(Kpp, -rest));
    printf("%.9g,%.9g,%.9g,%.3g,%.3g\n", sqrt(square) / (2 * pi), d, m.first, m.first / d - 1,
           m.third / m.first);
}

int main(int argc, char **argv) {
    const fret_material graded = {
        .body = {{.E0 = 114e9, .nu = 0.34}, {.E0 = 114e9, .nu = 0.34}}, .k = 0.2, .c0 = 1e-4};
    const fret_gap sphere = {
        .kind = FRET_GAP_POWER, .terms = 1, .power = {{.n = 2, .h = 1 / (2 * 20e-3), .r0 = 1}}};
    FILE *table = fopen(argc == 2 ? argv[1] : "harmonic.csv", "r");
    fret_normal *normal;
    fret_contact *contact;
    char line[200];
    double d, Kp, Kpp;
    if (!table) {
        perror("oscillator: a table of export harmonic");
        return EXIT_FAILURE;
    }
    need(fret_normal_make(&graded, &sphere, NULL, NULL, &normal));
    need(fret_contact_make(normal, 0.35, FRET_EXACT, &contact));
    puts("frequency [Hz],by harmonic balance [m],by time [m],difference,third harmonic");
    while (fgets(line, sizeof line, table))
        if (sscanf(line, "%lf,%lf,%lf", &d, &Kp, &Kpp) == 3)
            for (int side = -1; side <= 1; side += 2)
                respond(contact, d, Kp, Kpp, side);
    fclose(table);
    fret_contact_free(contact);
    fret_normal_free(normal);
    return EXIT_SUCCESS;
}
