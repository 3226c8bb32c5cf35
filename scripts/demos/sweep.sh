#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How another program may use fret: prints a table of the loss per cycle as JSON, an object per line.
fret=${FRET:-build/fret}
exec "$fret" --format=json - <<END
material E0=210 GPa nu=0.3 k=0 c0=1 mm
geometry sphere R=10 mm; friction 0.4; press FN=100 N
table dW(F), c(F) for F = 5 N .. 35 N steps 6 with k = 0, 0.25, 0.5
END
