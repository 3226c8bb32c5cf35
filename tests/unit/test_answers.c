/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What follows from a scene, asked anew where memory runs out at each allocation, where it is interrupted at
 * once, and where a live definition has no value any more: it is refused, and the next time answered to the
 * last digit as ever. The Makefile links this program so that the language allocates through the functions
 * here. */
#include "failing.h"
#include "language.h"
#include "scene/engine.h"

static volatile sig_atomic_t stop;

/* ---- questions ---------------------------------------------------------------------------------- */

enum { VALUES = 4 };

static bool ask_press(scene *s, double v[VALUES]) {
    const fret_press *p;
    if (!scene_press(s, &p, fresh()))
        return false;
    v[0] = (double)p->F;
    v[1] = (double)p->dz;
    v[2] = (double)p->a;
    return true;
}

static bool ask_FN(scene *s, double v[VALUES]) {
    long double FN;
    if (!scene_FN(s, &FN, fresh()))
        return false;
    v[0] = (double)FN;
    return true;
}

static bool ask_contact(scene *s, double v[VALUES]) {
    fret_pressed c;
    fret_real loss = 0;
    if (!scene_contact(s, &c, fresh()))
        return false;
    if (c.press.F > 0) {
        fret_status st = fret_cycle_loss_by_force(&c, 1, &loss);
        if (!calc_status(&error, st))
            return false;
    }
    v[0] = (double)c.mu;
    v[1] = (double)c.press.a;
    v[2] = (double)loss;
    return true;
}

static bool take(const fret_state *state, double v[VALUES]) {
    v[0] = (double)state->FN;
    v[1] = (double)state->Fx;
    v[2] = (double)state->dx;
    v[3] = (double)state->W;
    return true;
}

static bool ask_state(scene *s, double v[VALUES]) {
    const fret_state *state;
    return scene_state(s, &state, fresh()) && take(state, v);
}

static bool ask_memory(scene *s, double v[VALUES]) {
    const fret_contact *m;
    if (!scene_straight(s, &m, fresh()))
        return false;
    v[0] = (double)fret_contact_displacement(m, 0);
    return true;
}

static bool ask_first(scene *s, double v[VALUES]) {
    fret_loading l;
    if (!scene_closed_state(s))
        return calc_fail(fresh(), 0, 0, "not closed");
    if (!scene_first_loading(s, &l, fresh()))
        return false;
    v[0] = (double)l.Fx;
    v[1] = (double)l.dx;
    v[2] = (double)l.c;
    return true;
}

static bool ask_loss(scene *s, double v[VALUES]) {
    long double loss;
    if (!scene_cycle_loss(s, &loss, fresh()))
        return false;
    v[0] = (double)loss;
    return true;
}

static bool ask_trace(scene *s, double v[VALUES]) {
    scene_trace t;
    run_view now;
    if (!trace_begin(&t, s, watch_points(100), true, fresh()))
        return false;
    while (trace_next(&t, &error)) {
        run_view_now(t.run, t.levels, &now);
        v[0] += (double)now.state.dx * trace_now(&t)->time;
        v[1] += (double)now.state.W;
        v[2]++;
    }
    trace_end(&t);
    return !error.raised;
}

/* Of a copy of a scene whose program is known to run to its end. */
static bool ask_sound(scene *s, double v[VALUES]) {
    s->sound = true;
    const bool ok = ask_trace(s, v);
    s->sound = false;
    return ok;
}

static bool ask_places(scene *s, double v[VALUES]) {
    static const calc_value r = {1e-6L, {0, 1, 0, 0}};
    long double slip, shift, traction, pressure;
    if (!call_s1D(s, r, &slip, fresh()) || !call_u1D(s, r, &shift, &error) ||
        !quantity_call(quantity_find("qx", 2), s, &r, &traction, &error) ||
        !quantity_call(quantity_find("p", 1), s, &r, &pressure, &error))
        return false;
    CHECK(fabsl(traction) <= (s->in.v[IN_MU] + 1e-9L) * pressure);
    v[0] = (double)slip;
    v[1] = (double)shift;
    v[2] = (double)traction;
    v[3] = (double)pressure;
    return true;
}

