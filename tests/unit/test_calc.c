/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The small parts of the language, and what memory that runs out leaves of it: each allocation of a statement
 * fails once. The Makefile links this program so that the language allocates through the functions here. */
#include <errno.h>
#include <float.h>
#include <math.h>
#include <sys/time.h>

#include "failing.h"
#include "language.h"

/* ---- words, characters, units ------------------------------------------------------------------- */

static void words(void) {
    CHECK(same_but_case("fn", "FN") && same_but_case("Fn", "fN") && same_but_case("x_1", "X_1"));
    CHECK(!same_but_case("fn", "fnx") && !same_but_case("fnx", "fn") && !same_but_case("fn", "fm"));
    /* pairs that differ by the same bit and are no letters */
    CHECK(!same_but_case("@", "`") && !same_but_case("[", "{") && !same_but_case("0", "\x10"));
    CHECK(one_letter_apart("slope", "slpoe") && one_letter_apart("slope", "slop"));
    CHECK(one_letter_apart("slope", "sloper") && !one_letter_apart("slope", "lsopr"));
    static const char lengthy[] = "a word of more letters than are ever compared";
    CHECK(!one_letter_apart(lengthy, "a word") && !one_letter_apart("a word", lengthy));
    CHECK(!quantity_name(WORDS) && !builtin_name(WORDS)); /* tables that an index can hold */
}

static void characters(void) {
    unsigned code = 7;
    CHECK(character_at("", 0, &code) == 0 && code == 7);
    CHECK(character_at("\xe2\x82\xac", 3, &code) == 3 && code == 0x20ac);
    CHECK(character_at("\xe2\x82\xac", 2, &code) == 0 && character_at("a", 1, NULL) == 1);
    CHECK(character_before("a\xe2\x82\xac", 4) == 1 && character_before("a\xe2\x82", 3) == 1);
    char put[CHARACTER_BYTES];
    static const unsigned codes[] = {0x24, 0x7f, 0x80, 0x7ff, 0x800, 0x28ff, 0xffff, 0x10000, 0x10ffff};
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        const size_t n = character_put(codes[i], put);
        CHECK(strlen(put) == n && character_at(put, n, &code) == n && code == codes[i]);
    }
    CHECK(character_before("ab", 2) == 1 && character_before("ab", 0) == 0);
    static const struct {
        const char *text;
        size_t count, columns;
    } rows[] = {{"", 0, 0},
                {"ab", 2, 2},
                {"\xce\xbcm", 2, 2},
                {"\xe5\xa5\xb3\xef\xbc\x91", 2, 4}, /* of East Asia */
                {"e\xcc\x81", 2, 1},                /* an accent of its own */
                {"\xf0\x9f\x98\x80", 1, 2},
                {"\xff\xe5\xa5", 3, 3},      /* no UTF-8 */
                {"\x1b\xe2\x80\xae", 2, 2}}; /* shown in another way */
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        CHECK(character_count(rows[i].text, strlen(rows[i].text)) == rows[i].count);
        CHECK(text_columns(rows[i].text, strlen(rows[i].text)) == rows[i].columns);
    }
}

static void rows(void) {
    static const struct {
        const char *text;
        size_t columns, row, rest; /* bytes */
    } rows[] = {{"", 5, 0, 0},
                {"ab cd", 5, 5, 0},
                {"ab cd", 4, 2, 2},
                {"ab   cd", 3, 2, 2},
                {"ab cd", 2, 2, 2},
                {"abcd", 3, 3, 1},
                {"  ab", 3, 0, 2},
                {"\xe5\xa5\xb3", 1, 3, 0}, /* at least a character */
                {"a\xe5\xa5\xb3 b", 2, 1, 5}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *text = rows[i].text;
        size_t rest = strlen(text);
        CHECK(text_break(&text, &rest, rows[i].columns) == rows[i].row && rest == rows[i].rest);
        CHECK(text + rest == rows[i].text + strlen(rows[i].text));
    }
}

/* Those at the ends of what is hidden. */
static void hidden(void) {
    static const unsigned from[][2] = {
        {0x7f, 0x9f},     {0xad, 0xad},     {0x61c, 0x61c},   {0x200b, 0x200f}, {0x2028, 0x202e},
        {0x2060, 0x206f}, {0xfe00, 0xfe0f}, {0xfeff, 0xfeff}, {0xfff0, 0xfffb}, {0xe0000, 0xe0fff}};
    for (size_t i = 0; i < sizeof from / sizeof *from; i++) {
        CHECK(character_shows(from[i][0] - 1) && !character_shows(from[i][0]));
        CHECK(!character_shows(from[i][1]) && character_shows(from[i][1] + 1));
    }
}

