/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shell/accuracy.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "shell/command.h"
#include "shell/output.h"

const char *const family_names[FAMILIES] = {"closed form",    "memory diagram", "quadrature",
                                            "loop area (21)", "springs",        "springs, midpoint"};
static const unsigned used[FAMILIES] = {USED_CLOSED, USED_MEMORY,  USED_QUADRATURE,
                                        USED_MEMORY, USED_SPRINGS, USED_SPRINGS};
static const char *const size_names[FAMILIES] = {"", "", "N", "M", "N", "N"};

/* Of the processor, so that a busy machine does no harm. */
static double cpu_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static const long double rounding = 4e-19L; /* no reference is better */

/* ---- the load ---------------------------------------------------------------------------------- */

/* One cycle at constant F_N: everything that its models need. */
typedef struct steady {
    const scene *s;
    fret_contact contact;
    bool by_force;
    double amplitude;
    fret_loading peak;
    /* one of the models */
    unsigned size;
    fret_memory *memory;
    fret_springs *springs;
} steady;

typedef struct bench {
    shell *sh;
    calc_error *error;
    accuracy_study *study;
    bool progress;      /* shown on the terminal */
    double budget, end; /* seconds of the processor; when it is spent */
    double enough;      /* seconds, to time one model */
} bench;

static bool stopped(calc_error *error) {
    if (!shell_stop)
        return false;
    error->stop = true;
    return !calc_fail(error, 0, 0, "interrupted");
}

static void describe_size(const accuracy_row *row, char *buf, size_t size) {
    buf[0] = 0;
    if (row->size)
        snprintf(buf, size, "%s = %lu", size_names[row->family], row->size);
}

static void show_progress(const bench *b, const accuracy_row *row) {
    char text[40];
    if (!b->progress)
        return;
    describe_size(row, text, sizeof text);
    fprintf(b->sh->err, "\rmeasuring %-17s %-11s", family_names[row->family], text);
    fflush(b->sh->err);
}

static void end_progress(const bench *b) {
    if (b->progress)
        fprintf(b->sh->err, "\r%*s\r", shell_stop ? 41 : 39, ""); /* the ^C, too */
}

/* ---- measuring --------------------------------------------------------------------------------- */

/* One cycle of a model; loss NULL: only for the time. */
typedef bool cycle_of(void *model, long double *loss, calc_error *error);

/* Enters a row: the value of the first cycle, the time of as many as it takes to measure it. */
static bool measure(bench *b, model_family family, unsigned long size, cycle_of *cycle, void *model) {
    accuracy_study *study = b->study;
    accuracy_row *row = &study->row[study->count];
    *row = (accuracy_row){.family = family, .size = size};
    show_progress(b, row);
    double start = cpu_now();
    if (!cycle(model, &row->value, b->error))
        return false;
    row->seconds = cpu_now() - start;
    for (unsigned long count = 1; row->seconds * (double)count < b->enough;) {
        count = row->seconds * 4 * (double)count < b->enough ? 4 * count
                                                             : (unsigned long)(b->enough / row->seconds) + 1;
        start = cpu_now();
        for (unsigned long i = 0; i < count; i++)
            if (stopped(b->error) || !cycle(model, NULL, b->error))
                return false;
        row->seconds = (cpu_now() - start) / (double)count;
    }
    row->error = fabsl(row->value / study->value - 1);
    row->below = row->error <= study->agreement;
    if (row->below)
        row->error = study->agreement;
    study->count++;
    b->sh->calc.scene.used |= used[family];
    return !stopped(b->error);
}

/* The next model of this kind has ten times the size and takes ten times as long to set up and to run,
 * twice at least. Is there time for it? Small ones are always measured. */
static bool affords(const bench *b, double setting_up) {
    const accuracy_row *last = &b->study->row[b->study->count - 1];
    double next = 10 * (setting_up + 2 * last->seconds);
    return (last->family != FAMILY_LOOP && last->size < 1000) || cpu_now() + next < b->end;
}

/* ---- models of a cycle at constant F_N --------------------------------------------------------- */

static fret_status closed_loss(const steady *m, long double *out) {
    return m->by_force ? fret_cycle_loss_by_force(&m->contact, m->amplitude, out)
                       : fret_cycle_loss_by_displacement(&m->contact, m->amplitude, out);
}

