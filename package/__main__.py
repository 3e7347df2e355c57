# SPDX-License-Identifier: GPL-3.0-or-later
"""``python -m reeb_parts``: the command where no ``reeb-parts`` is on the path, as of a package in a zip."""

import sys

from .command.main import main

if __name__ == "__main__":
    sys.exit(main())
