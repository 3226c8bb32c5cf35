/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of commands and of the holes in their grammar: the one file that names all handlers. main.c gives
 * it to statement/command.c, which looks commands up in it. */
#include "statement/command.h"

#include "commands/figures.h"
#include "commands/looks.h"
#include "commands/range.h"
#include "help/help.h"
#include "live/live.h"
#include "prompt/show.h"
#include "scene/presets.h"
#include "statement/scripts.h"
#include "statement/setting_table.h"

/* ---- holes ------------------------------------------------------------------------------------- */

static const char *off_name(size_t i) {
    return i == 0 ? "off" : NULL;
}

const hole_row holes[] = {
    {.name = "EXPR", .kind = HOLE_EXPR},
    {.name = "VALUES", .kind = HOLE_EXPR},
    {.name = "DEVIATION", .kind = HOLE_EXPR},
    {.name = "TERM", .kind = HOLE_EXPR},
    {.name = "HOW", .kind = HOLE_MAYBE},
    {.name = "LO", .kind = HOLE_SPAN},
    {.name = "NAME", .kind = HOLE_NAME},
    {.name = "INPUT", .kind = HOLE_INPUT},
    {.name = "MU", .kind = HOLE_VALUE, .noun = "mu"},
    {.name = "N", .kind = HOLE_COUNT},
    {.name = "SECONDS", .kind = HOLE_SECONDS},
    {.name = "COLUMN", .kind = HOLE_COLUMN},
    {.name = "TEXT", .kind = HOLE_TEXT},
    {.name = "CHOICES", .kind = HOLE_EXPR},
    {.name = "FILE", .kind = HOLE_FILE},
    {.name = "LOAD", .kind = HOLE_LOAD, .words = load_name},
    {.name = "MATERIAL", .kind = HOLE_CHOICE, .noun = "material", .words = preset_name},
    {.name = "BODY", .kind = HOLE_CHOICE, .noun = "material", .words = second_name},
    {.name = "AXES", .kind = HOLE_CHOICE, .words = axes_name},
    {.name = "OFF", .kind = HOLE_CHOICE, .words = off_name},
    {.name = "WORD", .kind = HOLE_WORD},
    {.name = "SHAPE", .kind = HOLE_CHOICE, .noun = "geometry", .words = geometry_name, .form = geometry_form},
    {.name = "MODEL", .kind = HOLE_CHOICE, .noun = "model", .words = export_name, .form = export_form},
    {.name = "PART", .kind = HOLE_CHOICE, .noun = "part", .words = show_name},
    {.name = "SETTING", .kind = HOLE_CHOICE, .noun = "setting", .words = setting_name, .form = setting_form},
    {.name = "SIZE", .kind = HOLE_WORD},
    {.name = "SWITCH", .kind = HOLE_CHOICE, .words = switch_name},
    {.name = "TERMINAL", .kind = HOLE_CHOICE, .noun = "terminal", .words = terminal_name},
    {.name = "LESSON", .kind = HOLE_WORD, .words = script_name},
    {.name = "TOPIC", .kind = HOLE_WORD, .words = help_name},
    {.name = "FIGURE", .kind = HOLE_WORD, .words = figure_word, .form = figure_form},
    {.name = "RANGE", .kind = HOLE_CLAUSES, .words = range_line},
    {.name = "LOOK", .kind = HOLE_CLAUSES, .words = look_line},
    {.name = NULL},
};

/* ---- help from tables -------------------------------------------------------------------------- */

static void presets_list(FILE *to) {
    const preset *p;
    char numbers[PRESET_NUMBERS];
    for (size_t i = 0; (p = preset_row(i)); i++) {
        preset_numbers(p, numbers);
        fprintf(to, "    %-17s %s\n", p->name, numbers);
    }
}

static void figures_list(FILE *to) {
    const figure *f;
    for (size_t i = 0; (f = figure_row(i)); i++)
        fprintf(to, "    %-12s %s\n", f->name, f->summary);
}