static fret_status find_peak(steady *m) {
    return m->by_force ? fret_loading_by_force(&m->contact, m->amplitude, &m->peak)
                       : fret_loading_by_displacement(&m->contact, m->amplitude, &m->peak);
}

/* What has been checked by closed_loss cannot fail for its arguments. */
static bool closed_cycle(void *model, long double *loss, calc_error *error) {
    long double unused;
    (void)error;
    closed_loss(model, loss ? loss : &unused);
    return true;
}

static bool quadrature_cycle(void *model, long double *loss, calc_error *error) {
    steady *m = model;
    long double unused;
    (void)error;
    find_peak(m);
    fret_quadrature_loss(&m->contact, &m->peak, m->size, loss ? loss : &unused);
    return true;
}

static fret_step step_to(const steady *m, double part) {
    return (fret_step){FRET_KEEP_NORMAL, m->by_force ? FRET_TO_FX : FRET_TO_DX, 0, part * m->amplitude};
}

static bool memory_cycle(void *model, long double *loss, calc_error *error) {
    steady *m = model;
    long double sum = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        fret_step step = step_to(m, sign);
        fret_status st = fret_memory_step(m->memory, &step);
        if (!scene_status(m->s, error, &st))
            return false;
        sum += fret_memory_last_loss(m->memory);
    }
    if (loss)
        *loss = sum;
    return true;
}

/* Each branch in m->size steps of a harmonic load. */
static bool loop_cycle(void *model, long double *loss, calc_error *error) {
    const double pi = 3.14159265358979323846;
    steady *m = model;
    fret_state last, now;
    long double area = 0;
    fret_memory_forces(m->memory, &last);
    for (unsigned i = 1; i <= 2 * m->size; i++) {
        double part = i == m->size ? -1 : i == 2 * m->size ? 1 : cos(pi * i / m->size);
        fret_step step = step_to(m, part);
        fret_status st = fret_memory_step(m->memory, &step);
        if (!scene_status(m->s, error, &st) || stopped(error))
            return false;
        fret_memory_forces(m->memory, &now);
        area += (now.dx - last.dx) * (now.Fx + last.Fx) / 2;
        last = now;
    }
    if (loss)
        *loss = area;
    return true;
}

/* mu F_N may be a rounding short of the amplitude. */
static fret_step springs_to(const steady *m, int sign) {
    fret_step step = step_to(m, sign);
    double limit = (double)(m->contact.mu * m->contact.press.F * (1 - 1e-16L));
    if (m->by_force)
        step.tangential = sign * fmin(m->amplitude, limit);
    return step;
}

static bool springs_cycle(void *model, long double *loss, calc_error *error) {
    steady *m = model;
    fret_state from, to;
    if (loss)
        fret_springs_state(m->springs, &from);
    for (int sign = -1; sign <= 1; sign += 2) {
        fret_step step = springs_to(m, sign);
        fret_status st = fret_springs_step(m->springs, &step, 1);
        if (!scene_status(m->s, error, &st) || stopped(error))
            return false;
    }
    if (loss) {
        fret_springs_state(m->springs, &to);
        *loss = to.W - from.W;
    }
    return true;
}

/* The memory diagram pressed and taken to the first turning point. */
static bool memory_rows(bench *b, steady *m) {
    fret_step press = {FRET_TO_FORCE, FRET_KEEP_DX, (double)m->contact.press.F, 0}, up = step_to(m, 1);
    fret_status st = fret_memory_make(m->contact.normal, m->contact.mu, &m->memory);
    if (!st.code)
        st = fret_memory_step(m->memory, &press);
    if (!st.code)
        st = fret_memory_step(m->memory, &up);
    bool ok = scene_status(m->s, b->error, &st) && measure(b, FAMILY_MEMORY, 0, memory_cycle, m);
    for (m->size = 10; ok && m->size <= 10000; m->size *= 10) {
        ok = measure(b, FAMILY_LOOP, m->size, loop_cycle, m);
        if (ok && !affords(b, 0))
            break;
    }
    fret_memory_free(m->memory);
    return ok;
}

