#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes every table in tests/reference again, byte for byte the same. Needs Python 3 with mpmath, and numpy for --check.
set -eu
cd "$(dirname "$0")"
for script in dd material kappa loss slice scene history shape pressure field steep rim corners \
    figures spring_model swinging backwards damper stress; do
    PYTHONDONTWRITEBYTECODE=1 "${PYTHON:-python3}" "$script.py" "$@"
done