static void units(void) {
    char text[128];
    dim_unit(DIM_FORCE, text, sizeof text);
    CHECK(!strcmp(text, "N"));
    dim_unit(DIM_STIFFNESS, text, 3); /* no more than there is room for */
    CHECK(!strcmp(text, "N/"));
    CHECK(unit_choose(DIM_LENGTH, 2.5e-6L, 6, text, sizeof text) == 1e-6L && !strcmp(text, "um"));
    const long double none[] = {0, (long double)INFINITY, (long double)NAN, 1e-12L, 1e12L};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        CHECK(unit_choose(DIM_LENGTH, none[i], 6, text, sizeof text) == 1 && !strcmp(text, "m"));
    for (int digits = 1; digits <= 17;
         digits++) /* nothing is printed as 1000 of a unit that has a larger one */
        for (int exponent = -6; exponent <= 9; exponent += 3)
            for (int off = -2; off <= 2; off++) {
                const double tie = (double)(powl(10, exponent) * (1 - 5 * powl(10, -digits - 1))),
                             v = tie * (1 + off * DBL_EPSILON);
                const long double scale = unit_choose(DIM_LENGTH, v, digits, text, sizeof text);
                snprintf(text, sizeof text, "%.*g", digits, (double)(v / scale));
                CHECK(strtod(text, NULL) < 1000);
            }
}

static void ranges(void) {
    static const double never[] = {INFINITY, -INFINITY, NAN};
    for (input in = 0; in < INPUTS; in++)
        for (size_t i = 0; i < sizeof never / sizeof *never; i++)
            CHECK_CODE(input_status(in, never[i]), FRET_NOT_FINITE);
    CHECK_OK(input_status(IN_NU, 0.5));
    CHECK_CODE(input_status(IN_NU, -1), FRET_BAD_NU);
    CHECK_CODE(input_status(IN_K, 1), FRET_BAD_K);
    CHECK_OK(input_status(IN_FNA, 0));
    CHECK_CODE(input_status(IN_FNA, -1), FRET_NEGATIVE);
    CHECK_OK(input_status(IN_MU, 0));
    CHECK_CODE(input_status(IN_MU, -1), FRET_NEGATIVE);
    CHECK_CODE(input_status(IN_P0, 0), FRET_NOT_POSITIVE);
    inputs none = {.geometry = NULL};
    for (input in = 0; in < INPUTS; in++)
        CHECK(!inputs_take(&none, in));
}

/* ---- errors ------------------------------------------------------------------------------------- */

/* What is raised first stays. */
static void first_errors(void) {
    static const fret_status late = {FRET_NEGATIVE, "FA", -1, 0}, fine = {FRET_OK, NULL, 0, 0};
    calc_raise(fresh(), 3, 1, "the %s", "first");
    CHECK(!calc_missing(&error, IN_FN) && !calc_input_status(&error, IN_MU, late));
    CHECK(!calc_no_memory(&error) && error.stop && calc_input_status(&error, IN_MU, fine));
    CHECK(!calc_errno(&error, EACCES, "cannot %s", "write") && error.refused && error.stop);
    CHECK(error.kind == ERROR_WORDS && !strcmp(error.text, "the first") && error.at == 3 &&
          error.input == -1);
    CHECK(!calc_errno(fresh(), ENOMEM, "cannot %s", "write") && error.stop);
    CHECK(!strcmp(error.text, "cannot write: out of memory"));
}

/* Statuses that the library raises and the language does not. */
static void wordings(void) {
    static const struct {
        fret_status status;
        const char *text;
    } rows[] = {
        {{FRET_OUTSIDE, "points", 4, 8}, "points = 4 lies outside the range of the function (limit 8)"},
        {{FRET_OUTSIDE, "dx", 3e-6, 0}, "dx = 3 um lies outside the range of the function"},
        {{FRET_NO_MEMORY, NULL, 0, 0}, "out of memory"}};
    calc c;
    calc_init(&c, NULL);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        calc_status(fresh(), rows[i].status);
        calc_word(&c, &error);
        if (!CHECK(!strcmp(error.text, rows[i].text)))
            printf("%s\n", error.text);
    }
    calc_free(&c);
}

/* ---- statements --------------------------------------------------------------------------------- */