const command commands[] = {
    {.name = "material",
     .run = do_material,
     .group = "the bodies",
     .keywords = "steel aluminium Young elastic graded",
     .changes = true,
     .print = presets_list,
     .takes =
         "[MATERIAL] [E0:=210 GPa | G0:=80 GPa | G:=80 GPa | Estar:=115 GPa] [nu:=0.3] [k:=0.5] [c0:=1 mm] "
         "[E0_2:=70 GPa | G0_2:=26 GPa] [nu_2:=0.33]",
     .summary = "the elastic bodies",
     .help = "Sets E(z) = E0 (z/c0)^k and Poisson's ratio of both bodies. Without k the\n"
             "material is homogeneous and c0 is not needed. Arguments after a name from the\n"
             "list above override it (`material steel nu=0.28`); `help NAME` gives its source.\n"
             "The shear modulus G0 (or G) may replace E0; for k = 0 so may E* of both bodies,\n"
             "1/Estar = sum (1-nu^2)/E0 (Johnson, Contact Mechanics, 4.2), which is all that\n"
             "normal contact needs, not even nu.\n\n"
             "    fret> material E0=210 GPa nu=0.3 k=0.5 c0=1 mm\n"
             "    fret> E(0.25 mm), eta\n"
             "    E(0.25 mm) = 105 GPa\n"
             "    eta = 2.10754\n"
             "    fret> material Estar=115 GPa; geometry sphere D=20 mm; press p0=1 GPa; FN\n"
             "    FN = 39.0753 N\n"},
    {.name = "second",
     .run = do_second,
     .keywords = "other body",
     .changes = true,
     .takes = "[BODY] [E0:=70 GPa | G0:=26 GPa | G:=26 GPa] [nu:=0.33]",
     .summary = "the second body, if it differs from the first",
     .help =
         "The second body has the k and c0 of the first; by default it is the same. If the\n"
         "bodies are elastically dissimilar, normal and tangential contact are coupled.\n"
         "The coupling is neglected here, and a warning says so with tangential results.\n"
         "`help material` lists materials.\n\n"
         "    fret> material steel; second rigid; friction 0.3\n"
         "    fret> geometry sphere R=10 mm; press FN=100 N; a\n"
         "    a = 148.125 um\n"
         "    fret> dW(20 N)\n"
         "    dW(20 N) = 1.96943 uJ\n"
         "    warning: the bodies are elastically dissimilar (mismatch 0.286): the coupling of normal and "
         "tangential contact is neglected; kn is up to 2.9 % too small (dW: help limits)\n"},
    {.name = "geometry",
     .run = do_geometry,
     .keywords = "gap shape indenter sphere cone",
     .changes = true,
     .takes = "SHAPE ...",
     .summary = "the gap between the bodies",
     .help = "    fret> geometry cone angle=45 deg\n"
             "    fret> slope\n"
             "    slope = 1\n"},
    {.name = "friction",
     .run = do_friction,
     .keywords = "Coulomb mu",
     .changes = true,
     .takes = "MU",
     .summary = "the coefficient of friction",
     .help = "Sets mu, Coulomb's coefficient. `mu = 0.4` does the same. Normal contact needs\n"
             "no mu; with mu = 0 no Fx can be carried.\n\n"
             "    fret> friction 0.4\n"
             "    fret> mu\n"
             "    mu = 0.4\n"},
    {.name = "bulk",
     .run = do_bulk,
     .keywords = "stress fatigue tension sB sxx",
     .changes = true,
     .takes = "stress:=50 MPa | none",
     .summary = "a bulk stress along x in the first body",
     .help = "Adds sB to sxx in the first body, z >= 0, and so changes mises, tresca, sigma1\n"
             "and sigma3. It is an input: `sB = 50 MPa` does the same. Its effect on the\n"
             "contact, a shift of the stick zone, is neglected.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; press FN=100 N\n"
             "    fret> bulk stress=50 MPa\n"
             "    warning: a bulk stress shifts the stick zone, which is neglected: in the plane case "
             "by a*sB/(4*mu*p0) (Nowell, Hills 1987)\n"
             "    fret> sxx(a, 0 m, 0 m)/p0 at sB = 0 Pa\n"
             "    sxx(a, 0 m, 0 m)/p0 = 0.133333\n"
             "    fret> sxx(a, 0 m, 0 m)\n"
             "    sxx(a, 0 m, 0 m) = 232.784 MPa\n"},
    {.name = "wear",
     .run = do_wear,
     .keywords = "Archard energy law worn depth volume scar profile Fouvry Popov debris cycles lifetime",
     .changes = true,
     .takes = "alpha:=1e4 um^3/J | K=1e-4 H=2 GPa | cycles N:1000000000 | limit | none",
     .summary = "a wear law, and the gap after many cycles of fretting",
     .help = "The worn depth at r is alpha_w times friction's work per area dWdA(r) (Fouvry et\n"
             "al., Wear 255, 2003). Archard's V = K F_N s/H means alpha_w = K/(mu H), which\n"
             "then changes with mu. dhwear(r) and dVwear are worn by the last cycle. `wear\n"
             "cycles N` adds N to Nw: the gap and all results are then those after Nw cycles\n"
             "like the last one, with what press and cycle hold: FN or dz, FA or dxA. Nw is an\n"
             "input, to be swept and solved for; another press or cycle sets it to 0. hwear(r)\n"
             "and Vwear are worn so far, to about 0.1 % of the largest (0.5 % for cones near\n"
             "gross slip at k < -0.8, and with FN and dxA held), except at steep edges. At a,\n"
             "which moves outward, hwear is 0 for any Nw: ask at a place inside, as in `solve\n"
             "Nw for hwear(0.95*a) = 10 nm`.\n"
             "c is as good, and dW to 0.1 % of what it was at most: near the limit it may go\n"
             "to 0. Beside c and a pressure steepens as wear goes on, to more than the nodes\n"
             "resolve, so that p0 is not known then, and a note says so: ask for p(r) inside.\n"
             "Both bodies wear together, and debris is gone. `wear limit` is the final state,\n"
             "unless FN and dxA are held: no wear within c, no pressure outside it (Popov,\n"
             "Sci. Rep. 4, 3749, 2014).\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> cycle FA=20 N; wear K=1e-4 H=2 GPa\n"
             "    fret> alpha_w, dVwear, dVwear/(alpha_w*dW)\n"
             "    alpha_w = 125000 um^3/J\n"
             "    dVwear = 0.238307 um^3\n"
             "    dVwear/(alpha_w*dW) = 1\n"
             "    fret> wear cycles 1000; set digits 3\n"
             "    fret> Vwear, hwear(0.95*a), hwear(0.95*a) at Nw=2000\n"
             "    Vwear = 241 um^3\n"
             "    hwear(0.95*a) = 9.14 nm\n"
             "    hwear(0.95*a) = 17.2 nm\n"},
    {.name = "rig",
     .run = do_rig,
     .group = "the load",
     .keywords = "compliance machine stiffness series tribometer offset reading",
     .changes = true,
     .takes = "stiffness:=80 N/um | none [d0:=1 um] [F0:=1 N]",
     .summary = "a spring in series between contact and machine",
     .help = "A machine moves or measures drig = dx + Fx/K_rig; its readings may have offsets:\n"
             "drig + d0 and Fx + F0. `step drig=...` and `cycle drigA=...` prescribe drig. The\n"
             "loop of Fx over drig has the same area dW as that over dx. K_rig, d0 and F0 are\n"
             "inputs; `rig none` removes them.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> rig stiffness=80 N/um; step Fx=20 N; dx, drig\n"
             "    dx = 625.995 nm\n"
             "    drig = 875.995 nm\n"
             "    fret> cycle drigA=1 um; dW, dx\n"
             "    dW = 2.93388 uJ\n"
             "    dx = 718.25 nm\n"},
    {.name = "press",
     .run = do_press,
     .keywords = "normal load Hertz indentation pressure",
     .changes = true,
     .takes = "FN=100 N | dz=1 um | a=0.2 mm | p0=1 GPa | pmean=0.5 GPa",
     .summary = "press the bodies together: starts a load program",
     .help = "By force, indentation depth, contact radius, largest or mean pressure: the one\n"
             "given becomes an input, the others are results. Earlier steps and cycles are\n"
             "dropped. If several contacts have that mean pressure, as over a flat end at k <\n"
             "0, it is the one of the least load.\n\n"
             "    fret> material steel; geometry sphere R=10 mm\n"
             "    fret> press a=0.2 mm\n"
             "    fret> FN, dz\n"
             "    FN = 123.077 N\n"
             "    dz = 4 um\n"
             "    fret> a = 0.1 mm; FN\n"
             "    FN = 15.3846 N\n"
             "    fret> press p0=1 GPa; table FN for p0 = 1 GPa .. 2 GPa steps 1\n"
             "         p0 [GPa]         FN [N]\n"
             "                1        38.8153\n"
             "                2        310.522\n"},
    {.name = "step",
     .run = do_step,
     .keywords = "tangential load",
     .takes = "[Fx+=20 N | dx+=0.5 um | drig+=1 um] [FN+=120 N | dz+=1 um] [steps N:1000000]",
     .summary = "a straight step of the load",
     .help = "Goes to a tangential target, a normal target, or both; += adds to the present\n"
             "value. A normal target alone keeps dx. Both together go straight in FN and Fx,\n"
             "or, with a dx, straight in dz and dx. Fx is limited to mu*FN; dx is not, and\n"
             "beyond that limit the contact slides. For a drig (help rig) the target is the dx\n"
             "that belongs to it. `steps` records points on the way for `history`.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
             "    fret> press FN=100 N\n"
             "    fret> step Fx=20 N; step Fx+=-10 N\n"
             "    fret> Fx, dx, c/a\n"
             "    Fx = 10 N\n"
             "    dx = 337.819 nm\n"
             "    c/a = 0.956466\n"},
    {.name = "cycle",
     .run = do_cycle,
     .keywords = "oscillation fretting hysteresis loop dissipation",
     .changes = true,
     .takes = "FA:=20 N | dxA:=0.5 um | drigA:=1 um [times N:1000000] [steps N:1000000] [FNA:=30 N] "
              "[phase:=90 deg]",
     .summary = "oscillate the tangential force or displacement",
     .help = "Loads to +FA, then runs whole cycles +FA, -FA, +FA; dW is the energy dissipated\n"
             "in the last one. With FNA the normal force oscillates too: FN + FNA sin(w t +\n"
             "phase) with FA sin(w t). That is the exact sine; `steps` only sets how many\n"
             "points are recorded for `history`.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
             "    fret> press FN=100 N\n"
             "    fret> cycle FA=20 N\n"
             "    fret> dW, dW/(4*FN*dxmax) in %\n"
             "    dW = 1.90646 uJ\n"
             "    dW/(4*FN*dxmax) = 0.281737 %\n"},
    {.name = "follow",
     .run = do_follow,
     .keywords = "csv history measured",
     .changes = true,
     .takes = "FILE.csv [using NAME = COLUMN, ...]",
     .summary = "load along a table of FN,Fx or dz,dx",
     .help = "The header or `using` names the columns and their units (help files). With dx\n"
             "and Fx, dx drives and Fx is compared. Each row is a straight step; if one is\n"
             "impossible the scene stays as before the command. If nothing is pressed yet the\n"
             "first row presses, and must have Fx or dx = 0. A file of `history to` has both\n"
             "pairs: the forces drive, or dx where it is held or the contact slides; a\n"
             "difference between the file's Fx, dx and the computed ones is reported.\n\n"
             "    $ cat load.csv\n"
             "    FN [N],Fx [N]\n"
             "    100,0\n"
             "    120,15\n"
             "    120,-15\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
             "    fret> follow load.csv\n"
             "    fret> FN, Fx, W\n"
             "    FN = 120 N\n"
             "    Fx = -15 N\n"
             "    W = 328.223 nJ\n"},
    {.name = "reset",
     .run = do_reset,
     .keywords = "clear delete remove new",
     .changes = true,
     .takes = "[all]",
     .summary = "forget the load program; all: the inputs too",
     .help = "Variables of your own are kept.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; press FN=1 N\n"
             "    fret> reset\n"
             "    fret> a\n"
             "    error: there is no load yet: press first (press FN=100 N)\n"},
    {.name = "undo",
     .run = do_undo,
     .returns = true,
     .keywords = "back",
     .takes = "",
     .summary = "undo the last change of the scene",
     .help = "Of the inputs, the load or a variable; repeat it to go further back. A script\n"
             "run by `source`, a lesson, or a file that was followed counts as one change.\n\n"
             "    fret> friction 0.4; friction 0.3\n"
             "    fret> undo\n"
             "    fret> mu\n"
             "    mu = 0.4\n"},
    {.name = "history",
     .run = do_history,
     .group = "results",
     .keywords = "loop hysteresis csv export",
     .takes = "[to FILE]",
     .summary = "the recorded load history as a table",
     .help = "One row for each press and step and each point recorded by `steps`, with drig if\n"
             "there is a rig. `help files` lists the kinds of FILE.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
             "    fret> press FN=100 N; step Fx=20 N; step Fx=-20 N\n"
             "    fret> history\n"
             "           FN [N]        dz [um]         Fx [N]        dx [nm]         W [nJ]\n"
             "              100        3.48291              0              0              0\n"
             "              100        3.48291             20        625.995        476.614\n"
             "              100        3.48291            -20       -625.995        1429.84\n"},
    {.name = "table",
     .run = do_table,
     .keywords = "sweep csv export",
     .takes = "EXPR, ... RANGE [using NAME = COLUMN, ...] [to FILE]",
     .summary = "a table over a range",
     .help = "NAME is an input (k, FN, mu, ...) or a free name; the scene stays as it is. A\n"
             "list, `for FN = 1 N, 2 N, 5 N`, may replace LO .. HI, here and in figures. Two\n"
             "ranges make a matrix; in CSV and JSON a row for each pair. `along program`,\n"
             "`along cycle` and `along cycle FA=...` go along a load. `at FILE` takes inputs\n"
             "and names from the rows of a file; a column named like an expression (`p` for\n"
             "p(r)), or the only one of its dimension, is compared with it. fret --part I/N\n"
             "computes a share of the rows (help parts).\n\n"
             "    $ cat depth.csv\n"
             "    FN [N],depth [um]\n"
             "    20,1.21\n"
             "    80,3.09\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> table dW(F) in uJ, c(F)/a for F = 10 N .. 40 N steps 3\n"
             "            F [N]     dW(F) [uJ]         c(F)/a\n"
             "               10       0.188365        0.90856\n"
             "               20        1.90646       0.793701\n"
             "               30        9.01533       0.629961\n"
             "               40        54.1344              0\n"
             "    fret> table dz in um at depth.csv\n"
             "           FN [N]        dz [um]  file depth [um]  file depth - dz [um]\n"
             "               20        1.19114             1.21             0.0188616\n"
             "               80        3.00148             3.09             0.0885192\n"
             "    file depth - dz: rms = 63.9977 nm (2.07 % of the largest) over 2 rows, worst = 88.5192 nm "
             "in row 2 "
             "(line 3)\n"},
    {.name = "plot",
     .run = do_plot,
     .reads = true,
     .keywords = "figure loop hysteresis png svg pdf tex export contour map measured",
     .takes = "FIGURE | EXPR, ... [against EXPR]* RANGE LOOK [to FILE.png|svg|pdf|tex|html|gif|gp]",
     .summary = "figures, in the terminal or to a file",
     .print = figures_list,
     .help = "A FIGURE of the list above needs no RANGE, but may have one; | puts the next one\n"
             "beside it. `map EXPR for A = LO .. HI for B = LO .. HI` draws contours. Commas\n"
             "separate curves, also over different abscissas: `Fx against dx, FN against dz`.\n"
             "Without `steps` points are denser where a curve bends. LOAD is program, cycle,\n"
             "or a load tried on a copy: `step ...`, `cycle FA=...`. AXES are x, y or xy, TEXT\n"
             "is in quotation marks, `key off` hides the key. `over FILE.csv` adds measured\n"
             "points; with `residuals` it shows measured minus computed. FILE.gp is the\n"
             "gnuplot script itself. `set plot 80x24` fixes the size in the terminal, `set\n"
             "plot terminal` how it is drawn there: dumb by plain characters, block by braille\n"
             "(auto takes it if possible), sixel as a picture. fret --part I/N computes a\n"
             "share of the points of a map, as rows.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
             "    fret> press FN=100 N; cycle FA=38 N\n"
             "    fret> plot loop | springs to both.svg\n"
             "    wrote both.svg (58 kB)\n"
             "    fret> set plot 50x12\n"
             "    fret> plot p(r) for r = 0 um .. 250 um\n"
             "     p(r) [GPa]\n"
             "     1.5 +---------------------------------------+\n"
             "         ******************      +       +       |\n"
             "     1.0 |-+              *******              +-|\n"
             "         |                      *****            |\n"
             "     0.5 |-+                        ***        +-|\n"
             "         |       +       +       +    ** +       |\n"
             "     0.0 +-----------------------------********--+\n"
             "         0      50      100     150     200     250\n"
             "                          r [um]\n"},
    {.name = "animate",
     .run = do_animate,
     .reads = true,
     .keywords = "animation video movie gif springs",
     .takes = "FIGURE | EXPR, ... [against EXPR]* RANGE LOOK [frames N:2..1000] [to FILE.gif]",
     .summary = "moving figures along a load",
     .help = "Figures as in `plot`. Curves `along` a load, the same one for all, are drawn up\n"
             "to a moving instant; figures over a position, such as `springs` and `pressure`,\n"
             "show the state at that instant: `animate springs along cycle FA=30 N`. Without a\n"
             "load it is the program. An input may run over a range instead: `animate profile\n"
             "for Nw = 0 .. 1e4`. Ctrl-C stops.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> cycle FA=30 N\n"
             "    fret> animate springs | loop frames 8 to cycle.gif\n"
             "    wrote cycle.gif (174 kB)\n"},
    {.name = "explain",
     .run = do_explain,
     .keywords = "formula equation Mindlin",
     .takes = "EXPR [conditioning]",
     .summary = "formula, source, numbers, model and error of a value",
     .help = "The formula with its equation number (Mathematics 2022, 10, 3641), the inputs\n"
             "that the value depends on, how it was computed, and its numerical error. With\n"
             "`conditioning`, also the relative size of the last binary digit of each input\n"
             "without a live definition, of the press and of the last load, the relative\n"
             "change of the value by it, and the ratio of the two. If that is large, as close\n"
             "to gross slip, the value is less certain than its inputs, with any model.\n\n"
             "    fret> material E0=210 GPa nu=0.3\n"
             "    fret> explain eta conditioning\n"
             "    eta: ratio of normal to tangential stiffness\n"
             "        eta = c_N/c_T  (4),(5)\n"
             "        nu = 0.3\n"
             "        model: closed form\n"
             "        eta = 1.21429\n"
             "        error: below 3e-16 of the value\n"
             "        conditioning          last digit    moves eta by  condition number\n"
             "        nu = 0.3                 1.9e-16         4.7e-17              0.25\n"
             "        no effect: E0\n"},
    {.name = "accuracy",
     .run = do_accuracy,
     .keywords = "error speed",
     .takes = "[FA=20 N | dxA=0.5 um] [within SECONDS:3600]",
     .summary = "error against time of every model, for this scene",
     .help = "Lists the models that can compute dW: value, relative error, time of a cycle\n"
             "without setting up. The reference is quadrature in long double; `<` marks an\n"
             "error below that of the reference. Without an argument the amplitude is that of\n"
             "the last cycle, else the present Fx, else half of mu*FN. Where FN swings or has\n"
             "changed, the load program itself is run and the reference is a refined memory\n"
             "diagram. Springs with `midpoint` weights x^k h converge with order 1+k for k <\n"
             "0. The last lines say what `set model auto` takes, and which springs come close.\n"
             "Larger models are skipped if all would take more than 3 seconds; `within 20`\n"
             "allows 20 seconds. `plot accuracy` draws the table.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> set digits 5; accuracy FA=20 N within 0.001\n"
             "    FA = 20 N at FN = 100 N\n"
             "    reference: quadrature in long double, 1.9065 uJ, good to 5e-19\n"
             "    model                 parameter      dW [uJ]     error time/cycle  x fastest\n"
             "    closed form                           1.9065    <5e-19     ... ns        ...\n"
             "    memory diagram                        1.9065    <5e-19     ... ns        ...\n"
             "    loop area (21)           M = 10       1.8755   1.6e-02     ... us        ...\n"
             "    loop area (21)          M = 100       1.9061   1.6e-04     ... us        ...\n"
             "    quadrature                            1.9065    <5e-19     ... us        ...\n"
             "    springs                 N = 100       1.9069   2.2e-04     ... ns        ...\n"
             "    springs                N = 1000       1.9065   5.5e-06     ... us        ...\n"
             "    1000 springs: error 5.5e-06 in ... us, ... times as long as auto\n"
             "    auto picks: closed form (constant FN): error <5e-19 in ... ns\n"},
    {.name = "solve",
     .run = do_solve,
     .group = "backwards",
     .keywords = "root equation inverse backwards find",
     .takes = "NAME for EXPR = EXPR [from LO to HI]",
     .summary = "the value of an input that makes an equation hold",
     .help = "NAME is an input or a variable of yours; the scene stays as it is. Without\n"
             "`from` the search covers all of k and nu, and three decades on either side of\n"
             "the present value of others. It reports if there is no root, if there are\n"
             "several, if the sides only touch, and where the scene becomes impossible. Of\n"
             "sides that are equal on a stretch, as c and 0 in gross slip, the root is the\n"
             "end of it.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> solve FN for a = 0.2 mm\n"
             "    FN = 123.077 N\n"
             "    fret> cycle FA=20 N\n"
             "    fret> solve mu for dW = 1 uJ\n"
             "    mu = 0.636473\n"},
    {.name = "maximize",
     .run = do_maximize,
     .keywords = "optimum optimise best design largest peak",
     .takes = "EXPR over NAME = LO .. HI, ...",
     .summary = "where an expression is largest",
     .help = "One to three inputs or free names, each in its range; the scene stays as it is.\n"
             "A note says if the optimum is at an end of a range, or of the possible scenes.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> maximize dWd(0.5 um) over FN = 1 N .. 100 N\n"
             "    FN = 10.4367 N\n"
             "    dWd(0.5 um) = 3.33974 uJ\n"},
    {.name = "minimize",
     .run = do_minimize,
     .keywords = "optimum optimise best design smallest",
     .takes = "EXPR over NAME = LO .. HI, ...",
     .summary = "where an expression is smallest",
     .help = "As `maximize`.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> minimize dz over FN = 20 N .. 100 N\n"
             "    FN = 20 N\n"
             "    dz = 1.19114 um\n"
             "    note: no inner optimum in FN: FN = 20 N is the lower end of its range\n"},
    {.name = "fit",
     .run = do_fit,
     .keywords = "least squares regression identify parameter measured data inverse calibrate",
     .takes = "INPUT, ... [for EXPR = EXPR to FILE.csv | along FILE.csv] [noise] [dx=10 nm] [Fx=0.5 N] "
              "[by WORD] [using NAME = COLUMN, ...]",
     .summary = "inputs from measured data, with standard errors",
     .help = "Starts from the present values, among others; the scene stays as it is. `for`:\n"
             "each row is an equation whose columns are names, as in depth = dz(force).\n"
             "`along`: the file is a measured loop. dx drives (and FN or dz, if there is such\n"
             "a column), Fx is compared; with a rig in the scene drig drives, and readings\n"
             "have offsets d0 and F0. The loop begins at rest or, if that fits better, within\n"
             "a steady cycle: a note says so. If dx has noise too, its turning points are\n"
             "unknowns, and distances are across the curve in units of both noises: `noise\n"
             "dx=10 nm Fx=0.5 N` gives them, else they are estimated from the scatter of rows.\n"
             "`by cycle` fits each cycle: a row each, with the energy of the rows and whether\n"
             "the flanks slide. Answers are values with standard errors, correlations and the\n"
             "rms of the residuals. Names that the data do not determine, or cannot tell\n"
             "apart, are an error. Unequal errors, mu = 0.76 (-0.3, +1.7), as where little\n"
             "slips, go to where the least sum of squares with mu held has grown by one\n"
             "variance. A note says if residuals of a loop are correlated, by a drift or an\n"
             "offset: fit d0 and F0, or take that off the file. A row before contact, FN(dz)\n"
             "of dz < 0, has no load. `plot fit` draws the last fit and its residuals.\n\n"
             "    $ cat depth.csv\n"
             "    force [N],depth [um]\n"
             "    20,1.21\n"
             "    50,2.28\n"
             "    80,3.09\n"
             "    120,4.09\n"
             "    fret> material steel; geometry sphere R=10 mm\n"
             "    fret> fit E0 for depth = dz(force) to depth.csv\n"
             "    E0 = 199.259 GPa +- 1.06 GPa\n"
             "    rms = 17.5911 nm over 4 rows\n"},
    {.name = "loop",
     .run = do_loop,
     .keywords = "measured hysteresis csv energy stiffness gross slip sliding rig file cycle",
     .takes = "FILE.csv [using NAME = COLUMN, ...] [to FILE]",
     .summary = "energy, amplitudes and stiffness of a measured loop, cycle by cycle",
     .help = "For each cycle between turning points of dx larger than noise: the energy dW\n"
             "that its rows enclose (M rows make it too small by (2*pi/M)^2/6), the amplitudes\n"
             "dxA and FA, the centre dx0, Fx0, the secant stiffness FA/dxA, the unloading\n"
             "stiffness after the turning points, the slope of the flanks before them relative\n"
             "to that (below 0.05 they slide), and the energy ratio dW/(4*FA*dxA). If the\n"
             "centre drifts from cycle to cycle by more than noise, dW is corrected for it; of\n"
             "one cycle it may be wrong by drift_dx*FA and drift_Fx*dxA. No scene is needed.\n"
             "`to FILE` writes a table. `help files` says what can be read.\n\n"
             "    $ cat rig.csv\n"
             "    Weg (um);Kraft (N)\n"
             "    -2;-30\n"
             "    -1;30\n"
             "    1;30\n"
             "    2;30\n"
             "    1;-30\n"
             "    -1;-30\n"
             "    -2;-30\n"
             "    fret> loop rig.csv\n"
             "    note: rig.csv: 7 rows from line 2, dx from \"Weg (um)\", Fx from \"Kraft (N)\", 1 cycle\n"
             "    cycle 1, from line 2\n"
             "        dW = 180 uJ\n"
             "        dxA = 2 um\n"
             "        FA = 30 N\n"
             "        dx0 = 0 m\n"
             "        Fx0 = 0 N\n"
             "        secant = 15 MN/m\n"
             "        unloading = 60 MN/m\n"
             "        flank = 0\n"
             "        energy_ratio = 0.75\n"
             "        flanks: slide\n"
             "    all\n"
             "        drift_dx = 0 m\n"
             "        drift_Fx = 0 N\n"
             "        noise_dx = 0 m\n"
             "        noise_Fx = 0 N\n"
             "        row_1: not at rest\n"},
    {.name = "uncertainty",
     .run = do_uncertainty,
     .keywords = "error deviation Monte Carlo tolerance variance confidence sensitivity",
     .takes =
         "EXPR, ... with INPUT +- DEVIATION, ... [samples N:10000000] [seed N:1000000000] [from FILE.csv]",
     .summary = "standard deviation of results, and the share of each input in it",
     .help = "Takes standard deviations of independent inputs; 5 % is relative to the value.\n"
             "The answer is first order, from derivatives, with the share of each input in the\n"
             "variance. If a Monte Carlo of normal samples (10000; 200 where FN swings or the\n"
             "gap is worn) differs, it is given as well. fret\n"
             "--part I/N draws only its share of the samples, as rows; the same statement with\n"
             "`from FILE.csv` evaluates those of all shares (help parts).\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> uncertainty dWd(0.5 um), a with mu +- 0.02, E0 +- 5 %\n"
             "    dWd(0.5 um) = 948.431 nJ +- 84 nJ\n"
             "        from mu 38 %, E0 62 %\n"
             "    a = 186.626 um +- 3.11 um\n"
             "        from mu 0 %, E0 100 %\n"},
    {.name = "export",
     .run = do_export,
     .keywords =
         "jenkins masing iwan elements dynamics damper model springs harmonic balance stiffness branches",
     .takes = "MODEL ...",
     .summary = "the contact for a dynamics code: Jenkins elements, its first harmonic, or its loop",
     .help = "Jenkins elements are chosen to minimise the worst error of the energy per cycle\n"
             "over all amplitudes, at the present FN; with FA, over those up to FA, and one of\n"
             "the N elements is a spring for what still sticks at FA. The answer is that\n"
             "error, also relative to the energy at gross slip (at FA). FILE.h is a C table to\n"
             "compile. Under delta_x = dxA cos(theta) the first harmonic of the force is Kp\n"
             "dxA cos(theta) - Kpp dxA sin(theta), Kpp = dWd(dxA)/(pi dxA^2). The loop is that\n"
             "of the last cycle, in which FN may swing.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> export jenkins 4 to damper.h\n"
             "    wrote damper.h (733 B)\n"
             "    error of dW = 798.218 nJ\n"
             "    relative = 0.0147451\n"
             "    fret> export harmonic to harmonic.csv for dxA = 0.1 um .. 2 um steps 4\n"
             "    wrote harmonic.csv (305 B)\n"
             "    fret> cycle FA=20 N; export loop to loop.csv\n"
             "    wrote loop.csv (9.8 kB)\n"},
    {.name = "show",
     .run = do_show,
     .group = "the session",
     .keywords = "save",
     .takes = "[PART]",
     .summary = "show the scene, settings, variables, ...",
     .help = "PART is scene (also without PART), the commands that make it again, to the last\n"
             "digit; or settings, units, commands, variables or demos.\n\n"
             "    fret> material steel; geometry sphere R=10 mm\n"
             "    fret> show\n"
             "    material E0=210 GPa nu=0.3\n"
             "    geometry sphere R=10 mm\n"},
    {.name = "set",
     .run = do_set,
     .keywords = "options",
     .takes = "[SETTING ...]",
     .summary = "change a setting, or show all",
     .help = "One setting a statement. The model auto takes the closed form if there is one,\n"
             "else the memory diagram; springs are an approximation.\n\n"
             "    fret> set digits 12; pi\n"
             "    pi = 3.14159265359\n"},
    {.name = "source",
     .run = do_source,
     .keywords = "script",
     .changes = true,
     .keeps = true,
     .takes = "FILE",
     .summary = "run a script",
     .help = "Statements of a file, as if typed here; it stops at the first error.\n\n"
             "    $ cat ball.fret\n"
             "    material steel; geometry sphere R=10 mm\n"
             "    press FN=100 N\n"
             "    a\n"
             "    fret> source ball.fret\n"
             "    a = 186.626 um\n"
             "    fret> dz\n"
             "    dz = 3.48291 um\n"},
    {.name = "save",
     .run = do_save,
     .keywords = "write keep export scene history",
     .takes = "FILE | history FILE",
     .summary = "write the scene as commands, or the lines typed",
     .help = "The file recreates the scene, to the last bit: `source FILE`, or fret FILE. It\n"
             "begins with the version that wrote it. `save history` writes the lines typed in\n"
             "this session.\n\n"
             "    fret> material steel; friction 0.3; save steel.fret\n"
             "    wrote steel.fret (53 B)\n"
             "    fret> reset all; source steel.fret\n"
             "    fret> show\n"
             "    material E0=210 GPa nu=0.3\n"
             "    friction 0.3\n"},
    {.name = "record",
     .run = do_record,
     .keywords = "transcript log protocol test save",
     .takes = "FILE | off",
     .summary = "write statements and answers to a transcript, or to a page",
     .help = "A transcript begins with the version, the present scene and settings. `replay\n"
             "FILE`, or fret --replay FILE, runs it and compares the answers. A FILE that ends\n"
             "in .html is a page to read and print, with its figures.\n\n"
             "    fret> record session.txt\n"
             "    fret> friction 0.3; 2*mu\n"
             "    2*mu = 0.6\n"
             "    fret> record off\n"
             "    wrote session.txt (49 B)\n"},
    {.name = "replay",
     .run = do_replay,
     .keywords = "transcript test compare record",
     .takes = "FILE",
     .summary = "run a transcript and compare its answers",
     .help = "In a session of its own: the scene stays. Lines after `fret> ` are run, and the\n"
             "answers must agree, numbers within their printed digits. Differences are shown:\n"
             "- is the transcript, + is now. Text copied from a terminal is a transcript, too.\n\n"
             "    $ cat check.txt\n"
             "        fret> friction 0.4\n"
             "        fret> mu, 1/3\n"
             "        mu = 0.4\n"
             "        1/3 = 0.333\n"
             "    fret> replay check.txt\n"
             "    check.txt: 2 passed, 0 failed\n"},
    {.name = "compare",
     .run = do_compare,
     .keywords = "side by side two scenes live",
     .takes = "INPUT = VALUES | off",
     .summary = "two values of an input side by side in live",
     .help = "`live` shows the scene with the first value of INPUT and beside it with the\n"
             "second; each key acts on both. The scene keeps its own value.\n\n"
             "    fret> compare k = -0.5, 0.5\n"
             "    note: live shows both; compare off ends it\n"
             "    fret> compare off\n"},
    {.name = "live",
     .run = do_live,
     .keywords = "full-screen teach demonstration tui animate",
     .takes = "[FILE]",
     .summary = "the full-screen mode: press, push and pull by hand, everything drawn",
     .print = live_keys,
     .help = "The mouse drags the point of the loop. All you do there is a statement, and\n"
             "`undo` takes it back. FILE is a script to step through with space; without a\n"
             "terminal it plays, and the last screen is printed. A cycle that plays on is run\n"
             "anew with each period: `undo`, then `cycle FA=20 N times 2`. After the keys\n"
             "right, space and q a transcript has:\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> live\n"
             "    fret> step Fx+=2 N\n"
             "    fret> cycle FA=20 N\n"
             "    fret> dW\n"
             "    dW = 1.90646 uJ\n"},
    {.name = "demo",
     .run = do_demo,
     .keywords = "tour lesson teach figure paper",
     .takes = "[LESSON | FILE] [to FILE.html]",
     .summary = "play a lesson, or a tour of the program",
     .help = "A lesson asks, then shows each statement and its answer. At the prompt any key\n"
             "goes on, `b` back, `q` leaves; in a script it plays through. It begins without a\n"
             "scene and leaves its own; `undo` brings back yours. `show demos` lists the\n"
             "lessons in their order; without a name the tour plays. A name with a `.` or a\n"
             "`/` is a file of your own (`help lessons`). FILE.html is a handout: a page with\n"
             "the figures, room for answers, and the answers at its end.\n\n"
             "    $ fret -c 'demo sticking' | head -n 4\n"
             "    Stick and slip: Cattaneo and Mindlin push the sphere sideways\n"
             "    \n"
             "    # 100 N press, friction 0.4: 40 N make the sphere slide. We push with 20 N.\n"
             "    # Does all of the contact stick?\n"},
    {.name = "ask",
     .run = do_ask,
     .keywords = "exercise question quiz guess answer hint teach lesson",
     .takes = "TEXT [= EXPR within DEVIATION | of CHOICES = N:9] [hint TEXT]",
     .summary = "ask the learner a question, and show its answer",
     .help = "At the prompt and in a lesson guesses may be typed; each is told how far off it\n"
             "is. `?` shows the hint, Enter the answer. `within 5 %` is relative to the\n"
             "answer, `within 2 um` absolute. Without a terminal the answer is shown at once.\n"
             "`help lessons` says how a lesson is written.\n\n"
             "    fret> ask \"c/a at half of gross slip?\" = (1-0.5)^(1/3) within 5 %\n"
             "    c/a at half of gross slip?\n"
             "    (1-0.5)^(1/3) = 0.793701\n"
             "    fret> ask \"Where does slip begin?\" of \"in the middle\", \"at the rim\" = 2\n"
             "    Where does slip begin?\n"
             "        1  in the middle\n"
             "        2  at the rim\n"
             "    answer: 2, at the rim\n"},
    {.name = "help",
     .run = do_help,
     .takes = "[TOPIC]*",
     .summary = "this help, or help on a command, a quantity or a topic",
     .help = "    fret> help kappa\n"
             "    kappa: shape factor\n"
             "        kappa = (n/2) B(n/2,(k+1)/2)  (8)\n"},
    {.name = "cite",
     .run = do_cite,
     .keywords = "paper reference BibTeX literature version authors DOI",
     .takes = "",
     .summary = "how to cite the paper and this program, with its version",
     .help = "As text, then as BibTeX.\n\n"
             "    $ fret -c cite | grep -c '^@'\n"
             "    2\n"},
    {.name = "apropos",
     .run = do_apropos,
     .keywords = "search",
     .takes = "WORD ...",
     .summary = "find commands and quantities by one or more words",
     .help = "Several words must all be there, in any order.\n\n"
             "    fret> apropos stick\n"
             "    c           stick radius\n"
             "    plot springs  springs between their bounds\n"
             "    plot regimes  running conditions\n"
             "    fret> apropos contact radius\n"
             "    a           contact radius\n"},
    {.name = "quit",
     .run = do_quit,
     .takes = "",
     .summary = "leave (so does Ctrl-D)",
     .help = "    fret> quit\n"},
    {.name = "exit", .run = do_quit, .takes = "", .summary = "the same as quit", .help = "    fret> exit\n"},
    {.name = NULL},
};