/* Pressed and taken to the first turning point. */
static fret_status springs_ready(steady *m, unsigned count, double radius, fret_weight rule) {
    fret_step press = {FRET_TO_FORCE, FRET_KEEP_DX, (double)m->contact.press.F, 0}, up = springs_to(m, 1);
    fret_status st = fret_springs_make(m->contact.normal, m->contact.mu, count, radius, rule, &m->springs);
    if (st.code)
        return st;
    st = fret_springs_step(m->springs, &press, 1);
    if (!st.code)
        st = fret_springs_step(m->springs, &up, 1);
    if (st.code)
        fret_springs_free(m->springs);
    return st;
}

/* With midpoint weights some stiffness is missing where k < 0: the contact that carries F_N is wider. Where
 * the gap ends before, or is beyond all numbers, there are no such springs. */
static bool springs_rows(bench *b, steady *m, model_family family) {
    bool ok = true, midpoint = family == FAMILY_MIDPOINT;
    fret_weight rule = midpoint ? FRET_WEIGHT_MIDPOINT : FRET_WEIGHT_CELL;
    unsigned wider = midpoint && fret_normal_foundation(m->contact.normal)->k < 0 ? 2 : 1;
    for (unsigned count = 100; ok && count <= 1000000; count *= 10) {
        double start = cpu_now();
        show_progress(b, &(accuracy_row){.family = family, .size = count});
        fret_status st = springs_ready(m, wider * count, wider * (double)m->contact.press.a, rule);
        if (st.code && fret_status_category(st.code) != FRET_CAT_SYSTEM)
            break;
        if (!scene_status(m->s, b->error, &st))
            return false;
        double setting_up = cpu_now() - start;
        ok = measure(b, family, count, springs_cycle, m);
        fret_springs_free(m->springs);
        if (ok && !affords(b, setting_up))
            break;
    }
    return ok;
}

static bool measure_steady(bench *b, steady *m) {
    accuracy_study *study = b->study;
    fret_status st = m->by_force ? fret_reference_loss_by_force(&m->contact, m->amplitude, &study->value,
                                                                &study->agreement)
                                 : fret_reference_loss_by_displacement(&m->contact, m->amplitude,
                                                                       &study->value, &study->agreement);
    if (!st.code)
        st = find_peak(m);
    if (!scene_status(m->s, b->error, &st))
        return false;
    if (!isfinite((double)study->value)) {
        st.code = FRET_OVERFLOW;
        return scene_status(m->s, b->error, &st);
    }
    if (!(study->value > 0)) /* a general gap, and less slip than a long double tells from none */
        return calc_fail(b->error, 0, 0, "the load is too small: no model of this gap can tell dW from 0");
    study->agreement = fmaxl(study->agreement, rounding);
    snprintf(study->reference, sizeof study->reference, "quadrature in long double");
    study->automatic =
        fret_normal_is_power(m->contact.normal) ? "closed form" : "closed form, with quadrature over the gap";
    study->why = "constant FN";
    bool ok = measure(b, FAMILY_CLOSED, 0, closed_cycle, m) && memory_rows(b, m);
    for (m->size = 16; ok && m->size <= 128; m->size *= 2)
        ok = measure(b, FAMILY_QUADRATURE, m->size, quadrature_cycle, m);
    b->end -= b->budget / 4; /* kept for the last */
    ok = ok && springs_rows(b, m, FAMILY_SPRINGS);
    b->end += b->budget / 4;
    /* at k = 0 the weights are the same */
    return ok && (fret_normal_foundation(m->contact.normal)->k == 0 || springs_rows(b, m, FAMILY_MIDPOINT));
}

/* ---- models of any other load program ---------------------------------------------------------- */

typedef struct general {
    cycle_run *run;
    bool loop;
} general;

static bool general_cycle(void *model, long double *loss, calc_error *error) {
    general *g = model;
    return cycle_run_period(g->run, g->loop ? NULL : loss, g->loop ? loss : NULL, error);
}

/* more: is there time for one that is larger? */
static bool general_row(bench *b, model_family family, unsigned long size, unsigned springs, unsigned parts,
                        bool *more) {
    general g = {.loop = family == FAMILY_LOOP};
    double start = cpu_now();
    show_progress(b, &(accuracy_row){.family = family, .size = size});
    if (!cycle_run_open(&b->sh->calc.scene, springs, parts, &g.run, b->error))
        return false;
    double setting_up = cpu_now() - start;
    bool ok = measure(b, family, size, general_cycle, &g);
    cycle_run_close(g.run);
    *more = ok && affords(b, setting_up);
    return ok;
}