static bool evaluate(calc *c, const char *text, calc_value *out) {
    lexer lx;
    lex_start(&lx, text, strlen(text), fresh());
    return expr_value(c, &lx, out);
}

static double value_of(calc *c, const char *text) {
    calc_value v;
    return evaluate(c, text, &v) ? (double)v.v : (double)NAN;
}

/* Expressions of as many nodes as make room for more at each kind of them. */
static void expressions(void) {
    enum { MOST = 40 };
    static const struct {
        const char *first, *again, *last;
        double value[3]; /* of 1, 2 and MOST times */
    } rows[] = {{"1", "+1", "", {2, 3, 1 + MOST}},
                {"1", "*1", "", {1, 1, 1}},
                {"2", "^1", "", {2, 2, 2}},
                {"1", "*-1", "", {-1, 1, 1}},
                {"F(1)", "+F(1)", "", {2, 3, 1 + MOST}},
                {"min(3, 4", ", 2", ")", {2, 2, 2}},
                {"sqrt(1)", "*x", "", {3, 9, 12157665459056928801.0}},
                {"(F(x) at x=5)", "+(F(x) at x=1)", "", {26, 27, 25 + MOST}},
                {"abs(1)", "+1*(x at x=1)", "", {2, 3, 1 + MOST}}};
    calc c;
    calc_value v;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int times = 1; times <= MOST; times++) {
            char text[1000];
            strcpy(text, rows[i].first);
            for (int j = 0; j < times; j++)
                strcat(text, rows[i].again);
            strcat(text, rows[i].last);
            calc_init(&c, NULL); /* no room yet */
            CHECK(assign(&c, "x = 3") && assign(&c, "F(y) := y^2"));
            EACH_FAILS(0, (expr_free(&c.scratch), evaluate(&c, text, &v)),
                       out_of_memory(&c) && value_of(&c, "x") == 3);
            if (times < 3 || times == MOST)
                CHECK_REL(v.v, (fret_real)rows[i].value[times < 3 ? times - 1 : 2], 1e-15L);
            calc_free(&c);
        }
}

static void assignments(void) {
    static const char *const names[] = {"p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8", "p9",
                                        "q1", "q2", "q3", "q4", "q5", "q6", "q7", "q8", "q9"};
    calc c;
    calc_init(&c, NULL);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) { /* of which one needs room for more of them */
        char text[40];
        snprintf(text, sizeof text, "%s := 2*1", names[i]);
        const size_t before = c.undo.count;
        EACH_FAILS(2, assign(&c, text),
                   out_of_memory(&c) && c.undo.count == before && isnan(value_of(&c, names[i])));
        CHECK(value_of(&c, names[i]) == 2);
    }
    /* a name that only a sweep gives */
    for (size_t i = 0; i < 40; i++) {
        char text[40];
        knob k;
        lexer lx;
        snprintf(text, sizeof text, "s%zu", i);
        EACH_FAILS(0, (lex_start(&lx, text, strlen(text), fresh()), knob_read(&c, &lx, &k)),
                   out_of_memory(&c) && !c.note[0]);
        CHECK(!k.is_input && !strcmp(k.text, text));
    }
    calc_free(&c);
}

/* The state now, and the displacement of the springs in the middle. */
typedef struct place {
    fret_state state;
    fret_real u;
} place;

static place place_of(calc *c) {
    const fret_state *state = NULL;
    const fret_contact *memory = NULL;
    place out = {.u = (fret_real)NAN};
    if (CHECK(scene_state(c->now, &state, fresh()) && scene_straight(c->now, &memory, fresh())))
        out = (place){*state, fret_contact_displacement(memory, 0)};
    return out;
}

static bool same(place x, place y) {
    const fret_state *a = &x.state, *b = &y.state;
    return a->FN == b->FN && a->dz == b->dz && a->Fx == b->Fx && a->dx == b->dx && a->W == b->W &&
           a->U == b->U && x.u == y.u;
}

/* Cycles that swing F_N as a sine, by displacement or to the brink of gross slip in chords: what fails leaves
 * the state as it was, and what comes after is the same as where nothing has failed. */