/* dF_N/d delta_z at each instant: of a sphere 3 F_N/(2 delta_z). */
static bool ask_stiffness(scene *s, double v[VALUES]) {
    scene_trace t;
    bool ok = true;
    if (!trace_begin(&t, s, watch_points(3), false, fresh()))
        return false;
    while (ok && trace_next(&t, &error)) {
        const instant now = {.run = t.run, .levels = t.levels};
        const fret_state *state;
        long double kn = 0;
        s->now = &now;
        scene_moved(s);
        ok = get_kn(s, &kn, &error) && scene_state(s, &state, &error);
        if (ok && s->in.geometry == geometry_find("sphere") && state->dz > 0)
            CHECK_REL(kn, 1.5L * state->FN / state->dz, 1e-15L);
        s->now = NULL;
        scene_moved(s);
        v[0] += (double)kn * (1 + now.run->time);
        v[1]++;
    }
    trace_end(&t);
    return ok && !error.raised;
}

enum { CONTACT = 2, STATE = 3 }; /* of these */
static const struct {
    const char *what;
    bool (*ask)(scene *s, double v[VALUES]);
} questions[] = {
    {"press", ask_press},   {"FN", ask_FN},         {"contact", ask_contact},    {"state", ask_state},
    {"memory", ask_memory}, {"first", ask_first},   {"loss", ask_loss},          {"trace", ask_trace},
    {"sound", ask_sound},   {"places", ask_places}, {"stiffness", ask_stiffness}};

/* ---- scenes ------------------------------------------------------------------------------------- */

typedef struct scened {
    const char *what;
    bool rows;      /* instead of the sphere */
    load_step then; /* after the press */
    double phase;
    model_id model;
    bool open; /* and lifted off at last */
} scened;

#define FORCE(kind, Fx, FN)                                                                                  \
    { kind, .tangential = BY_FORCE, .tangential_value = Fx, .normal_value = FN, .points = 1 }
static const scened scenes[] = {
    {.what = "press", .model = MODEL_AUTO},
    {.what = "step", .then = FORCE(LOAD_STEP, 20, 0), .model = MODEL_AUTO},
    {.what = "cycle", .then = FORCE(LOAD_CYCLE, 20, 0), .model = MODEL_AUTO},
    {.what = "sine", .then = FORCE(LOAD_CYCLE, 12, 30), .model = MODEL_AUTO},
    {.what = "chords",
     .then = {LOAD_CYCLE, .tangential = BY_DISPLACEMENT, .tangential_value = 2e-7, .normal_value = 10},
     .phase = 1,
     .model = MODEL_AUTO},
    {.what = "by memory", .then = FORCE(LOAD_CYCLE, 20, 0), .model = MODEL_MEMORY},
    {.what = "by springs", .then = FORCE(LOAD_CYCLE, 12, 0), .model = MODEL_SPRINGS},
    {.what = "by springs, swinging", .then = FORCE(LOAD_CYCLE, 12, 30), .model = MODEL_SPRINGS},
    {.what = "by closed forms", .then = FORCE(LOAD_CYCLE, 12, 30), .model = MODEL_CLOSED},
    {.what = "rows", .rows = true, .then = FORCE(LOAD_STEP, 20, 0), .model = MODEL_AUTO},
    {.what = "rows, open", .rows = true, .then = FORCE(LOAD_STEP, 20, 0), .model = MODEL_AUTO, .open = true},
};

static bool loaded(calc *c, const load_step *step, double phase) {
    return load(c, *step, (cycle_extra){.times = 1, .phase = phase});
}