static bool refined(bench *b, unsigned parts, long double *loss) {
    cycle_run *run;
    if (!cycle_run_open(&b->sh->calc.scene, 0, parts, &run, b->error))
        return false;
    bool ok = cycle_run_period(run, loss, NULL, b->error);
    cycle_run_close(run);
    return ok;
}

static bool measure_general(bench *b) {
    const scene *s = &b->sh->calc.scene;
    const load_step *cycle = scene_last_cycle(s);
    accuracy_study *study = b->study;
    bool swings = cycle->normal_value != 0;
    unsigned chords = !swings ? 2 : cycle->points ? cycle->points : 200;
    long double coarse;
    if (!refined(b, 4, &coarse) || !refined(b, 8, &study->value))
        return false;
    if (!(study->value > 0))
        return calc_fail(b->error, 0, 0, "nothing slips in the last cycle: dW is 0");
    study->agreement = fmaxl(fabsl(study->value - coarse) / study->value, rounding);
    snprintf(study->reference, sizeof study->reference, "memory diagram, straight steps cut in 8");
    study->automatic = "memory diagram";
    study->why = swings ? "FN swings" : "FN has changed on the way";
    bool more, ok = general_row(b, FAMILY_MEMORY, 0, 0, 0, &more);
    unsigned factor = swings ? 4 : 10;
    for (unsigned parts = swings ? 1 : 10, i = 0; ok && more && i < 4; parts *= factor, i++)
        ok = general_row(b, FAMILY_LOOP, parts * (unsigned long)chords / 2, 0, parts, &more);
    more = true;
    for (unsigned count = 100; ok && more && count <= 1000000; count *= 10)
        ok = general_row(b, FAMILY_SPRINGS, count, count, 0, &more);
    return ok;
}

/* ---- the command ------------------------------------------------------------------------------- */

static bool read_amplitude(shell *sh, lexer *lx, accuracy_load *out) {
    argument a;
    if (!at_argument(lx))
        return !lx->error->raised;
    if (!read_argument(sh, lx, &a))
        return false;
    out->by_force = argument_is(&a, "FA");
    if (a.increment || !(out->by_force || argument_is(&a, "dxA")))
        return unknown_argument(lx, &a, command_find("accuracy", 8));
    if (!argument_dim(lx, &a, out->by_force ? DIM_FORCE : DIM_LENGTH))
        return false;
    out->amplitude = (double)a.v.v;
    out->at = a.value_at, out->len = a.value_len;
    fret_status st = {a.v.v > 0 ? FRET_OK : FRET_NOT_POSITIVE, out->by_force ? "FA" : "dxA", out->amplitude,
                      0};
    if (scene_status(&sh->calc.scene, lx->error, &st))
        return true;
    lx->error->at = out->at, lx->error->len = out->len;
    return false;
}

static bool read_seconds(shell *sh, lexer *lx, double *out) {
    size_t at = lx->at;
    value v;
    if (!expr_value(&sh->calc, lx, &v))
        return false;
    *out = (double)v.v;
    return (dim_equal(v.d, DIM_NONE) && v.v > 0 && v.v <= 3600) ||
           calc_fail(lx->error, at, lx->last - at, "the seconds must be a positive number up to 3600");
}

bool accuracy_read(shell *sh, lexer *lx, accuracy_load *out) {
    *out = (accuracy_load){.by_force = true, .seconds = 3};
    return read_amplitude(sh, lx, out) && (!lex_accept(lx, "within") || read_seconds(sh, lx, &out->seconds));
}