static void loads(bool turned) {
    static const struct {
        double FA, FNA, phase;
        unsigned by;
    } cycles[] = {{20, 50, 0, BY_FORCE},          {8, 8, 1, BY_FORCE},
                  {12, 30, 1, BY_FORCE},          {5, 0, 0, BY_FORCE},
                  {2e-7, 10, 1, BY_DISPLACEMENT}, {3, 9, 2, BY_FORCE}};
    calc c, whole;
    press_steel(&c, NULL, 0);
    press_steel(&whole, NULL, 0);
    for (int i = 0; turned && i < 30; i++) { /* many slices to be kept */
        const load_step step = {.kind = LOAD_STEP,
                                .tangential = BY_FORCE,
                                .tangential_value = (30 - i) * (i % 2 ? -1 : 1),
                                .points = 1};
        CHECK(load(&c, step, (cycle_extra){0}) && load(&whole, step, (cycle_extra){0}));
    }
    for (size_t i = turned; i < sizeof cycles / sizeof *cycles; i++) {
        const load_step cycle = {.kind = LOAD_CYCLE,
                                 .tangential = (unsigned char)cycles[i].by,
                                 .tangential_value = cycles[i].FA,
                                 .normal_value = cycles[i].FNA};
        const cycle_extra extra = {.times = 2, .phase = cycles[i].phase};
        const place before = place_of(&c);
        EACH_FAILS(0, load(&c, cycle, extra), out_of_memory(&c) && same(place_of(&c), before));
        CHECK(load(&whole, cycle, extra) && same(place_of(&c), place_of(&whole)));
    }
    calc_free(&c);
    calc_free(&whole);
}

/* W of the scene with another friction at each instant, the last of them. */
static bool along_beside(calc *c, double *W) {
    calc_error why;
    trial_along a;
    error_clear(&why);
    error_clear(&error);
    trial *t = trial_open(c, &why);
    bool ok = t && trial_along_begin(&a, t, ALONG_CYCLE, c->now->end, 4, false, &why);
    if (ok) {
        while (ok && trial_along_next(&a, &why)) {
            calc_value v;
            ok = evaluate(c, "(W at mu=0.5)", &v);
            if (ok)
                *W = (double)v.v;
        }
        trial_along_end(&a);
    }
    if (t)
        trial_close(t);
    if (why.raised)
        error = why;
    return ok && !why.raised;
}

/* Another scene along a swinging load, whatever allocation fails. */
static void scenes_beside(void) {
    const load_step cycle = {
        .kind = LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 9, .normal_value = 10};
    calc c;
    double want, W;
    press_steel(&c, NULL, 0);
    CHECK(load(&c, cycle, (cycle_extra){.times = 1}));
    const place before = place_of(&c);
    CHECK(along_beside(&c, &want) && want > 0);
    EACH_FAILS(20, along_beside(&c, &W), out_of_memory(&c) && same(place_of(&c), before));
    CHECK(W == want);
    calc_free(&c);
}

/* What is refused on the way leaves no other way of reckoning behind. */
static void refusals(void) {
    static const load_step
        sine = {.kind = LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 12, .normal_value = 30},
        refused[] = {{.kind = LOAD_CYCLE,
                      .tangential = BY_DISPLACEMENT,
                      .tangential_value = 2e-7,
                      .normal_value = 200},
                     {.kind = LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 39, .normal_value = 30},
                     {.kind = LOAD_STEP, .tangential = BY_FORCE, .tangential_value = 1000, .points = 1},
                     {.kind = LOAD_STEP,
                      .normal = BY_FORCE,
                      .normal_value = -1,
                      .tangential = BY_DISPLACEMENT,
                      .tangential_value = 1e-7,
                      .points = 1}};
    static const cycle_extra twice = {.times = 2, .phase = 1};
    calc c;
    press_steel(&c, NULL, 0);
    for (int swung = 0; swung < 2; swung++) {
        const place before = place_of(&c);
        for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
            CHECK(!load(&c, refused[i], twice) && same(place_of(&c), before));
        CHECK(swung || load(&c, sine, twice));
    }
    calc_free(&c);
}

/* ---- names -------------------------------------------------------------------------------------- */

/* Names that begin alike stay apart. */
static void alike_names(void) {
    enum { NAMES = 300 };
    char text[NAMES + 1];
    own_names n = {.row = NULL};
    size_t at;
    memset(text, 'q', NAMES);
    text[NAMES] = 0;
    for (size_t len = NAMES; len > 0; len--)
        CHECK(names_add(&n, text, len, &at) && at == NAMES - len && !n.row[at].known);
    for (size_t len = 1; len <= NAMES; len++) {
        CHECK(!names_find(&n, text, len, &at) && names_add(&n, text, len, &at) && at == NAMES - len);
        names_put(&n, at, (calc_value){(long double)len, DIM_NONE}, NULL);
        CHECK(names_find(&n, text, len, &at) && n.row[at].v.v == len);
    }
    names_free(&n);
}