static void begin(calc *c, const scened *of) {
    static const load_step lift = {.kind = LOAD_STEP, .normal = BY_FORCE, .points = 1};
    press_steel(c, &stop, of->rows ? 12 : 0);
    if (of->then.kind != LOAD_PRESS)
        CHECK(loaded(c, &of->then, of->phase));
    if (of->open)
        CHECK(loaded(c, &lift, 0));
    CHECK(assign(c, "x = 100 N") && assign(c, "FN := x") && assign(c, "y = 0.4") && assign(c, "mu := y"));
    if (of->then.kind == LOAD_CYCLE && of->then.tangential == BY_FORCE)
        CHECK(assign(c, of->then.tangential_value == 20 ? "z = 20 N" : "z = 12 N") && assign(c, "FA := z"));
    else
        CHECK(assign(c, "z = 1"));
    scene_set_model(c->now, of->model, 40);
}

/* ---- trouble ------------------------------------------------------------------------------------ */

static bool again(scene *s, size_t i, double v[VALUES]) {
    scene_forget(s);
    for (int j = 0; j < VALUES; j++)
        v[j] = 0;
    return questions[i].ask(s, v);
}

static bool as_ever(scene *s, size_t i, const double want[VALUES]) {
    double v[VALUES];
    return again(s, i, v) && !memcmp(v, want, sizeof v);
}

/* But for a last digit. */
static bool alike(const double v[VALUES], const double want[VALUES]) {
    for (int i = 0; i < VALUES; i++)
        if (!(v[i] == want[i] || fabs(v[i] - want[i]) <= 4e-16 * fabs(want[i])))
            return false;
    return true;
}

/* Some does without what it could not have: what it then goes by agrees to 2e-15. */
static void starve(calc *c, size_t i, const double want[VALUES]) {
    bool failed = true;
    for (int n = 0; failed && n < 1000; n = unit_next(n)) {
        double v[VALUES];
        left = n;
        const bool ok = again(c->now, i, v);
        failed = left < 0;
        left = -1;
        CHECK(ok ? alike(v, want) : failed && out_of_memory(c));
        CHECK(as_ever(c->now, i, want));
    }
    CHECK(!failed);
}

/* Closed forms do not look. */
static void interrupt(calc *c, size_t i, const double want[VALUES]) {
    double v[VALUES];
    stop = 1;
    const bool ok = again(c->now, i, v);
    stop = 0;
    CHECK(ok ? !memcmp(v, want, sizeof v)
             : error.kind == ERROR_STATUS && error.status.code == FRET_INTERRUPTED);
    CHECK(as_ever(c->now, i, want));
}

/* mu may be 0. */
static bool is_lost(void) {
    return strstr(error.text, "must be positive") || strstr(error.text, "must not be negative");
}

/* A name that a definition is made of; some answers do not hang on it. */
static void lose(calc *c, const char *name, size_t i, const double want[VALUES]) {
    size_t at = 0;
    double v[VALUES];
    CHECK(names_find(&c->names, name, strlen(name), &at));
    const calc_value before = c->names.row[at].v;
    c->names.row[at].v.v = -1;
    if (!again(c->now, i, v)) {
        calc_word(c, &error);
        CHECK(is_lost() || !strcmp(error.text, "not closed"));
    }
    c->names.row[at].v = before;
    CHECK(as_ever(c->now, i, want));
}

/* ---- loads -------------------------------------------------------------------------------------- */

/* A scene that knows nothing yet of what follows; which is the same after what is refused. */
static void loads(const scened *of, const load_step *then, bool lost) {
    double before[VALUES], want[VALUES], v[VALUES];
    bool failed = true;
    calc whole;
    begin(&whole, of);
    CHECK(again(whole.now, STATE, before) && loaded(&whole, then, 0));
    CHECK(ask_state(whole.now, want));
    calc_free(&whole);
    for (int n = 0; failed && n < 1000; n = unit_next(n)) {
        size_t at = 0;
        calc c;
        begin(&c, of);
        scene_forget(c.now);
        CHECK(names_find(&c.names, n % 2 ? "x" : "y", 1, &at));
        const calc_value good = c.names.row[at].v;
        if (lost)
            c.names.row[at].v.v = -1;
        else
            left = n;
        const bool ok = loaded(&c, then, 0);
        failed = lost ? n < 1 : left < 0;
        left = -1;
        c.names.row[at].v = good;
        if (!ok)
            calc_word(&c, &error);
        CHECK(ok || (lost ? is_lost() : strstr(error.text, "out of memory") != NULL));
        CHECK(ok ? ask_state(c.now, v) && !memcmp(v, want, sizeof v) : as_ever(c.now, STATE, before));
        calc_free(&c);
    }
    CHECK(!failed);
}