/* The amplitude from the load program where none is given. `program`: that is to be run as it is. */
static bool choose_load(shell *sh, const accuracy_load *given, steady *m, bool *program, char *text,
                        calc_error *error) {
    scene *s = &sh->calc.scene;
    const fret_press *press;
    const char *from = "";
    *program = false;
    *m = (steady){.s = s, .by_force = given->by_force, .amplitude = given->amplitude};
    if (!scene_press(s, &press, error) || !scene_normal(s, &m->contact.normal, error) ||
        !scene_friction(s, &m->contact.mu, error))
        return false;
    const load_step *cycle = scene_last_cycle(s);
    if (!given->len && cycle) {
        m->by_force = cycle->tangential == BY_FORCE;
        m->amplitude = cycle->tangential_value;
        *program = s->normal_varies;
        from = ", the last cycle";
    } else if (!given->len) {
        const fret_state *state;
        if (!scene_state(s, &state, error))
            return false;
        m->amplitude = fabs((double)state->Fx);
        from = ", that of the last step: no cycle has been run";
        if (!(m->amplitude > 0)) {
            m->amplitude = m->contact.mu * (double)press->F / 2;
            from = ", half of mu*FN: no cycle has been run";
        }
    }
    char amplitude[160], FN[160];
    format_value(sh, (value){m->amplitude, m->by_force ? DIM_FORCE : DIM_LENGTH}, amplitude,
                 sizeof amplitude);
    format_value(sh, (value){press->F, DIM_FORCE}, FN, sizeof FN);
    const char *name = m->by_force ? "FA" : "dxA";
    if (*program)
        snprintf(text, ACCURACY_TEXT, "%s = %s%s of the load program", name, amplitude, from);
    else
        snprintf(text, ACCURACY_TEXT, "%s = %s at FN = %s%s", name, amplitude, FN, from);
    /* the models that take a double all get the same one */
    fret_status st = fret_press_by_force(m->contact.normal, (double)press->F, &m->contact.press);
    if (!st.code && !*program)
        st = closed_loss(m, &(long double){0});
    if (scene_status(s, error, &st))
        return true;
    error->at = given->at, error->len = given->len;
    return false;
}

bool accuracy_measure(shell *sh, const accuracy_load *load, accuracy_study *out, calc_error *error) {
    steady m;
    bool program;
    *out = (accuracy_study){.count = 0};
    if (!choose_load(sh, load, &m, &program, out->load, error))
        return false;
    bench b = {.sh = sh,
               .error = error,
               .study = out,
               .progress = sh->err == stderr && isatty(STDERR_FILENO),
               .budget = load->seconds,
               .end = cpu_now() + load->seconds,
               .enough = fmin(0.02, load->seconds / 150)};
    bool ok = program ? measure_general(&b) : measure_steady(&b, &m);
    end_progress(&b);
    return ok;
}

static double fastest(const accuracy_study *study) {
    double least = study->row[0].seconds;
    for (size_t i = 1; i < study->count; i++)
        least = fmin(least, study->row[i].seconds);
    return least;
}

static void format_ratio(double ratio, char *buf, size_t size) {
    snprintf(buf, size, ratio < 999.5 ? "%.3g" : "%.0f", ratio);
}

static void format_seconds(double t, char *buf, size_t size) {
    static const char *const units[] = {"s", "ms", "us", "ns"};
    int i = 0;
    for (; i < 3 && t < 0.9995; i++)
        t *= 1e3;
    snprintf(buf, size, "%.3g %s", t, units[i]);
}

/* A bound is rounded up. */
static void format_error(const accuracy_row *row, char *buf, size_t size) {
    double e = (double)row->error;
    if (row->below) {
        double place = pow(10, floor(log10(e)));
        snprintf(buf, size, "<%.0e", ceil(e / place * (1 - 1e-9)) * place);
    } else {
        snprintf(buf, size, "%.1e", e);
    }
}

/* The first of the springs that err by 1e-6 at most, or the best. */
static const accuracy_row *good_springs(const accuracy_study *study) {
    const accuracy_row *best = NULL;
    for (size_t i = 0; i < study->count; i++)
        if (study->row[i].family == FAMILY_SPRINGS &&
            (!best || (best->error > 1e-6L && study->row[i].error < best->error)))
            best = &study->row[i];
    return best;
}

/* What the springs pay, a separator, and what auto picks and why. */
static void advise(const accuracy_study *study, const char *separator, char *buf, size_t size) {
    const accuracy_row *row = &study->row[0], *springs = good_springs(study); /* auto's choice comes first */
    char error[40], t[40], ratio[40];
    int n = 0;
    if (springs) {
        format_error(springs, error, sizeof error);
        format_seconds(springs->seconds, t, sizeof t);
        bool slower = springs->seconds >= row->seconds;
        format_ratio(slower ? springs->seconds / row->seconds : row->seconds / springs->seconds, ratio,
                     sizeof ratio);
        n = snprintf(buf, size, "%lu springs: error %s in %s, %s times as %s as auto%s", springs->size, error,
                     t, ratio, slower ? "long" : "fast", separator);
    }
    format_error(row, error, sizeof error);
    format_seconds(row->seconds, t, sizeof t);
    if (n >= 0 && (size_t)n < size)
        snprintf(buf + n, size - (size_t)n, "auto picks: %s (%s): error %s in %s", study->automatic,
                 study->why, error, t);
}