/* Live definitions as deep as they may be, and one deeper. */
static void deep_names(void) {
    calc c;
    calc_value v;
    calc_init(&c, NULL);
    CHECK(assign(&c, "w0 = 1"));
    for (int i = 1; i <= CHAIN; i++) {
        char text[40];
        snprintf(text, sizeof text, "w%d := w%d + 1", i, i - 1);
        CHECK(assign(&c, text));
    }
    CHECK(value_of(&c, "w100") == 101);
    CHECK(assign(&c, "w101 := w100 + 1"));
    CHECK(!strcmp(c.note, "w101 has no value so far: live definitions are nested more than 100 deep"));
    CHECK(!evaluate(&c, "w101", &v) && value_of(&c, "w100") == 101);
    CHECK(assign(&c, "e = 1") && assign(&c, "w0 := e")); /* which makes w100 deeper */
    CHECK(!evaluate(&c, "w100", &v) && !strcmp(error.text, "live definitions are nested more than 100 deep"));
    CHECK(value_of(&c, "w99") == 100 && assign(&c, "w0 = 1") && value_of(&c, "w100") == 101);
    /* each is looked into once */
    CHECK(assign(&c, "f0(x) := x"));
    for (int i = 1; i <= 60; i++) {
        char text[60];
        snprintf(text, sizeof text, "f%d(x) := f%d(x) + f%d(x)", i, i - 1, i - 1);
        CHECK(assign(&c, text));
    }
    /* a circle through all of them: as much of the way as a message bears */
    CHECK(!assign(&c, "w0 := w100") && strlen(error.text) < sizeof error.text);
    CHECK(!strncmp(error.text, "a circle of definitions: w0 -> w100 -> w99 -> ", 46));
    CHECK(strstr(error.text, " -> w66 -> ... -> w0") && !strstr(error.text, "w65"));
    CHECK(value_of(&c, "w100") == 101);
    calc_free(&c);
}

/* ---- along a load ------------------------------------------------------------------------------- */

/* How often it can be looked at, and the last time. */
static int looks_along(trial *t, along_what what, size_t points, double *last) {
    trial_along a;
    int seen = 0;
    CHECK(trial_along_begin(&a, t, what, t->scene.end, points, true, fresh()));
    for (; trial_along_next(&a, &error); seen++) {
        CHECK(!seen || scene_time(&t->scene) > *last - 1e-9);
        *last = scene_time(&t->scene);
    }
    trial_along_end(&a);
    CHECK(!error.raised && !t->scene.now);
    return seen;
}

static void along(void) {
    calc c;
    double last = 0;
    press_steel(&c, NULL, 0);
    for (int i = 0; i < 30; i++)
        CHECK(load(
            &c,
            (load_step){.kind = LOAD_STEP, .tangential = BY_FORCE, .tangential_value = i % 7, .points = 1},
            (cycle_extra){0}));
    const fret_state *now;
    CHECK(scene_state(c.now, &now, fresh()));
    trial *t = trial_open(&c, fresh());
    CHECK(looks_along(t, ALONG_PROGRAM, 10, &last) == 31 && last == 30);
    trial_close(t);
    /* the last cycle alone, with its turning points, of a load that goes on */
    CHECK(load(&c, (load_step){.kind = LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 12},
               (cycle_extra){.times = 2}));
    CHECK(load(&c, (load_step){.kind = LOAD_STEP, .tangential = BY_FORCE, .tangential_value = 3, .points = 1},
               (cycle_extra){0}));
    t = trial_open(&c, fresh());
    const int seen = looks_along(t, ALONG_CYCLE, 5, &last);
    CHECK_REL(last, 32.25L, 1e-12L);
    CHECK(seen == 7 || seen == 8);
    trial_close(t);
    calc_free(&c);
}

/* An input that the shape has not is refused. */
static void trials(void) {
    calc c;
    press_steel(&c, NULL, 0);
    trial *t = trial_open(&c, fresh());
    const knob slope = {.is_input = true, .in = IN_SLOPE, .text = "slope"};
    CHECK(!trial_set(t, &slope, 0.1L, fresh()));
    calc_word(&c, &error);
    CHECK(strstr(error.text, "slope is no parameter of geometry sphere"));
    CHECK(!t->scene.in.set[IN_SLOPE] && c.now == &t->scene);
    trial_close(t);
    calc_free(&c);
}