static void more_loads(const scened *of) {
    static const load_step then[] = {FORCE(LOAD_STEP, 5, 0),
                                     FORCE(LOAD_CYCLE, 10, 0),
                                     {LOAD_STEP, .normal = BY_FORCE, .normal_value = 90,
                                      .tangential = BY_FORCE, .tangential_value = 5, .points = 1},
                                     {LOAD_PRESS, .normal = BY_FORCE, .normal_value = 90}};
    for (size_t i = 0; i < sizeof then / sizeof *then; i++) {
        loads(of, &then[i], false);
        if (then[i].kind != LOAD_PRESS)
            loads(of, &then[i], true);
    }
}

/* Many steps at once, of which whoever asks takes back what is refused. */
static void rows_of_loads(bool forgotten) {
    static const double FN[] = {90, 95, 80}, Fx[] = {10, -5, 12};
    static const load_step step = {.kind = LOAD_STEP, .normal = BY_FORCE, .tangential = BY_FORCE};
    const scened *of = &scenes[1];
    double want[VALUES], v[VALUES];
    bool failed = true;
    calc c;
    size_t row;
    begin(&c, of);
    for (int i = 0; i < 3; i++) {
        load_step one = step;
        one.normal_value = FN[i];
        one.tangential_value = Fx[i];
        one.points = 1;
        CHECK(loaded(&c, &one, 0));
    }
    CHECK(ask_state(c.now, want));
    calc_free(&c);
    for (int n = 0; failed && n < 1000; n++) {
        begin(&c, of);
        if (forgotten)
            scene_forget(c.now);
        left = n;
        const bool ok = scene_load_rows(c.now, step, FN, Fx, 3, &row, fresh());
        failed = left < 0;
        left = -1;
        CHECK(ok ? ask_state(c.now, v) && !memcmp(v, want, sizeof v) : out_of_memory(&c) && row < 3);
        calc_free(&c);
    }
    CHECK(!failed);
    begin(&c, of);
    CHECK(assign(&c, "mu := y") && names_find(&c.names, "y", 1, &row));
    c.names.row[row].v.v = -1;
    scene_forget(c.now);
    CHECK(!scene_load_rows(c.now, step, FN, Fx, 3, &row, fresh()) && row == 0);
    calc_word(&c, &error);
    CHECK(is_lost());
    calc_free(&c);
}

/* A step deeper than rows reach, and sideways, for which they are prepared as far as they do. */
static void too_deep(void) {
    static const load_step deep = {LOAD_STEP,
                                   .normal = BY_DISPLACEMENT,
                                   .normal_value = 1e-3,
                                   .tangential = BY_DISPLACEMENT,
                                   .tangential_value = 1e-7,
                                   .points = 1};
    double before[VALUES];
    calc c;
    begin(&c, &(scened){.rows = true, .model = MODEL_AUTO});
    CHECK(again(c.now, STATE, before) && !loaded(&c, &deep, 0));
    calc_word(&c, &error);
    CHECK(strstr(error.text, "cannot be carried") && as_ever(c.now, STATE, before));
    calc_free(&c);
}

/* A displacement that sways while F_N swings farther than rows reach: its turns cannot be had there. */
static void swings_too_far(void) {
    static const load_step press = {LOAD_STEP, .normal = BY_FORCE, .normal_value = 9000, .points = 1},
                           cycle = {LOAD_CYCLE, .tangential = BY_DISPLACEMENT, .tangential_value = 1e-7,
                                    .normal_value = 8000};
    double before[VALUES];
    calc c;
    begin(&c, &(scened){.rows = true, .model = MODEL_AUTO});
    CHECK(loaded(&c, &press, 0) && again(c.now, STATE, before));
    CHECK(!loaded(&c, &cycle, 1.5));
    calc_word(&c, &error);
    CHECK(strstr(error.text, "cannot be carried") && as_ever(c.now, STATE, before));
    calc_free(&c);
}

