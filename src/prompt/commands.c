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
             "material is homogeneous and c0 is not needed. Arguments behind a name of\n"
             "the list above change it (`material steel nu=0.28`); `help NAME` tells the\n"
             "source. The shear modulus G0 (or G) may stand in place of E0, and for k = 0 so\n"
             "may E* of both bodies, 1/Estar = sum (1-nu^2)/E0 (Johnson, Contact Mechanics,\n"
             "4.2): of that alone, without nu, the normal contact follows.\n\n"
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
     .takes =
         "[BODY] [E0:=70 GPa | G0:=26 GPa | G:=26 GPa] [nu:=0.33] [E0_2:=70 GPa | G0_2:=26 GPa] [nu_2:=0.33]",
     .summary = "the other body, where it differs",
     .help =
         "The second body shares k and c0 with the first; by default it is the same.\n"
         "Bodies that are not elastically similar couple normal and tangential contact,\n"
         "which is left out here: a warning says so where something tangential is asked.\n"
         "`help material` lists materials.\n\n"
         "    fret> material steel; second rigid; friction 0.3\n"
         "    fret> geometry sphere R=10 mm; press FN=100 N; a\n"
         "    a = 148.125 um\n"
         "    fret> dW(20 N)\n"
         "    dW(20 N) = 1.96943 uJ\n"
         "    warning: the bodies are elastically dissimilar (mismatch 0.286): normal and tangential "
         "contact are "
         "coupled, and these results are an approximation, kn up to 2.9 % too small (help limits tells of "
         "dW)\n"},
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
     .help = "Sets mu, Coulomb's coefficient. `mu = 0.4` does the same. What is only pressed\n"
             "needs none, and 0 holds no Fx.\n\n"
             "    fret> friction 0.4\n"
             "    fret> mu\n"
             "    mu = 0.4\n"},
    {.name = "bulk",
     .run = do_bulk,
     .keywords = "stress fatigue tension sB sxx",
     .changes = true,
     .takes = "stress:=50 MPa | none",
     .summary = "a bulk stress along x in the first body",
     .help = "Adds sB to sxx in the first body, z >= 0, and so to mises and its like. It is an\n"
             "input: `sB = 50 MPa` does the same. What it does to the contact, a shift of the\n"
             "stick zone, is left out.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; press FN=100 N\n"
             "    fret> bulk stress=50 MPa\n"
             "    warning: a bulk stress also shifts the stick zone, which is left out: in the plane case "
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
     .summary = "a wear law, and what cycles of fretting leave of the gap",
     .help = "Of each place friction's work per area takes a depth, alpha_w dWdA(r) (Fouvry\n"
             "et al., Wear 255, 2003); Archard's V = K F_N s/H has alpha_w = K/(mu H), which\n"
             "then follows mu. dhwear(r), dVwear are what the last cycle wears. `wear cycles\n"
             "N` adds N to Nw: the gap, and all that follows, is then as that many of the\n"
             "last cycle leave it, under what press and cycle hold: FN or dz, FA or dxA. Nw\n"
             "is an input like another, swept and solved for, and 0 again after another press\n"
             "or cycle. hwear(r), Vwear are depth and volume so far, to some 0.1 % of the\n"
             "largest (0.5 % of cones near gross slip at k < -0.8, and with FN and dxA held),\n"
             "but for steep edges. At a, which moves on, hwear is 0 whatever Nw is: ask at a\n"
             "place within, as in `solve Nw for hwear(0.95*a) = 10 nm`.\n"
             "Both bodies wear together, and debris is gone. `wear limit` is the end of it,\n"
             "unless FN and dxA are held: within c nothing wears, outside pressure is gone\n"
             "(Popov, Sci. Rep. 4, 3749, 2014).\n\n"
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
     .summary = "a spring between contact and machine",
     .help = "What a machine moves or measures is drig = dx + Fx/K_rig, and what it reads may\n"
             "be off: drig + d0 and Fx + F0. `step drig=...` and `cycle drigA=...` go by the\n"
             "machine's displacement; the loop of Fx over drig has the same area dW. K_rig, d0\n"
             "and F0 are inputs; `rig none` takes them off.\n\n"
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
     .help = "By force, indentation depth, contact radius, largest or mean pressure: that is\n"
             "an input from then on, the others are results. What was stepped before is\n"
             "forgotten.\n\n"
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
     .help = "A tangential target, a normal target, or both for a straight ramp; += adds to\n"
             "what is there now. A normal step alone holds dx. Both together go straight in FN\n"
             "and Fx, or to a dx straight in dz and dx. Force cannot go beyond mu*FN;\n"
             "displacement can, and then the contact slides. To a drig (help rig) it goes as\n"
             "to the dx that ends there. `steps` records points on the way for `history`.\n\n"
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
     .summary = "close tangential cycles",
     .help = "Goes to +FA, then through whole cycles +FA, -FA, +FA; dW is the energy that\n"
             "the last one dissipated. With FNA the normal force swings too,\n"
             "FN + FNA sin(w t + phase) against FA sin(w t): the sine itself, whatever the\n"
             "`steps`, which are points to record for `history`.\n\n"
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
     .help = "The header gives the columns and their units, or `using`. Of dx,Fx the first\n"
             "drives and Fx is compared. Every row is a straight step; one that cannot be\n"
             "carried leaves the scene as before the command. Where nothing is pressed yet\n"
             "the first row presses, and must have Fx or dx = 0. A file of `history to` has\n"
             "both pairs: the forces drive, but dx where it is held or the contact slides, and\n"
             "how far Fx and dx are from here is told where they do not agree. `help files`\n"
             "tells what else such a file may hold.\n\n"
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
     .summary = "take back the last change of the scene",
     .help = "Of the inputs, the load or a name; again for the one before. A script run by\n"
             "`source`, a lesson, or a file that was followed, is one change.\n\n"
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
     .help = "One row for every press and step, and for the points that `steps` asked for,\n"
             "with a rig drig too. `help files` tells the forms of FILE.\n\n"
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
     .help = "NAME is an input (k, FN, mu, ...) or a free name; the scene stays as it is.\n"
             "A list, `for FN = 1 N, 2 N, 5 N`, may stand for LO .. HI, here and in figures.\n"
             "Two ranges make a matrix, as CSV and JSON a row for each pair. `along program`,\n"
             "`along cycle` and `along cycle FA=...` go along a load. `at FILE` goes over the\n"
             "rows of a file: its columns are inputs and names, and one that is called as an\n"
             "expression (`p` as p(r)), or the only one of its dimension, is compared with it.\n"
             "fret --part I/N does a share of the rows.\n\n"
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
     .help = "A FIGURE of the list above stands alone or with another RANGE; a | puts one\n"
             "beside it. `map EXPR for A = LO .. HI for B = LO .. HI` draws contours. A comma\n"
             "parts curves over expressions of their own: `Fx against dx, FN against dz`.\n"
             "Without steps there are more points where the curve bends. LOAD is program,\n"
             "cycle, or one that is only tried: `step ...`, `cycle FA=...`. AXES are x, y or\n"
             "xy, TEXT stands in quotation marks, `key off` hides the key, and `over` adds\n"
             "measured points; `over FILE residuals` shows what they have more than the curve.\n"
             "FILE.gp is the gnuplot script itself. `set plot 80x24` fixes the size in the\n"
             "terminal, `set plot terminal` how it is drawn there: dumb in plain characters,\n"
             "block in braille (auto takes it where it can), sixel as a picture.\n"
             "fret --part I/N writes a share of the points of a map, as rows.\n\n"
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
     .takes = "FIGURE | EXPR, ... [against EXPR]* RANGE LOOK [frames N:1000] [to FILE.gif]",
     .summary = "figures in motion along a load",
     .help = "Figures as of `plot`. Those `along` a load, all along the same one, are drawn up\n"
             "to a moving instant; `springs`, `pressure`, `traction` and what else goes over\n"
             "a place show the state then, as `animate springs along cycle FA=30 N` does. The\n"
             "load is the program where none is said. An input may go over a range instead:\n"
             "`animate profile for Nw = 0 .. 1e4`. Ctrl-C stops.\n\n"
             "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
             "    fret> cycle FA=30 N\n"
             "    fret> animate springs | loop frames 8 to cycle.gif\n"
             "    wrote cycle.gif (174 kB)\n"},
    {.name = "explain",
     .run = do_explain,
     .keywords = "formula equation Mindlin",
     .takes = "EXPR [conditioning]",
     .summary = "formula, source, numbers put in, model used, error",
     .help = "The formula with its equation number (Mathematics 2022, 10, 3641), the inputs\n"
             "that the value depends on, how it was computed, and the error of the numbers\n"
             "alone. With `conditioning`, too: by which part of itself the last binary digit\n"
             "of each input, of the press and of the last load moves the value, and the ratio\n"
             "of the two. Large numbers, as close to gross slip, mean that the value cannot be\n"
             "better than its inputs, whatever the model.\n\n"
             "    fret> material E0=210 GPa nu=0.3\n"
             "    fret> explain eta conditioning\n"
             "    eta: stiffness ratio\n"
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
     .help = "A table of the models that can answer for dW: value, relative error, time of a\n"
             "cycle without setting up. Errors refer to quadrature in extended precision; `<`\n"
             "marks one that is below what it can tell. Without an argument the amplitude is\n"
             "that of the last cycle, else of Fx now, else half of mu*FN. Where FN swings or\n"
             "has changed, the load program is run as it is and errors refer to a refined\n"
             "memory diagram. Springs with `midpoint` weights x^k h converge with order 1+k\n"
             "where k < 0. The end says what `set model auto` picks, and which springs come\n"
             "close. Larger models are left out where all would take more than 3 seconds;\n"
             "`within 20` allows more, `within 0.3` less. `plot accuracy` draws the table.\n\n"
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
     .help = "NAME is an input or a variable of yours; the scene stays as it is. Without a\n"
             "range it looks over the whole range of k and nu, and three decades on either\n"
             "side of the present value of others. It says where there is no root, where\n"
             "there are several, where the two sides only touch, and where the scene ends.\n\n"
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
             "A note says where the best is an end of a range, or where the scene ends.\n\n"
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
     .summary = "inputs from measured data, with how sure they are",
     .help = "Starts from the present values, one start of many; the scene stays as it is.\n"
             "With `for` each row is an equation whose columns are names: depth = dz(force).\n"
             "With `along` the file is a measured loop: driven by dx (and FN or dz, where\n"
             "there is such a column), Fx compared; with a rig in the scene by drig, readings\n"
             "with offsets d0 and F0. Where dx has noise too, its turning points are\n"
             "unknowns, and distances are across the curve in units of both noises: noise\n"
             "dx=10 nm Fx=0.5 N gives them, else they are estimated from row to row. by\n"
             "cycle: a row each, with the energy of the rows and whether the flanks slide.\n"
             "Answers are values with their standard errors, correlations and the rms of the\n"
             "residuals; data that do not determine a name, or cannot tell two apart, are an\n"
             "error that names them. Where the errors down and up differ, as of mu where\n"
             "little slides, they go to where the least sum of squares with the name held\n"
             "there has grown by one variance: mu = 0.76 (-0.3, +1.7). A note says where the\n"
             "residuals of a loop are no noise but go together, by a drift or an offset: fit\n"
             "d0 and F0, or take that off the file. A row before contact, FN(dz) of dz < 0,\n"
             "is one without load. `plot fit` draws the last fit, and what is left over.\n\n"
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
     .summary = "what a measured loop says by itself, cycle by cycle",
     .help = "Of each cycle of dx, Fx, between turning points above the noise: the energy dW\n"
             "that its rows enclose (of M rows (2*pi/M)^2/6 too little), the amplitudes dxA\n"
             "and FA, the centre dx0, Fx0, the secant stiffness FA/dxA, the stiffness of\n"
             "unloading behind the turning points, the slope of the flanks before them as a\n"
             "part of that (below 0.05 they slide), and the energy ratio dW/(4*FA*dxA). Where\n"
             "the centre drifts from cycle to cycle by more than noise, dW is without that;\n"
             "of one cycle it may be wrong by drift_dx*FA and drift_Fx*dxA. No scene is\n"
             "needed. `to FILE` writes a table. `help files` tells what is read.\n\n"
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
     .summary = "how sure a value is, and which input that comes from",
     .help = "Standard deviations of independent inputs; 5 % is a part of the value. The\n"
             "answer is first order, from derivatives, with the share of each input in the\n"
             "variance. A Monte Carlo of normal samples stands beside it where it says\n"
             "something else. With fret --part I/N only the samples of that share are drawn,\n"
             "as rows; the same question `from` a file of all shares sums them.\n\n"
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
             "over all amplitudes, at this normal force; with FA, over those up to it, and one\n"
             "of the N is the spring of what then still sticks. The answer is that error, and\n"
             "its part of the energy at gross slip (at FA). FILE.h is a C table to compile in.\n"
             "Under delta_x = dxA cos(theta) the first harmonic of the force is Kp dxA\n"
             "cos(theta) - Kpp dxA sin(theta), Kpp = dWd(dxA)/(pi dxA^2). The loop is that of\n"
             "the last cycle, whose normal force may swing.\n\n"
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
     .summary = "what is set",
     .help = "PART is scene, the commands that make it again, to the last digit; or settings,\n"
             "units, commands, variables or demos.\n\n"
             "    fret> material steel; geometry sphere R=10 mm\n"
             "    fret> show\n"
             "    material E0=210 GPa nu=0.3\n"
             "    geometry sphere R=10 mm\n"},
    {.name = "set",
     .run = do_set,
     .keywords = "options",
     .takes = "[SETTING ...]",
     .summary = "settings",
     .help = "One setting a statement. Of the models auto takes the closed form where there is\n"
             "one, else the memory diagram; springs are an approximation.\n\n"
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
     .summary = "write the scene as commands; or what has been typed",
     .help = "The file makes the scene again, to the last bit: `source FILE`, or fret FILE. It\n"
             "begins with the version that wrote it.\n"
             "`save history` writes the lines typed in this session, as they were typed.\n\n"
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
     .summary = "keep what is typed and answered as a transcript, or a page",
     .help = "A transcript begins with the version, the scene and the settings as they are.\n"
             "`replay FILE`, or fret --replay FILE, runs it and compares the answers. One that\n"
             "ends in .html is a page to read and print, its figures in it.\n\n"
             "    fret> record session.txt\n"
             "    fret> friction 0.3; 2*mu\n"
             "    2*mu = 0.6\n"
             "    fret> record off\n"
             "    wrote session.txt (49 B)\n"},
    {.name = "replay",
     .run = do_replay,
     .keywords = "transcript test compare record",
     .takes = "FILE",
     .summary = "run a transcript and compare what comes out",
     .help = "In a session of its own: the scene stays. Lines after `fret> ` are run, what\n"
             "follows each must come out again, numbers within their printed digits.\n"
             "Differences are shown: - is the transcript, + is now. A session copied from a\n"
             "terminal is a transcript, too.\n\n"
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
     .summary = "two scenes on the screen of live, moved by the same hand",
     .help = "`live` shows the scene with one value of INPUT, and beside it with the other.\n"
             "What is done there is done to both. The scene keeps its own value.\n\n"
             "    fret> compare k = -0.5, 0.5\n"
             "    note: live shows both; compare off ends it\n"
             "    fret> compare off\n"},
    {.name = "live",
     .run = do_live,
     .keywords = "full-screen teach demonstration tui animate",
     .takes = "[FILE]",
     .summary = "press, push and pull by hand, everything drawn: the full-screen mode",
     .print = live_keys,
     .help = "The mouse drags the point of the loop. What is done there are statements: undo\n"
             "takes them back. FILE is a script to step through, space by space; without a\n"
             "terminal it plays, and the last screen is printed. A transcript has after the\n"
             "keys right, space and q:\n\n"
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
     .help = "A lesson asks, then shows each statement and its answer. At the prompt a key\n"
             "leads on, `b` back, `q` out; in a script it plays through. It begins without a\n"
             "scene; its own stays, to go on with, and `undo` brings back the one before.\n"
             "`show demos` lists the lessons in their order. A name with a `.` or a `/` is a\n"
             "file of your own (`help lessons`), none the tour. FILE.html is a handout: a page\n"
             "with the figures, room for answers, and the answers at its end.\n\n"
             "    $ fret -c 'demo sticking' | head -n 4\n"
             "    Stick and slip: Cattaneo and Mindlin push the sphere sideways\n"
             "    \n"
             "    # 100 N press, friction 0.4: 40 N make the sphere slide. We push with 20 N.\n"
             "    # Does all of the contact stick?\n"},
    {.name = "ask",
     .run = do_ask,
     .keywords = "exercise question quiz guess answer hint teach lesson",
     .takes = "TEXT [= EXPR within DEVIATION | of CHOICES = N:9] [hint TEXT]",
     .summary = "a question to who learns, and its answer",
     .help = "At the prompt, and in a lesson, guesses may be typed, and how far off each is is\n"
             "told: `?` asks for the hint, Enter for the answer. `within 5 %` is a part of the\n"
             "answer, `within 2 um` an amount. Without a terminal the answer is shown. `help\n"
             "lessons` tells how a lesson is written.\n\n"
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
     .summary = "this help, or that on a command, a quantity or a topic",
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
     .summary = "find commands and quantities by a word, or several",
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