/* Each quantity has a formula that holds always, its last: the search for one needs no other end. */
static void formulas(void) {
    for (size_t i = 0; quantity_row(i); i++) {
        const formula *f = quantity_row(i)->formulas;
        size_t n = 0;
        while (n < FORMULAS && f[n].text)
            n++;
        CHECK(n > 0 && f[n - 1].when == WHEN_ALWAYS);
    }
}

/* ---- the flag that stops ------------------------------------------------------------------------ */

static volatile sig_atomic_t rung;

static void ring(int number) {
    (void)number;
    rung = 1;
}

/* Interrupted sooner or later: an answer is the one of an undisturbed call, or there is none. */
static void interrupted(void) {
    static quantity_call_function *const all[] = {call_Kp, call_loss_factor};
    calc c;
    press_steel(&c, &rung, 60); /* rows, too few for pieces, which would be fast */
    signal(SIGALRM, ring);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const calc_value dxA = {5e-7L, DIM_LENGTH};
        long double want, got = 0;
        int refused = 0;
        rung = 0;
        CHECK(all[i](c.now, dxA, &want, fresh()));
        for (double wait = 2e-6; refused < 1000; wait *= 1.1, refused++) {
            const struct itimerval at = {
                .it_value = {.tv_sec = (time_t)wait, .tv_usec = (suseconds_t)(1e6 * fmod(wait, 1))}};
            setitimer(ITIMER_REAL, &at, NULL);
            const bool ok = all[i](c.now, dxA, &got, fresh());
            setitimer(ITIMER_REAL, &(struct itimerval){.it_value = {0}}, NULL);
            const bool late = !rung;
            rung = 0;
            CHECK(ok ? got == want : error.kind == ERROR_STATUS && error.status.code == FRET_INTERRUPTED);
            if (late)
                break;
        }
        CHECK(refused > 0 && refused < 1000);
    }
    calc_free(&c);
}

/* ---- the way back ------------------------------------------------------------------------------- */

/* Where the oldest entries have gone, steps since the oldest that is left can still be taken off. */
static void far_back(void) {
    static const load_step slide = {
        .kind = LOAD_STEP, .tangential = BY_DISPLACEMENT, .tangential_value = 1e-7, .points = 1};
    calc c;
    press_steel(&c, NULL, 0);
    size_t taken = 0;
    for (int i = 0; i < 2001; i++) {
        char text[20];
        snprintf(text, sizeof text, "x = %d", i);
        undo_begin(&c);
        CHECK(assign(&c, text));
        undo_end(&c);
        if (i == 999 || i == 1500)
            CHECK(load(&c, slide, (cycle_extra){0}));
    }
    CHECK(c.now->end.steps == 3 && c.undo.count == 1001);
    while (calc_undo(&c))
        taken++;
    /* 1001 values, and both steps: the first of them came after the last value that is forgotten */
    CHECK(taken == 1003 && c.now->end.steps == 1 && value_of(&c, "x") == 999);
    calc_free(&c);
}

/* Levels whose error goes with the square of a chord, or with its fourth power, have the limit that they come
 * to; how far it may be off is no less than what the header says. */
static void limits(void) {
    const long double square[LEVELS] = {2.64L, 2.16L, 2.04L}, fourth[LEVELS] = {4.56L, 2.16L, 2.01L};
    long double moved;
    CHECK_REL(run_limit(square, &moved), 2, UNIT_TOL(1e-18L, 1e-15L));
    CHECK(moved < 1e-15L);
    CHECK_REL(run_unsure(square), 0.12L / 256 / 2.04L, UNIT_TOL(1e-14L, 1e-12L));
    CHECK_REL(run_limit(fourth, &moved), 2, UNIT_TOL(1e-18L, 1e-15L));
    CHECK_REL(moved, 0.08L / 2.01L, UNIT_TOL(1e-16L, 1e-13L));
    CHECK_REL(run_unsure(fourth), 1.2L / 2.01L, UNIT_TOL(1e-16L, 1e-13L));
}

int main(int argc, char **argv) {
    unit_start("test_calc", argc, argv);
    CASE(words());
    CASE(characters());
    CASE(rows());
    CASE(hidden());
    CASE(units());
    CASE(ranges());
    CASE(first_errors());
    CASE(wordings());
    CASE(expressions());
    CASE(assignments());
    CASE(loads(false));
    CASE(loads(true));
    CASE(scenes_beside());
    CASE(refusals());
    CASE(alike_names());
    CASE(deep_names());
    CASE(along());
    CASE(trials());
    CASE(formulas());
    CASE(interrupted());
    CASE(far_back());
    CASE(limits());
    return unit_finish();
}