/* A sum of powers with a steep one. */
static void too_steep(void) {
    const fret_gap sum = {.kind = FRET_GAP_SUM, .terms = 2, .power = {{2, 50, 1}, {100, 1e-6, 1e-4}}};
    double one[VALUES];
    fret_pressed contact;
    calc c;
    begin(&c, &(scened){.model = MODEL_AUTO});
    inputs_geometry(&c.now->in, geometry_find("sum"), &sum, NULL);
    CHECK(again(c.now, CONTACT, one));
    CHECK(scene_contact(c.now, &contact, fresh()) && (c.now->used & USED(MODEL_PIECES)));
    calc_free(&c);
}

/* Steps want friction. */
static void lacking(void) {
    double v[VALUES];
    calc c;
    begin(&c, &scenes[2]);
    scene_forget(c.now);
    inputs_unset(&c.now->in, INPUT_BIT(IN_MU));
    CHECK(!ask_state(c.now, v) && error.kind == ERROR_MISSING && error.input == IN_MU);
    calc_free(&c);
}

typedef struct last_look {
    fret_state state;
    int looks;
} last_look;

/* A step that nobody has run before it is looked at on its way. */
static bool watched(calc *c, const load_step *step, last_look *l) {
    scene_trace t;
    *l = (last_look){.looks = 0};
    CHECK(scene_append(c->now, step, NULL, fresh()));
    c->now->sound = true;
    if (!trace_begin(&t, c->now, watch_points(4), false, &error))
        return false;
    while (trace_next(&t, &error)) {
        engine_state(&trace_now(&t)->engine, &l->state);
        l->looks++;
    }
    trace_end(&t);
    return !error.raised;
}

/* Of periods that repeat only the last is looked at, after which all have been counted. */
static void repeats(double FNA) {
    scene_trace t;
    fret_state end, all;
    watch few = watch_path(5);
    int looks = 0;
    calc c;
    begin(&c,
          &(scened){.then = {LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 20, .normal_value = FNA},
                    .model = MODEL_AUTO});
    const load_step more = {LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 12, .normal_value = FNA};
    CHECK(load(&c, more, (cycle_extra){.times = 50, .phase = 1}));
    few.once = true;
    const bool begun = trace_begin(&t, c.now, few, false, fresh());
    CHECK(begun);
    while (begun && trace_next(&t, &error))
        looks += trace_now(&t)->time > scene_time(c.now) - 1;
    engine_state(&trace_now(&t)->engine, &end);
    CHECK(!error.raised && looks >= 10 && trace_now(&t)->time == scene_time(c.now));
    trace_end(&t);
    few.once = false;
    CHECK(trace_begin(&t, c.now, few, false, fresh()));
    while (trace_next(&t, &error))
        ;
    engine_state(&trace_now(&t)->engine, &all);
    CHECK(fabsl(end.W - all.W) <= 1e-12L * all.W && fabsl(end.dx - all.dx) <= 1e-12L * fabsl(all.dx));
    trace_end(&t);
    calc_free(&c);
}

/* On the way to a force by a displacement, and the other way round: into the open, and farther than rows
 * reach. */
static void on_the_way(void) {
    static const load_step open[] = {{LOAD_STEP, .normal = BY_FORCE, .normal_value = 0,
                                      .tangential = BY_DISPLACEMENT, .tangential_value = 1e-7, .points = 4},
                                     {LOAD_STEP, .normal = BY_DISPLACEMENT, .normal_value = 0,
                                      .tangential = BY_FORCE, .tangential_value = 0, .points = 4}},
                           deep[] = {{LOAD_STEP, .normal = BY_FORCE, .normal_value = 1e6,
                                      .tangential = BY_DISPLACEMENT, .tangential_value = 1e-7, .points = 4},
                                     {LOAD_STEP, .normal = BY_DISPLACEMENT, .normal_value = 1e-3,
                                      .tangential = BY_FORCE, .tangential_value = 5, .points = 4}};
    last_look l;
    calc c;
    for (int i = 0; i < 2; i++) {
        begin(&c, &(scened){.rows = true, .then = FORCE(LOAD_STEP, 20, 0), .model = MODEL_AUTO});
        CHECK(watched(&c, &open[i], &l) && l.looks >= 6);
        CHECK(l.state.FN == 0 && l.state.Fx == 0 && l.state.a == 0 && l.state.W > 0);
        calc_free(&c);
        begin(&c, &(scened){.rows = true, .then = FORCE(LOAD_STEP, 20, 0), .model = MODEL_AUTO});
        CHECK(!watched(&c, &deep[i], &l));
        calc_word(&c, &error);
        CHECK(strstr(error.text, "cannot be carried"));
        calc_free(&c);
    }
}