static void print_text(shell *sh, const accuracy_study *study, const char *advice) {
    char unit_text[COLUMN_UNIT], head[COLUMN_UNIT + 8];
    long double scale = unit_choose(DIM_ENERGY, study->value, sh->set.digits, unit_text, sizeof unit_text);
    int width = sh->set.digits + 7;
    accuracy_row bound = {.error = study->agreement, .below = true};
    char error[40], parameter[40], t[40], ratio[40];
    format_error(&bound, error, sizeof error);
    fprintf(sh->out, "%s\nreference: %s, %.*g %s, good to %s\n", study->load, study->reference,
            sh->set.digits, (double)(study->value / scale), unit_text, error + 1);
    snprintf(head, sizeof head, "dW [%s]", unit_text);
    fprintf(sh->out, "%-18s %12s %*s %9s %10s %10s\n", "model", "parameter", width, head, "error",
            "time/cycle", "x fastest");
    for (size_t i = 0; i < study->count; i++) {
        const accuracy_row *row = &study->row[i];
        describe_size(row, parameter, sizeof parameter);
        format_error(row, error, sizeof error);
        format_seconds(row->seconds, t, sizeof t);
        format_ratio(row->seconds / fastest(study), ratio, sizeof ratio);
        fprintf(sh->out, "%-18s %12s %*.*g %9s %10s %10s\n", family_names[row->family], parameter, width,
                sh->set.digits, (double)(row->value / scale), error, t, ratio);
    }
    fprintf(sh->out, "%s\n", advice);
}

static void print_csv(shell *sh, const accuracy_study *study) {
    fputs("model,parameter,value [J],error,error is a bound,seconds,ratio\n", sh->out);
    for (size_t i = 0; i < study->count; i++) {
        const accuracy_row *row = &study->row[i];
        const char *quote = strchr(family_names[row->family], ',') ? "\"" : "";
        fprintf(sh->out, "%s%s%s,%lu,%.17g,%.3g,%d,%.3g,%.3g\n", quote, family_names[row->family], quote,
                row->size, (double)row->value, (double)row->error, row->below, row->seconds,
                row->seconds / fastest(study));
    }
}

static void print_json(shell *sh, const accuracy_study *study, const char *advice) {
    for (size_t i = 0; i < study->count; i++) {
        const accuracy_row *row = &study->row[i];
        fputs("{\"model\":", sh->out);
        print_json_string(sh->out, family_names[row->family]);
        fprintf(sh->out,
                ",\"parameter\":%lu,\"value\":%.17g,\"error\":%.3g,\"bound\":%s,\"seconds\":%.3g,\"ratio\":%."
                "3g}\n",
                row->size, (double)row->value, (double)row->error, row->below ? "true" : "false",
                row->seconds, row->seconds / fastest(study));
    }
    fputs("{\"advice\":", sh->out);
    print_json_string(sh->out, advice);
    fputs(",\"auto\":", sh->out);
    print_json_string(sh->out, study->automatic);
    fputs(",\"load\":", sh->out);
    print_json_string(sh->out, study->load);
    fputs(",\"reference\":", sh->out);
    print_json_string(sh->out, study->reference);
    fprintf(sh->out, ",\"value\":%.17g,\"agreement\":%.3g}\n", (double)study->value,
            (double)study->agreement);
}

bool do_accuracy(shell *sh, lexer *lx) {
    accuracy_study study;
    accuracy_load load;
    char advice[ACCURACY_TEXT];
    if (!accuracy_read(sh, lx, &load) || !at_end(lx) || !accuracy_measure(sh, &load, &study, lx->error))
        return false;
    advise(&study, sh->set.format == FORMAT_TEXT ? "\n" : "; ", advice, sizeof advice);
    if (sh->set.format == FORMAT_CSV)
        print_csv(sh, &study);
    else if (sh->set.format == FORMAT_JSON)
        print_json(sh, &study, advice);
    else
        print_text(sh, &study, advice);
    return true;
}