static bool as(const engine *e, const fret_state *want) {
    fret_state now;
    engine_state(e, &now);
    return now.FN == want->FN && now.Fx == want->Fx && now.dx == want->dx && now.W == want->W;
}

static bool copied(engine *to, const engine *from) {
    engine_end(to); /* from nothing: each of its parts is had anew */
    return !engine_copy(to, from).code;
}

/* A model with as many slices as are kept, before something swings and after: it is copied and shown, or it
 * is not and stays what it was. */
static void sine_without_memory(void) {
    const fret_material m = {.body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .c0 = 1e-3};
    const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 5e-5, 1e-3}}};
    const fret_sine load = {.FA = 5, .FNA = 20, .phase = 1, .FN = 100};
    engine e, copy = {.contact = NULL};
    fret_state now;
    CHECK_OK(engine_make(&e, unit_keep_normal(&m, &gap), 0.4));
    for (int i = 0; i < 60; i++) /* oblique, each steeper than the last: a slice each */
        CHECK_OK(engine_step(&e, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 1 + i, 1e-3 * i * i}));
    CHECK_OK(engine_step(&e, &(fret_step){FRET_TO_FORCE, FRET_TO_FX,
                                          (double)(load.FN + (fret_real)load.FNA * cosl(1)), load.FA}));
    e.sine = true;
    for (int swung = 0; swung < 2; swung++) {
        engine_state(&e, &now);
        EACH_FAILS(2, copied(&copy, &e), as(&e, &now));
        CHECK(as(&copy, &now));
        if (!swung)
            CHECK_OK(engine_swing(&e, &load, 0, 0.5));
    }
    fret_contact *chords = NULL;
    CHECK_OK(fret_contact_make(fret_contact_normal(e.contact), 0.4, FRET_EXACT, &chords));
    EACH_FAILS(1, !fret_contact_chords(chords, copy.contact).code, as(&copy, &now));
    fret_contact_free(chords);
    engine_end(&e);
    engine_end(&copy);
}

int main(int argc, char **argv) {
    unit_start("test_answers", argc, argv);
    int answered = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (size_t j = 0; j < sizeof questions / sizeof *questions; j++) {
            double want[VALUES];
            calc c;
            if (unit_skips(i + j))
                continue;
            const long failed = unit.failed;
            CASE(begin(&c, &scenes[i]));
            if (again(c.now, j, want)) { /* not all is asked of all: no loss without a cycle */
                answered++;
                CASE(starve(&c, j, want));
                CASE(interrupt(&c, j, want));
                CASE(lose(&c, "x", j, want));
                CASE(lose(&c, "y", j, want));
                CASE(lose(&c, "z", j, want));
            }
            calc_free(&c);
            if (unit.failed > failed)
                printf("%s: %s\n", scenes[i].what, questions[j].what);
        }
    CHECK(answered > unit_draws(80));
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        if (scenes[i].model == MODEL_AUTO && !scenes[i].open)
            CASE(more_loads(&scenes[i]));
    CASE(rows_of_loads(false));
    CASE(rows_of_loads(true));
    CASE(repeats(0));
    CASE(repeats(10));
    CASE(too_deep());
    CASE(swings_too_far());
    CASE(too_steep());
    CASE(lacking());
    CASE(on_the_way());
    CASE(sine_without_memory());
    return unit_finish();
}
